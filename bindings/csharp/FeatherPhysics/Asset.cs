// What heightfields, hulls, meshes and compounds are: a handle in a store, which it keeps alive.
using System;

namespace FeatherPhysics
{
    internal readonly unsafe struct Asset : IEquatable<Asset>
    {
        internal readonly Store Store; // null in a default value
        internal readonly ulong Id;

        internal Asset(Store store, ulong id) { Store = store; Id = id; }

        internal bool IsAlive
        {
            get
            {
                if (Store == null) return false;
                bool held = false;
                try { return Native.asset_is_valid(Store.Enter(ref held), Id) != 0; }
                catch (ObjectDisposedException) { return false; }
                finally { Store.Leave(held); }
            }
        }
        internal void Destroy(string kind)
        {
            bool held = false;
            try { Native.asset_destroy(Enter(kind, ref held), Id); }
            finally { Leave(held); }
        }
        internal byte[] Save(string kind)
        {
            bool held = false;
            try
            {
                void* store = Enter(kind, ref held);
                byte[] bytes = new byte[Native.asset_save(store, Id, null, 0)];
                fixed (byte* start = bytes) Native.asset_save(store, Id, start, bytes.Length);
                return bytes;
            }
            finally { Leave(held); }
        }
        internal AssetKey Key(string kind)
        {
            bool held = false;
            try
            {
                AssetKey key;
                Native.asset_get_key(Enter(kind, ref held), Id, &key);
                return key;
            }
            finally { Leave(held); }
        }
        internal void* Enter(string kind, ref bool held)
        {
            if (Store == null) throw new StaleHandleException(kind + ": a default value, of no store");
            return Store.Enter(ref held);
        }
        internal void Leave(bool held) { if (held) Store.Leave(true); }

        public bool Equals(Asset other) { return Store == other.Store && Id == other.Id; }
        public override bool Equals(object other) { return other is Asset && Equals((Asset)other); }
        public override int GetHashCode() { return Id.GetHashCode(); }
        public override string ToString() { return "0x" + Id.ToString("x"); }
    }
}
