// What the library reports of a failure, as exceptions. The generated Native throws them for each negative result.
using System;
using System.Text;

namespace FeatherPhysics
{
    internal static class NativeLibraryName
    {
#if UNITY_IOS && !UNITY_EDITOR
        public const string Value = "__Internal"; // linked into the program
#else
        public const string Value = "feather_csharp";
#endif
    }

    /// <summary>A call that failed. It has changed nothing. The message is the library's own sentence.</summary>
    public class FeatherException : Exception
    {
        /// <summary>Which of the library's errors it is.</summary>
        public Result Result { get; }

        internal FeatherException(Result result, string message) : base(message) { Result = result; }

        internal static void Throw(int result) { throw Make((Result)result, LastError()); }

        internal static FeatherException Make(Result result, string message)
        {
            switch (result)
            {
                case Result.ErrorArgument: return new BadArgumentException(message);
                case Result.ErrorStale: return new StaleHandleException(message);
                case Result.ErrorKind: return new WrongKindException(message);
                case Result.ErrorStepping: return new WorldSteppingException(message);
                case Result.ErrorMemory: return new NoMemoryException(message);
                case Result.ErrorLimit: return new LimitException(message);
                case Result.ErrorUnsupported: return new UnsupportedException(message);
                case Result.ErrorState: return new WrongStateException(message);
                case Result.ErrorBusy: return new WorldBusyException(message);
                case Result.ErrorDegenerate: return new DegenerateException(message);
                case Result.ErrorData: return new BadDataException(message);
                case Result.ErrorVersion: return new NewerVersionException(message);
                case Result.ErrorDiverged: return new DivergedException(message);
                default: return new FeatherException(result, message);
            }
        }

        internal static unsafe string LastError()
        {
            byte* text = (byte*)Native.last_error();
            int length = 0;
            while (text[length] != 0) ++length;
            return Encoding.UTF8.GetString(text, length);
        }
    }

    /// <summary>null, NaN, infinity, or out of the range that the message names.</summary>
    public sealed class BadArgumentException : FeatherException
    {
        internal BadArgumentException(string message) : base(Result.ErrorArgument, message) { }
    }
    /// <summary>The handle of something destroyed, of another world, or of nothing.</summary>
    public sealed class StaleHandleException : FeatherException
    {
        internal StaleHandleException(string message) : base(Result.ErrorStale, message) { }
    }
    /// <summary>The handle of a shape where a body's is expected, and so on.</summary>
    public sealed class WrongKindException : FeatherException
    {
        internal WrongKindException(string message) : base(Result.ErrorKind, message) { }
    }
    /// <summary>The world is in a step: of another thread, or of this one, inside its pair filter.</summary>
    public sealed class WorldSteppingException : FeatherException
    {
        internal WorldSteppingException(string message) : base(Result.ErrorStepping, message) { }
    }
    /// <summary>The library got no memory. The world is as it was.</summary>
    public sealed class NoMemoryException : FeatherException
    {
        internal NoMemoryException(string message) : base(Result.ErrorMemory, message) { }
    }
    /// <summary>More than a world or a handle can hold.</summary>
    public sealed class LimitException : FeatherException
    {
        internal LimitException(string message) : base(Result.ErrorLimit, message) { }
    }
    /// <summary>This CPU, this kind of body or this geometry cannot.</summary>
    public sealed class UnsupportedException : FeatherException
    {
        internal UnsupportedException(string message) : base(Result.ErrorUnsupported, message) { }
    }
    /// <summary>Not now: the body is not kinematic, the joint has no motor...</summary>
    public sealed class WrongStateException : FeatherException
    {
        internal WrongStateException(string message) : base(Result.ErrorState, message) { }
    }
    /// <summary>Another thread is inside the world, in a call that this one excludes.</summary>
    public sealed class WorldBusyException : FeatherException
    {
        internal WorldBusyException(string message) : base(Result.ErrorBusy, message) { }
    }
    /// <summary>Flat or empty input.</summary>
    public sealed class DegenerateException : FeatherException
    {
        internal DegenerateException(string message) : base(Result.ErrorDegenerate, message) { }
    }
    /// <summary>Cut, altered or foreign bytes.</summary>
    public sealed class BadDataException : FeatherException
    {
        internal BadDataException(string message) : base(Result.ErrorData, message) { }
    }
    /// <summary>Bytes of a newer format.</summary>
    public sealed class NewerVersionException : FeatherException
    {
        internal NewerVersionException(string message) : base(Result.ErrorVersion, message) { }
    }
    /// <summary>A replay went another way than its recording.</summary>
    public sealed class DivergedException : FeatherException
    {
        internal DivergedException(string message) : base(Result.ErrorDiverged, message) { }
    }
}
