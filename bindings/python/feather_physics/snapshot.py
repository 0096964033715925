"""Worlds as bytes, looked at without a world: World.save() makes them, World.load() and world.restore() read them."""

from typing import Any, List, Optional

from . import _flat, records


def snapshot_info(data: Any) -> records.SnapshotInfo:
    """Makes every check of a restore, but for assets that are not in the bytes, and tells what they hold. A DataError
    for bytes that are cut, altered or of something else, a VersionError for those of a newer format."""
    info = records.copy_record(records.SnapshotInfo, _flat.snapshot_check(data))
    return info._replace(foreign=bool(info.foreign), filter=bool(info.filter))


def snapshot_assets(data: Any) -> List[str]:
    """The keys of the assets that the world in the bytes has, as asset.key tells them; one that is used with several
    scales is there several times."""
    found = records.read_all(_flat.snapshot_get_assets, records.ASSET_KEY, data)
    return [f"{first:016x}{second:016x}" for first, second in found]


def compare_snapshots(first: Any, second: Any) -> Optional[records.Difference]:
    """Where two worlds first differ, told from their bytes: settings, bodies, shapes, joints, pairs, each kind in the
    order of creation, then lists. None: nowhere."""
    found = _flat.snapshot_compare(first, second)
    return None if found is None else records.copy_record(records.Difference, found)
