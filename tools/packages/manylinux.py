#!/usr/bin/env python3
"""Gives a wheel of Linux the tag manylinux_2_N that its binaries allow (PEP 600).

N is the newest version of glibc among their symbols. A binary that needs a library outside PEP 600's list is refused:
such a wheel would not load on another machine.

Usage: manylinux.py WHEEL FOLDER      with OBJDUMP, if the wheel is for another machine
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

# what every Linux with that glibc has
ALLOWED = {
    "libc.so.6",
    "libm.so.6",
    "libpthread.so.0",
    "libdl.so.2",
    "librt.so.1",
    "ld-linux-x86-64.so.2",
    "ld-linux-aarch64.so.1",
}
OBJDUMP = os.environ.get("OBJDUMP", "objdump")
HERE = Path(__file__).resolve().parent


def needed(binary):
    text = subprocess.run([OBJDUMP, "-p", binary], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"NEEDED\s+(\S+)", text))


def tag(binaries):
    """manylinux_2_N for these files; an error with a sentence where there is none."""
    for binary in binaries:
        foreign = needed(binary) - ALLOWED
        if foreign:
            sys.exit(f"{binary.name} needs {', '.join(sorted(foreign))}, which a manylinux wheel may not.")
    newest = subprocess.run([HERE / "glibc", *binaries], capture_output=True, text=True, check=True).stdout.strip()
    return "manylinux_" + "_".join(newest.split(".")[:2])


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    wheel, folder = map(Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as work:
        subprocess.run(
            [sys.executable, "-m", "wheel", "unpack", "--dest", work, wheel], check=True, stdout=subprocess.DEVNULL
        )
        (tree,) = Path(work).iterdir()
        name = tag(sorted(tree.rglob("*.so")))
        (info,) = tree.glob("*.dist-info/WHEEL")
        text, count = re.subn(r"(?m)^(Tag: \S+-\S+-)linux_", rf"\g<1>{name}_", info.read_text())
        if count == 0:
            sys.exit(f"{wheel.name} has no tag of Linux.")
        info.write_text(text)
        subprocess.run(
            [sys.executable, "-m", "wheel", "pack", "--dest-dir", folder, tree], check=True, stdout=subprocess.DEVNULL
        )


main()
