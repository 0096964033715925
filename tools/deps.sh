#!/usr/bin/env bash
# What the short test (tools/deps.sh check), all tests (test), the fuzzer (fuzz), the tests of one language (python, lua, csharp, wasm: JavaScript), the library
# in one file (amalgamation), the site of the API (docs) and the bench (all) need beyond the C compiler: installs what is missing with apt where it may, and otherwise says what to install and fails. Needs are tried out, not looked up by package name.
set -uo pipefail
wanted=${1:-all}
CC=${CC:-cc} CXX=${CXX:-c++}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo 'int main(void) { return 0; }' > "$work/empty.c"
cp "$work/empty.c" "$work/empty.cpp"
echo 'int LLVMFuzzerTestOneInput(const unsigned char *bytes, unsigned long size) { return bytes && size > 1u << 30; }' > "$work/fuzz.c"
printf '#include <stdarg.h>\n#include <stddef.h>\n#include <setjmp.h>\n#include <stdint.h>\n#include <cmocka.h>\nint main(void) { return 0; }\n' > "$work/cmocka.c"

has() { command -v "$1" > /dev/null; }
links() { "$@" -o "$work/program" > /dev/null 2>&1; }

PYTHON=${PYTHON:-/usr/bin/python3}
python_has() { "$PYTHON" -c "import $1" 2> /dev/null; }
missing_for_python() {
    has swig || echo swig
    has "$PYTHON" && "$PYTHON" -c 'import os, sysconfig; assert os.path.exists(sysconfig.get_paths()["include"] + "/Python.h")' 2> /dev/null || echo python3-dev
    python_has setuptools || echo python3-setuptools
    python_has wheel || echo python3-wheel
    python_has pip || echo python3-pip
    python_has ensurepip || echo python3-venv
    python_has build.env || echo python3-build
    python_has pytest || echo python3-pytest
    python_has numpy || echo python3-numpy
    test -f /usr/include/mujoco/mujoco.h || echo libmujoco-dev
    test -d /usr/share/mujoco/model || echo libmujoco-samples
    python_has matplotlib || echo python3-matplotlib
    python_has nbconvert || echo jupyter-nbconvert
    python_has ipykernel || echo python3-ipykernel
    python_has joblib || echo python3-joblib
    python_has mpi4py || echo python3-mpi4py
    has mpiexec || echo openmpi-bin
    python_has distributed || echo python3-distributed
    has mypy || echo mypy
}

# The SDK of .NET is no package of Debian's: bindings/csharp/test says where it is missing.
missing_for_csharp() {
    has swig || echo swig
    has python3 || echo python3
    has mono || echo mono-runtime
    has mcs || echo mono-mcs
    has unzip || echo unzip
    test -e /usr/lib/mono/4.5/System.Numerics.dll || echo libmono-system-numerics4.0-cil
    test -e /usr/lib/mono/4.5/System.Numerics.Vectors.dll || echo libmono-system-numerics-vectors4.0-cil
}

missing_for_lua() {
    local version
    has swig || echo swig
    for version in 5.1 5.3 5.4; do
        has "lua$version" || echo "lua$version"
        pkg-config --exists "lua$version" 2> /dev/null || echo "liblua$version-$(test "$version" = 5.1 && echo 0-)dev"
    done
    has luajit || echo luajit
    has luarocks || echo luarocks
    has valgrind || echo valgrind
    has love || echo love
    has zip || echo zip
    has lua5.4 && lua5.4 -e 'require("luaunit")' 2> /dev/null || echo lua-unit
}

missing_for_amalgamation() {
    has python3 || echo python3
    ctags --version 2> /dev/null | grep Universal > /dev/null || echo universal-ctags
}

# The runtime is that of the clang that is there.
missing_for_wasm() {
    has llvm-ar || echo llvm
    has wasm-ld || echo lld
    has node || echo nodejs
    test -e /usr/include/wasm32-wasi/stdio.h || echo wasi-libc
    test -e "$(clang --target=wasm32-wasi --print-libgcc-file-name 2> /dev/null)" ||
        clang --version | awk 'match($0, /version [0-9]+/) { print "libclang-rt-" substr($0, RSTART + 8, RLENGTH - 8) "-dev-wasm32" }'
    # for the package's size; without them it is built by what is above
    if test -n "${essential:-}"; then return; fi
    test -e "$(clang-19 --target=wasm32-wasi --print-libgcc-file-name 2> /dev/null)" || echo clang-19 lld-19 libclang-rt-19-dev-wasm32
    has wasm-opt || echo binaryen
}

missing_for_check() {
    links "$CC" "$work/empty.c" || echo gcc libc6-dev
    links "$CC" "$work/cmocka.c" -lcmocka || echo libcmocka-dev
}

# The site of the API, and the comparison of two ABIs; without them the tests say so and go on
missing_for_docs() {
    has doxygen || echo doxygen
    has dot || echo graphviz
}
# Another builder of hulls to compare with; likewise
missing_for_hulls() {
    echo '#include <libqhull_r/libqhull_r.h>' | "$CC" -x c -fsyntax-only - 2> /dev/null || echo libqhull-dev
}
# What the example that loads files reads them with; likewise
missing_for_examples() { pkg-config --exists assimp 2> /dev/null || echo libassimp-dev; }
# A page for the JavaScript package; likewise
missing_for_browser() { has chromium || echo chromium; }
missing_for_abi() { has abidiff || echo abigail-tools; }
# What compiles once what several tests compile alike; likewise
missing_for_cache() { has ccache || echo ccache; }

# Another machine's bits, in an emulator; without it the tests say so and go on
missing_for_aarch64() {
    test "$(uname -m)" = x86_64 || return
    has aarch64-linux-gnu-gcc && links aarch64-linux-gnu-gcc "$work/empty.c" || echo gcc-aarch64-linux-gnu libc6-dev-arm64-cross
    has qemu-aarch64 || echo qemu-user
}

# Another system, by a stand-in for it; likewise
missing_for_windows() {
    test "$(uname -m)" = x86_64 || return
    has x86_64-w64-mingw32-gcc || echo gcc-mingw-w64-x86-64-posix
    has wine || echo wine wine64
}

# 32 bits, and big-endian; likewise
missing_for_foreign() {
    test "$(uname -m)" = x86_64 || return
    has i686-linux-gnu-gcc && links i686-linux-gnu-gcc -static "$work/empty.c" || echo gcc-i686-linux-gnu libc6-dev-i386-cross
    has s390x-linux-gnu-gcc && links s390x-linux-gnu-gcc -static "$work/empty.c" || echo gcc-s390x-linux-gnu libc6-dev-s390x-cross
    has qemu-s390x || echo qemu-user
}

# Prints the missing packages, by their Debian names.
missing() {
    case $wanted in
    check | python | lua | csharp | docs | wasm | amalgamation) "missing_for_$wanted"; return ;;
    esac
    has gcc && links gcc "$work/empty.c" || echo gcc libc6-dev
    has clang && links clang "$work/empty.c" || echo clang
    links "$CXX" "$work/empty.cpp" || echo g++
    has objdump || echo binutils
    links "$CC" "$work/cmocka.c" -lcmocka || echo libcmocka-dev
    links "$CC" -fsanitize=address,undefined "$work/empty.c" && links "$CC" -fsanitize=thread "$work/empty.c" ||
        echo "$("$CC" --version | awk '/clang/ && match($0, /version [0-9]+/) { print "libclang-rt-" substr($0, RSTART + 8, RLENGTH - 8) "-dev" }')"
    if test "$wanted" != fuzz; then missing_for_wasm; fi
    if test "$wanted" != fuzz && test -z "${essential:-}"; then missing_for_aarch64; missing_for_foreign; missing_for_windows; missing_for_browser; missing_for_docs; missing_for_abi; missing_for_cache; missing_for_hulls; missing_for_examples; missing_for_amalgamation; fi
    has cmake || echo cmake
    has pkg-config || echo pkg-config
    has valgrind || echo valgrind
    if test "$wanted" != fuzz; then missing_for_python; missing_for_lua; fi
    if test "$wanted" != fuzz; then missing_for_csharp; fi
    if test "$wanted" != test; then
        clang -fsanitize=fuzzer,address,undefined "$work/fuzz.c" -o "$work/program" > /dev/null 2>&1 ||
            clang --version | awk 'match($0, /version [0-9]+/) { print "libclang-rt-" substr($0, RSTART + 8, RLENGTH - 8) "-dev" }'
    fi
    if test "$wanted" = all; then
        pkg-config --exists bullet 2> /dev/null || echo libbullet-dev
        pkg-config --exists ode 2> /dev/null || echo libode-dev
        pkg-config --exists box2d 2> /dev/null || echo libbox2d-dev
        has clang-format || echo clang-format
    fi
}

as_root() {
    if test "$(id -u)" = 0; then "$@"; else sudo -n "$@"; fi
}
# A mirror may fail once, and another apt may hold the lock.
apt() { as_root env DEBIAN_FRONTEND=noninteractive apt-get -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 "$@" >> "$work/log" 2>&1; }
install_packages() {
    has apt-get && { test "$(id -u)" = 0 || sudo -n true 2> /dev/null; } || return 1
    apt install -y --no-install-recommends "$@" && return
    apt update
    apt install -y --no-install-recommends "$@" && return
    tail -5 "$work/log"
    local package # one by one: a name that this release does not have keeps no other away
    for package; do apt install -y --no-install-recommends "$package" || true; done
}

# In rounds: which runtime a compiler needs is known once it is there.
for _ in 1 2 3; do
    packages=$(missing | sort -u | xargs)
    if test -z "$packages"; then exit 0; fi
    echo "installing: $packages"
    # shellcheck disable=SC2086
    install_packages $packages || break
done
essential=1
packages=$(missing | sort -u | xargs)
if test -z "$packages"; then exit 0; fi
echo "*** MISSING, please install (names of Debian packages): $packages"
exit 1
