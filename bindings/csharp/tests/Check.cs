// What a law says when it does not hold. Written so that NaN never passes.
using System;
using System.Numerics;

namespace FeatherPhysics.Tests
{
    public sealed class LawBrokenException : Exception { public LawBrokenException(string message) : base(message) { } }

    static class Check
    {
        public static void True(bool held, string what) { if (!held) throw new LawBrokenException(what); }

        public static void Near(double value, double expected, double bound, string what)
        {
            if (Math.Abs(value - expected) <= bound) return;
            throw new LawBrokenException(what + ": " + value + " is not within " + bound + " of " + expected);
        }

        public static void Same<T>(T value, T expected, string what)
        {
            if (!Equals(value, expected)) throw new LawBrokenException(what + ": " + value + " instead of " + expected);
        }

        /// The call throws exactly that, and its message names what it was about.
        public static void Throws<T>(Action call, string named) where T : Exception
        {
            try { call(); }
            catch (T e)
            {
                if (e.Message.IndexOf(named, StringComparison.Ordinal) < 0)
                    throw new LawBrokenException("'" + e.Message + "' does not name '" + named + "'");
                return;
            }
            catch (Exception e)
            {
                throw new LawBrokenException(e.GetType().Name + " instead of " + typeof(T).Name + ": " + e.Message);
            }
            throw new LawBrokenException("no " + typeof(T).Name + " of " + named);
        }
    }
}
