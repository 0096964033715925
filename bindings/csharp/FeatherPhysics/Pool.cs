// Worker threads that several worlds may share.
using System;
using System.Runtime.InteropServices;

namespace FeatherPhysics
{
    /// <summary>Worker threads that several worlds may share. It lives at least as long as its worlds.</summary>
    public sealed unsafe class Pool : IDisposable
    {
        internal sealed class PoolHandle : SafeHandle
        {
            public PoolHandle() : base(IntPtr.Zero, true) { }
            public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
            public void Set(IntPtr pool) { SetHandle(pool); }
            protected override bool ReleaseHandle() { return NativePINVOKE.pool_destroy((void*)handle) == 0; }
        }

        internal readonly PoolHandle Safe = new PoolHandle();
        volatile bool disposed;

        /// <param name="workers">1..64, the thread that steps among them</param>
        public Pool(int workers)
        {
            IntPtr made;
            Native.pool_create(workers, &made);
            Safe.Set(made);
        }

        /// <summary>The threads end with the last world that uses them.</summary>
        public void Dispose()
        {
            disposed = true;
            Safe.Dispose();
        }

        internal void Hold(ref bool held)
        {
            if (disposed) throw new ObjectDisposedException("Pool", "Pool: the pool is disposed");
            Safe.DangerousAddRef(ref held);
        }
    }
}
