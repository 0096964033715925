"""Builds the Python package. The Makefile makes the core with all its SIMD sets, SWIG makes the wrapper, setuptools
links the two into one module.

It needs a C compiler, make, SWIG and Python's header. FEATHER_ARCHIVE=path takes a libfeather.a that exists already.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
# what draws a world's picture; the rest of the folder is a program of its own
PICTURE = sorted(f"tools/picture/{p.name}" for p in (ROOT / "tools/picture").glob("*.c") if p.name not in ("main.c", "scenes.c"))


def version():
    header = (ROOT / "include/feather.h").read_text()
    return ".".join(re.search(rf"define FE_VERSION_{part} (\d+)", header).group(1) for part in ("MAJOR", "MINOR", "PATCH"))


class BuildFlat(build_ext):
    def build_extension(self, extension):
        work = Path(self.build_temp).resolve() / "feather"
        work.mkdir(parents=True, exist_ok=True)
        archive = os.environ.get("FEATHER_ARCHIVE")
        if not archive:
            environment = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
            jobs = f"-j{os.cpu_count() or 1}"
            subprocess.run(["make", "-s", jobs, f"BUILD={work}", "static"], cwd=ROOT, env=environment, check=True)
            archive = str(work / "libfeather.a")
        wrapper = str(work / "flat.c")
        command = [os.environ.get("SWIG", "swig"), "-python", "-builtin", "-Iinclude", "-Ibindings", "-outdir", str(work), "-o", wrapper]
        subprocess.run([*command, "bindings/feather.i"], cwd=ROOT, check=True)
        extension.sources = [wrapper, *PICTURE]
        extension.extra_objects = [archive]
        super().build_extension(extension)


hidden = ["-Wl,--exclude-libs,ALL"] if sys.platform.startswith("linux") else []
setup(
    version=version(),
    ext_modules=[
        Extension(
            "feather_physics._flat",
            sources=[],
            include_dirs=[str(ROOT / "include"), str(ROOT / "bindings")],
            extra_compile_args=["-O2", "-g0", "-ffp-contract=off", "-fvisibility=hidden", "-Wno-unused-but-set-variable"],
            extra_link_args=["-pthread", "-lm", *hidden],
        )
    ],
    cmdclass={"build_ext": BuildFlat},
)
