// Snapshots: a world as bytes, and back. The layer keeps nothing of a world's bodies, shapes and joints but the handles
// in their values, and the library judges those: a restore leaves nothing here to mend.
using System;
using System.Runtime.InteropServices;

namespace FeatherPhysics
{
    /// <summary>How a snapshot is restored.</summary>
    public sealed class RestoreOptions
    {
        /// <summary>Handles have the world's own number, not that of the saved one.</summary>
        public bool NewNumber;
        /// <summary>
        /// Keys of assets that are not looked for: those in <see cref="Assets"/> stand for them. null: none.
        /// </summary>
        public AssetKey[] Keys;
        /// <summary>An asset of the world's store for each key.</summary>
        public AssetHandle[] Assets;
        /// <summary>For bytes of SaveDiff: the snapshot that they were saved against. null: none.</summary>
        public byte[] Base;
    }

    /// <summary>Where two snapshots first differ.</summary>
    public sealed class Difference
    {
        /// <summary>"body", "shape", "joint", "pair", "world", or a list by its name.</summary>
        public string Kind;
        /// <summary>Which number of it; "there": one of the two does not have it.</summary>
        public string Field;
        /// <summary>The value in the first snapshot, as text.</summary>
        public string A;
        /// <summary>The value in the second one.</summary>
        public string B;
        /// <summary>The body, shape or joint, of a pair the first shape. 0: it has none.</summary>
        public ulong Handle;
        /// <summary>Of a pair the second shape.</summary>
        public ulong Other;
        /// <summary>Of a list's entry or an event, from 0.</summary>
        public int Index;
        /// <summary>Of a field of several numbers, from 0.</summary>
        public int Element;
    }

    /// <summary>What a snapshot says of itself, without a world.</summary>
    public static unsafe class Snapshot
    {
        /// <summary>
        /// Every check of a restore but for assets that are not in the bytes: BadDataException, NewerVersionException.
        /// </summary>
        public static SnapshotInfo Check(ReadOnlySpan<byte> bytes)
        {
            SnapshotInfo info;
            Native.snapshot_info_init(&info, (uint)sizeof(SnapshotInfo));
            byte none = 0;
            fixed (byte* start = &MemoryMarshal.GetReference(bytes))
                Native.snapshot_check(OrEmpty(start, &none), bytes.Length, &info);
            return info;
        }

        /// <summary>
        /// The keys of the assets that a snapshot needs, each once for each scale that it is used with. Returns how
        /// many there are.
        /// </summary>
        public static int GetAssets(ReadOnlySpan<byte> bytes, Span<AssetKey> keys)
        {
            byte none = 0;
            fixed (byte* start = &MemoryMarshal.GetReference(bytes))
            fixed (AssetKey* out_ = &MemoryMarshal.GetReference(keys))
                return Native.snapshot_get_assets(OrEmpty(start, &none), bytes.Length, out_, (uint)sizeof(AssetKey),
                    keys.Length);
        }

        static string Text(byte* first)
        {
            int length = 0;
            while (first[length] != 0) ++length;
            return System.Text.Encoding.ASCII.GetString(first, length);
        }

        /// <summary>
        /// Where two worlds first differ, told from their bytes: settings, then bodies, shapes, joints and pairs, each
        /// kind in the order of creation, then lists and events. null: nowhere.
        /// </summary>
        public static Difference Compare(ReadOnlySpan<byte> first, ReadOnlySpan<byte> second)
        {
            NativeDifference found;
            Native.difference_init(&found, (uint)sizeof(NativeDifference));
            byte none = 0;
            fixed (byte* a = &MemoryMarshal.GetReference(first))
            fixed (byte* b = &MemoryMarshal.GetReference(second))
                if (Native.snapshot_compare(OrEmpty(a, &none), first.Length, OrEmpty(b, &none), second.Length,
                        &found) == 0)
                    return null;
            return new Difference
            {
                Kind = Text(&found.Kind0), Field = Text(&found.Field0), A = Text(&found.A0), B = Text(&found.B0),
                Handle = found.Handle, Other = found.Other, Index = found.Index, Element = found.Element
            };
        }

        /// An empty span has no start, and the library takes none.
        internal static byte* OrEmpty(byte* start, byte* none) { return start == null ? none : start; }
    }

    public sealed unsafe partial class World
    {
        long Write(byte* destination, long capacity, bool withAssets)
        {
            return Write(destination, capacity, withAssets ? NativeSave.Assets : 0, null, 0);
        }

        long Write(byte* destination, long capacity, NativeSave flags, byte* baseAt, long baseSize)
        {
            NativeSaveOptions options;
            Native.save_options_init(&options, (uint)sizeof(NativeSaveOptions));
            options.Flags = flags;
            options.Base = (IntPtr)baseAt;
            options.BaseSize = baseSize;
            long size = Native.world_save(P, &options, destination, capacity);
            GC.KeepAlive(this);
            return size;
        }

        /// <summary>Bytes that <see cref="Save(Span{byte}, bool)"/> would write now.</summary>
        /// <param name="withAssets">see there</param>
        public long GetSnapshotSize(bool withAssets = false) { return Write(null, 0, withAssets); }

        /// <summary>
        /// Writes the world as bytes, between two calls: all that decides how it goes on, and what it tells of the last
        /// step. The same state gives the same bytes on every machine. Not in them are workers, pool, store, SIMD set
        /// and the pair filter. Returns how many there are; BadArgumentException when they do not fit.
        /// </summary>
        /// <param name="destination">begins with them afterwards</param>
        /// <param name="withAssets">
        /// The contents of its assets are in the bytes, too: where they are loaded, none need be there.
        /// false: assets go by their keys.
        /// </param>
        public int Save(Span<byte> destination, bool withAssets = false)
        {
            long size;
            fixed (byte* start = &MemoryMarshal.GetReference(destination))
                size = Write(start, destination.Length, withAssets);
            CheckLength(size, destination.Length, "World.Save", "destination");
            return (int)size;
        }
        /// <summary>The same in an array of its own.</summary>
        public byte[] Save(bool withAssets = false)
        {
            byte[] bytes = new byte[GetSnapshotSize(withAssets)];
            Save(bytes, withAssets);
            return bytes;
        }

        /// <summary>Bytes that <see cref="SaveDiff(Span{byte}, ReadOnlySpan{byte})"/> needs room for.</summary>
        /// <param name="baseBytes">of Save()</param>
        public long GetDiffRoom(ReadOnlySpan<byte> baseBytes)
        {
            byte none = 0;
            fixed (byte* start = &MemoryMarshal.GetReference(baseBytes))
                return Write(null, 0, NativeSave.Diff, Snapshot.OrEmpty(start, &none), baseBytes.Length);
        }

        /// <summary>
        /// Writes what differs from a snapshot: from one step to the next a tenth of the whole or less. Who restores
        /// it has that snapshot, too. Returns how many bytes there are. BadDataException when the base is no whole
        /// snapshot, BadArgumentException when the destination is smaller than <see cref="GetDiffRoom"/>.
        /// </summary>
        /// <param name="destination">begins with them afterwards; what stands behind them means nothing</param>
        /// <param name="baseBytes">of Save(), not in the destination</param>
        public int SaveDiff(Span<byte> destination, ReadOnlySpan<byte> baseBytes)
        {
            long size;
            byte none = 0;
            fixed (byte* start = &MemoryMarshal.GetReference(destination))
            fixed (byte* baseAt = &MemoryMarshal.GetReference(baseBytes))
                size = Write(start, destination.Length, NativeSave.Diff, Snapshot.OrEmpty(baseAt, &none),
                    baseBytes.Length);
            CheckLength(size, destination.Length, "World.SaveDiff", "destination");
            return (int)size;
        }
        /// <summary>The same in an array of its own.</summary>
        public byte[] SaveDiff(ReadOnlySpan<byte> baseBytes)
        {
            byte[] bytes = new byte[GetDiffRoom(baseBytes)];
            Array.Resize(ref bytes, SaveDiff(bytes, baseBytes));
            return bytes;
        }

        /// What the library takes, but for the addresses of the arrays, which the caller pins.
        static NativeRestoreOptions Prepare(RestoreOptions options, string where, out AssetKey[] keys,
            out AssetHandle[] assets)
        {
            NativeRestoreOptions native;
            Native.restore_options_init(&native, (uint)sizeof(NativeRestoreOptions));
            keys = options == null ? null : options.Keys;
            assets = options == null ? null : options.Assets;
            native.NewNumber = options != null && options.NewNumber ? 1 : 0;
            native.AssetCount = keys == null ? 0 : keys.Length;
            native.BaseSize = options == null || options.Base == null ? 0 : options.Base.Length;
            int assetCount = assets == null ? 0 : assets.Length;
            CheckLength(native.AssetCount, assetCount, where, "Assets");
            CheckLength(assetCount, native.AssetCount, where, "Keys");
            return native;
        }

        /// <summary>
        /// Makes the world the saved one: any bytes fit any world. What was made since is not valid, and its handles
        /// may be given again to something else. Store, workers and pair filter stay. A call that throws has changed
        /// nothing. Bytes from anywhere may be given: BadDataException, NewerVersionException for what is not sound,
        /// WrongStateException when an asset is missing, or when the saved world had a pair filter and this one has
        /// none.
        /// </summary>
        /// <param name="bytes">of Save(); nothing keeps them</param>
        /// <param name="options">null: the defaults</param>
        /// <returns>
        /// true: it goes on bit for bit. false: it goes on otherwise, for a library saved it whose results differ
        /// </returns>
        public bool Restore(ReadOnlySpan<byte> bytes, RestoreOptions options = null)
        {
            byte none = 0;
            AssetKey[] keys;
            AssetHandle[] assets;
            NativeRestoreOptions native = Prepare(options, "World.Restore", out keys, out assets);
            fixed (byte* start = &MemoryMarshal.GetReference(bytes))
            fixed (AssetKey* keysAt = keys)
            fixed (AssetHandle* assetsAt = assets)
            fixed (byte* baseAt = options == null ? null : options.Base)
            {
                native.Base = (IntPtr)baseAt;
                native.Keys = (IntPtr)keysAt;
                native.Assets = (IntPtr)assetsAt;
                int result = Native.world_restore(P, &native, Snapshot.OrEmpty(start, &none), bytes.Length);
                GC.KeepAlive(this);
                return result == (int)Result.Ok;
            }
        }

        /// <summary>
        /// A new world from the bytes, see <see cref="Restore"/>. <see cref="Snapshot.Check"/> tells whether it goes on
        /// bit for bit. WrongStateException when the saved world had a pair filter: make a world, set its filter, then
        /// restore.
        /// </summary>
        /// <param name="bytes">of Save(); nothing keeps them</param>
        /// <param name="def">
        /// Its workers and SIMD set count, and with <see cref="RestoreOptions.NewNumber"/> its number; all else is the
        /// saved world's. null: the defaults
        /// </param>
        /// <param name="pool">null: workers of its own</param>
        /// <param name="store">where its assets are; null: a store of its own</param>
        /// <param name="options">null: the defaults</param>
        public static World Load(ReadOnlySpan<byte> bytes, WorldDef def = null, Pool pool = null, Store store = null,
            RestoreOptions options = null)
        {
            byte none = 0;
            AssetKey[] keys;
            AssetHandle[] assets;
            NativeRestoreOptions native = Prepare(options, "World.Load", out keys, out assets);
            fixed (byte* start = &MemoryMarshal.GetReference(bytes))
            fixed (AssetKey* keysAt = keys)
            fixed (AssetHandle* assetsAt = assets)
            fixed (byte* baseAt = options == null ? null : options.Base)
            {
                native.Base = (IntPtr)baseAt;
                native.Keys = (IntPtr)keysAt;
                native.Assets = (IntPtr)assetsAt;
                return new World(def, pool, store, &native, Snapshot.OrEmpty(start, &none), bytes.Length);
            }
        }
    }
}
