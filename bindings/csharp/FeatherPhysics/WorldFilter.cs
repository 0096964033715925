// The pair filter: the one function of the caller that a step calls. No exception passes through the library: the first
// one waits here, and Step throws it.
using System;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
using System.Threading;

namespace FeatherPhysics
{
    /// What IL2CPP looks for, by name, on functions that native code calls.
    [AttributeUsage(AttributeTargets.Method)]
    sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type) { }
    }

    public sealed unsafe partial class World
    {
        static class Judge
        {
            [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
            delegate int Function(IntPtr user, FilterPair* pair);

            static readonly Function Kept = Call; // the collector must not take it
            public static readonly IntPtr Pointer = Marshal.GetFunctionPointerForDelegate(Kept);

            [MonoPInvokeCallback(typeof(Function))]
            static int Call(IntPtr user, FilterPair* pair)
            {
                World world = (World)GCHandle.FromIntPtr(user).Target;
                return world.Allows(*pair) ? 1 : 0;
            }
        }

        PairFilter pairFilter;
        ExceptionDispatchInfo thrown; // by the pair filter, the first since Step threw one
        int judging;                  // thread that the pair filter runs on now, or 0

        bool IsJudging { get { return Volatile.Read(ref judging) == Thread.CurrentThread.ManagedThreadId; } }

        bool Allows(FilterPair pair)
        {
            Volatile.Write(ref judging, Thread.CurrentThread.ManagedThreadId);
            try
            {
                PairFilter filter = pairFilter;
                return filter == null || filter(pair);
            }
            catch (Exception e)
            {
                if (thrown == null) thrown = ExceptionDispatchInfo.Capture(e);
                return true;
            }
            finally { Volatile.Write(ref judging, 0); }
        }

        internal ExceptionDispatchInfo TakeThrown()
        {
            ExceptionDispatchInfo first = thrown;
            if (first != null) thrown = null;
            return first;
        }

        /// <summary>
        /// Sets a function that judges new pairs of shapes, when one of them asks for it (<see
        /// cref="Shape.PairFilter"/>). <see cref="Step"/> calls it on its own thread, once for each pair whose bounds
        /// begin to meet. Its answer holds until they part, or the filter of either shape is set. It may not call this
        /// world: WorldSteppingException. When it throws, the pair may collide and the step goes on; Step throws the
        /// first exception at its end.
        /// </summary>
        /// <param name="filter">null: none</param>
        public void SetPairFilter(PairFilter filter)
        {
            if (filter == null)
            {
                Native.world_set_pair_filter(P, null, null);
                pairFilter = null;
            }
            else
            {
                lock (safe)
                {
                    if (!safe.Judge.IsAllocated) safe.Judge = GCHandle.Alloc(this, GCHandleType.Weak);
                    Native.world_set_pair_filter(P, (void*)Judge.Pointer, (void*)GCHandle.ToIntPtr(safe.Judge));
                    pairFilter = filter;
                }
            }
            GC.KeepAlive(this);
        }
    }
}
