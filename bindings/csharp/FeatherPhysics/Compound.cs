// Compounds: fe_compound_* as members.
using System;
using System.Runtime.InteropServices;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#else
using System.Numerics;
#endif

namespace FeatherPhysics
{
    public sealed unsafe partial class Store
    {
        /// <summary>
        /// One form of several parts, for any number of shapes of the store's worlds: <c>body.AddCompound(table)</c>.
        /// Hits, contacts and events tell the place of the part. The parts are copied; their assets live as long as the
        /// compound.
        /// </summary>
        /// <param name="parts">1..65535, of any form but planes and compounds</param>
        public Compound CreateCompound(ReadOnlySpan<CompoundPart> parts)
        {
            bool held = false;
            try
            {
                fixed (CompoundPart* start = &MemoryMarshal.GetReference(parts))
                {
                    ulong made;
                    Native.compound_create(Enter(ref held), start, (uint)sizeof(CompoundPart), parts.Length, &made);
                    return new Compound(this, made);
                }
            }
            finally { Leave(held); }
        }

        /// <summary>The same of parts one by one.</summary>
        public Compound CreateCompound(params CompoundPart[] parts)
        {
            World.NotNull(parts, "Store.CreateCompound");
            return CreateCompound(new ReadOnlySpan<CompoundPart>(parts));
        }

        /// <summary>
        /// The compound of which Save() made the bytes, with the assets of its parts. Bytes from anywhere may be given:
        /// BadDataException, NewerVersionException for what is not sound, WrongKindException for another asset's.
        /// </summary>
        public Compound LoadCompound(ReadOnlySpan<byte> bytes)
        {
            return new Compound(this, Load(bytes, GeometryType.Compound, "Store.LoadCompound"));
        }
    }

    public unsafe partial struct CompoundPart
    {
        /// <summary>With the shape's density and material. Begin with this: a bare <c>new CompoundPart()</c> is no part.
        /// </summary>
        public CompoundPart(Geometry geometry)
        {
            CompoundPart made;
            Native.compound_part_init(&made, (uint)sizeof(CompoundPart));
            made.Geometry = geometry;
            this = made;
        }
        /// <summary>A form at a place in the compound's space, m, not turned.</summary>
        /// <param name="geometry">any but a plane and a compound</param>
        /// <param name="position">in the compound's space, m</param>
        public CompoundPart(Geometry geometry, Vector3 position) : this(geometry) { Frame.Position = position; }
        /// <summary>A form at a place in the compound's space, m.</summary>
        public CompoundPart(Geometry geometry, Vector3 position, Quaternion rotation) : this(geometry)
        {
            Frame = new Frame(position, rotation);
        }

        /// <summary>The same part with a material of its own.</summary>
        public CompoundPart WithMaterial(SurfaceMaterial material)
        {
            CompoundPart made = this;
            made.OwnMaterial = true;
            made.Material = material;
            return made;
        }
    }

    /// <summary>A form of several parts that shapes of many worlds may share. A value that keeps its store alive.</summary>
    public readonly unsafe struct Compound : IEquatable<Compound>
    {
        readonly Asset asset;

        internal Compound(Store store, ulong id) { asset = new Asset(store, id); }

        /// <summary>The store that it is in.</summary>
        public Store Store { get { return asset.Store; } }
        /// <summary>Its handle, as geometries have it.</summary>
        public AssetHandle Handle { get { return new AssetHandle(asset.Id); } }
        /// <summary>False once it is destroyed, or its store disposed.</summary>
        public bool IsValid { get { return asset.IsAlive; } }
        /// <summary>The handle dies at once. The compound lives until the last shape that has it is gone.</summary>
        public void Destroy() { asset.Destroy("Compound"); }
        /// <summary>What it is known by in snapshots.</summary>
        public AssetKey GetKey() { return asset.Key("Compound"); }
        /// <summary>
        /// As bytes, the same on every machine, for <see cref="Store.LoadCompound"/>: with the assets of its parts.
        /// </summary>
        public byte[] Save() { return asset.Save("Compound"); }

        /// <summary>How many parts, their bounds, memory.</summary>
        public CompoundInfo Info
        {
            get
            {
                bool held = false;
                try
                {
                    CompoundInfo info;
                    Native.compound_info_init(&info, (uint)sizeof(CompoundInfo));
                    Native.compound_get_info(Enter(ref held), asset.Id, &info);
                    return info;
                }
                finally { Leave(held); }
            }
        }
        /// <summary>
        /// A part by its place, as hits, contacts and events tell it. Its rotation has length 1; a scale of 0, 0, 0 has
        /// become 1, 1, 1.
        /// </summary>
        public CompoundPart GetPart(int part)
        {
            bool held = false;
            try
            {
                CompoundPart made;
                Native.compound_part_init(&made, (uint)sizeof(CompoundPart));
                Native.compound_get_part(Enter(ref held), asset.Id, part, &made);
                return made;
            }
            finally { Leave(held); }
        }

        void* Enter(ref bool held) { return asset.Enter("Compound", ref held); }
        void Leave(bool held) { asset.Leave(held); }

        /// <inheritdoc/>
        public bool Equals(Compound other) { return asset.Equals(other.asset); }
        /// <inheritdoc/>
        public override bool Equals(object other) { return other is Compound && Equals((Compound)other); }
        /// <inheritdoc/>
        public override int GetHashCode() { return asset.GetHashCode(); }
        /// <summary>Do both name the same?</summary>
        public static bool operator ==(Compound a, Compound b) { return a.Equals(b); }
        /// <summary>The opposite of ==.</summary>
        public static bool operator !=(Compound a, Compound b) { return !a.Equals(b); }
        /// <inheritdoc/>
        public override string ToString() { return "Compound " + asset; }
    }
}
