// What the library says of a failure, as exceptions. Thrown by the generated Native for each negative result.
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

    /// <summary>A call that failed: it has changed nothing. The message is the library's own sentence.</summary>
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
                default: return new FeatherException(result, message);
            }
        }

        static unsafe string LastError()
        {
            byte* text = (byte*)Native.last_error();
            int length = 0;
            while (text[length] != 0) ++length;
            return Encoding.UTF8.GetString(text, length);
        }
    }

    /// <summary>null, NaN, infinity, or out of the range that the message tells.</summary>
    public sealed class BadArgumentException : FeatherException { internal BadArgumentException(string m) : base(Result.ErrorArgument, m) { } }
    /// <summary>Of something destroyed, of nothing, or of another world.</summary>
    public sealed class StaleHandleException : FeatherException { internal StaleHandleException(string m) : base(Result.ErrorStale, m) { } }
    /// <summary>The handle of a shape where a body's is asked, and so on.</summary>
    public sealed class WrongKindException : FeatherException { internal WrongKindException(string m) : base(Result.ErrorKind, m) { } }
    /// <summary>Another thread is stepping the world.</summary>
    public sealed class WorldSteppingException : FeatherException { internal WorldSteppingException(string m) : base(Result.ErrorStepping, m) { } }
    /// <summary>The library got no memory; the world is as it was.</summary>
    public sealed class NoMemoryException : FeatherException { internal NoMemoryException(string m) : base(Result.ErrorMemory, m) { } }
    /// <summary>More than a world or a handle can hold.</summary>
    public sealed class LimitException : FeatherException { internal LimitException(string m) : base(Result.ErrorLimit, m) { } }
    /// <summary>This CPU, or this kind of body, cannot.</summary>
    public sealed class UnsupportedException : FeatherException { internal UnsupportedException(string m) : base(Result.ErrorUnsupported, m) { } }
    /// <summary>Not now: the pool still has worlds, the body is not kinematic...</summary>
    public sealed class WrongStateException : FeatherException { internal WrongStateException(string m) : base(Result.ErrorState, m) { } }
}
