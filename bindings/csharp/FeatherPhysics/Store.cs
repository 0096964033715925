// A store of assets, and the heightfields in it: fe_store_*, fe_heightfield_*, fe_asset_* as members. Hulls, meshes
// and compounds are in Hull.cs, Mesh.cs and Compound.cs.
using System;
using System.Runtime.InteropServices;

namespace FeatherPhysics
{
    /// <summary>
    /// Assets that several worlds may share. Any thread may create, read and destroy assets while worlds that use the
    /// store step. A world without one has a store of its own: <see cref="World.Store"/>.
    /// </summary>
    public sealed unsafe partial class Store : IDisposable
    {
        internal sealed class StoreHandle : SafeHandle
        {
            public StoreHandle() : base(IntPtr.Zero, true) { }
            public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
            public void Set(IntPtr store) { SetHandle(store); }
            protected override bool ReleaseHandle() { return NativePINVOKE.store_destroy((void*)handle) == 0; }
        }

        /// Null for the own store of a world, which goes with that world.
        internal readonly StoreHandle Safe;
        readonly World owner;
        readonly IntPtr pointer;
        volatile bool disposed;

        /// <summary>A store that several worlds may share.</summary>
        /// <param name="def">null: the defaults</param>
        public Store(StoreDef def = null)
        {
            IntPtr made;
            if (def == null) Native.store_create(null, &made);
            else fixed (uint* start = &def.StructSize) Native.store_create(start, &made);
            Safe = new StoreHandle();
            Safe.Set(made);
            pointer = made;
        }

        internal Store(World owner, IntPtr pointer)
        {
            this.owner = owner;
            this.pointer = pointer;
        }

        /// <summary>The store goes with the last world that uses it, a world's own store with that world.</summary>
        public void Dispose()
        {
            if (Safe == null) return;
            disposed = true;
            Safe.Dispose();
        }

        /// Keeps the store until Leave(held), or throws ObjectDisposedException.
        internal void* Enter(ref bool held)
        {
            if (Safe == null) owner.Hold(ref held);
            else Hold(ref held);
            return (void*)pointer;
        }
        internal void Hold(ref bool held)
        {
            if (disposed) throw new ObjectDisposedException("Store", "Store: the store is disposed");
            Safe.DangerousAddRef(ref held);
        }
        internal void Leave(bool held)
        {
            if (!held) return;
            if (Safe != null) Safe.DangerousRelease();
            else owner.Release();
        }

        /// <summary>Memory of the store and its assets.</summary>
        public long Bytes
        {
            get
            {
                bool held = false;
                try
                {
                    long value;
                    Native.store_get_bytes(Enter(ref held), &value);
                    return value;
                }
                finally { Leave(held); }
            }
        }

        /// <summary>Terrain for any number of shapes of the store's worlds: <c>body.AddTerrain(field)</c>.</summary>
        public Heightfield CreateHeightfield(HeightfieldDef def)
        {
            const string where = "Store.CreateHeightfield";
            World.NotNull(def, where);
            // copies, so that what is checked is what is read, whatever another thread does to the definition
            int rows = def.Rows, columns = def.Columns;
            float[] heights = def.Heights;
            byte[] holes = def.Holes, cellMaterials = def.CellMaterials;
            SurfaceMaterial[] materials = def.Materials;
            World.CheckLength((long)rows * columns, heights == null ? 0 : heights.Length, where, "Heights");
            long cells = Math.Max(0, (long)rows - 1) * Math.Max(0, (long)columns - 1);
            if (holes != null) World.CheckLength(cells, holes.Length, where, "Holes");
            if (cellMaterials != null) World.CheckLength(cells, cellMaterials.Length, where, "CellMaterials");
            NativeHeightfield native;
            Native.heightfield_def_init(&native, (uint)sizeof(NativeHeightfield));
            native.Rows = rows;
            native.Columns = columns;
            native.CellX = def.CellX;
            native.CellZ = def.CellZ;
            native.MaterialCount = materials == null ? 0 : materials.Length;
            bool held = false;
            try
            {
                fixed (float* heightsAt = heights)
                fixed (byte* holesAt = holes)
                fixed (byte* cellMaterialsAt = cellMaterials)
                fixed (SurfaceMaterial* materialsAt = materials)
                {
                    native.Heights = (IntPtr)heightsAt;
                    native.Holes = (IntPtr)holesAt;
                    native.CellMaterials = (IntPtr)cellMaterialsAt;
                    native.Materials = (IntPtr)materialsAt;
                    ulong made;
                    Native.heightfield_create(Enter(ref held), &native, &made);
                    return new Heightfield(this, made);
                }
            }
            finally { Leave(held); }
        }

        /// <summary>
        /// The heightfield of which Save() made the bytes. Bytes from anywhere may be given:
        /// BadDataException, NewerVersionException for what is not sound, WrongKindException for another asset's.
        /// </summary>
        public Heightfield LoadHeightfield(ReadOnlySpan<byte> bytes)
        {
            return new Heightfield(this, Load(bytes, GeometryType.Heightfield, "Store.LoadHeightfield"));
        }
        internal ulong Load(ReadOnlySpan<byte> bytes, GeometryType type, string where)
        {
            bool held = false;
            try
            {
                void* store = Enter(ref held);
                ulong made;
                // an empty span has no start, and the library takes none
                byte none = 0;
                fixed (byte* start = &MemoryMarshal.GetReference(bytes))
                    Native.asset_load(store, start == null ? &none : start, bytes.Length, &made);
                if ((GeometryType)Native.asset_get_type(store, made) == type) return made;
                Native.asset_destroy(store, made);
                throw new WrongKindException(where + ": the bytes are those of another kind of asset");
            }
            finally { Leave(held); }
        }
    }

    /// <summary>
    /// A grid of heights, see <see cref="Store.CreateHeightfield"/>: sample (row, column) stands at x = column CellX,
    /// z = row CellZ.
    /// </summary>
    public sealed class HeightfieldDef
    {
        /// <summary>Samples along z and along x.</summary>
        public int Rows, Columns;
        /// <summary>m from column to column and from row to row.</summary>
        public float CellX = 1, CellZ = 1;
        /// <summary>Rows x Columns, row by row, m.</summary>
        public float[] Heights;
        /// <summary>(Rows - 1) x (Columns - 1), 1: a hole; null: none.</summary>
        public byte[] Holes;
        /// <summary>A cell each: index into <see cref="Materials"/>; null: the shape's.</summary>
        public byte[] CellMaterials;
        /// <summary>Replace the material of the shape, by cell.</summary>
        public SurfaceMaterial[] Materials;
    }

    /// <summary>Terrain that shapes of many worlds may share. A value that keeps its store alive.</summary>
    public readonly unsafe struct Heightfield : IEquatable<Heightfield>
    {
        readonly Asset asset;

        internal Heightfield(Store store, ulong id) { asset = new Asset(store, id); }

        /// <summary>The store that it is in.</summary>
        public Store Store { get { return asset.Store; } }
        /// <summary>Its handle, as geometries have it.</summary>
        public AssetHandle Handle { get { return new AssetHandle(asset.Id); } }
        /// <summary>False once it is destroyed, or its store disposed.</summary>
        public bool IsValid { get { return asset.IsAlive; } }
        /// <summary>The handle dies at once. Its heights live until the last shape that has them is gone.</summary>
        public void Destroy() { asset.Destroy("Heightfield"); }
        /// <summary>What it is known by in snapshots. SetHeights changes it.</summary>
        public AssetKey GetKey() { return asset.Key("Heightfield"); }
        /// <summary>As bytes, the same on every machine, for <see cref="Store.LoadHeightfield"/>.</summary>
        public byte[] Save() { return asset.Save("Heightfield"); }
        /// <summary>
        /// Changes the samples of a rectangle. Bodies near it wake in every world. WorldSteppingException while a world
        /// that uses it steps.
        /// </summary>
        public void SetHeights(int row, int column, int rows, int columns, ReadOnlySpan<float> heights)
        {
            World.CheckLength((long)rows * columns, heights.Length, "Heightfield.SetHeights", "heights");
            bool held = false;
            try
            {
                fixed (float* start = &MemoryMarshal.GetReference(heights))
                    Native.heightfield_set_heights(Enter(ref held), asset.Id, row, column, rows, columns, start);
            }
            finally { Leave(held); }
        }
        /// <summary>Reads the samples of a rectangle, row by row, m.</summary>
        public void GetHeights(int row, int column, int rows, int columns, Span<float> heights)
        {
            World.CheckLength((long)rows * columns, heights.Length, "Heightfield.GetHeights", "heights");
            bool held = false;
            try
            {
                fixed (float* start = &MemoryMarshal.GetReference(heights))
                    Native.heightfield_get_heights(Enter(ref held), asset.Id, row, column, rows, columns, start);
            }
            finally { Leave(held); }
        }

        void* Enter(ref bool held) { return asset.Enter("Heightfield", ref held); }
        void Leave(bool held) { asset.Leave(held); }

        /// <inheritdoc/>
        public bool Equals(Heightfield other) { return asset.Equals(other.asset); }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is Heightfield && Equals((Heightfield)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return asset.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(Heightfield a, Heightfield b) { return a.Equals(b); }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(Heightfield a, Heightfield b) { return !a.Equals(b); }
        /// <inheritdoc/>
        public override string ToString() { return "Heightfield " + asset; }
    }
}
