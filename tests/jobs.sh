# What tests/run, tests/check and tests/long have in common; each sources it from the project's folder, with `out` and
# `limit` set: a folder, and seconds of processor time for one job.
#
# A check is a job: a name and a command. It passes when the command does, and then counts as many as cmocka's summaries in its output say, or 1.
# Output is kept in $out/log. Jobs run side by side, one on each processor; finish names what failed and prints "N passed, M failed".
set -uo pipefail
export CC=${CC:-cc} CXX=${CXX:-c++} MAKE=${MAKE:-make}
export LC_ALL=C.UTF-8 # times with a point, whatever the user's language
unset MAKEFLAGS MFLAGS MAKELEVEL # each build below says itself what it wants
# Many checks compile the same sources alike, each in a folder of its own: where there is ccache, they are compiled once.
if test -d /usr/lib/ccache && test -z "${CCACHE_DIR:-}"; then
    export PATH=/usr/lib/ccache:$PATH CCACHE_DIR=$PWD/build/ccache CCACHE_NOHASHDIR=1
fi
jobs=$(nproc 2> /dev/null || echo 2)
export limit stall=600 # stall: seconds of the clock, after which a job that computes nothing hangs
export logs=$out/log results=$out/results # folder; file with "passed failed" lines
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1
export UBSAN_OPTIONS=print_stacktrace=1 TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1
rm -rf "$logs"
mkdir -p "$logs"
if test -z "${HOME:-}"; then export HOME=$PWD/$out/home; mkdir -p "$HOME"; fi # dotnet, luarocks and love want one
: > "$results"
: > "$results.failed" # their names

# report name seconds status log: prints the line and counts the test cases, which cmocka's summary tells
report() {
    local passed failed skipped note=
    read -r passed failed skipped < <(awk '
        /^\[  PASSED  \] [0-9]+ test/ { p += $4 }
        /^\[  FAILED  \] [0-9]+ test/ { f += $4 }
        /^\[  SKIPPED \] [0-9]+ test/ { s += $4 }
        END { print p + 0, f + 0, s + 0 }' "$4")
    if test "$3" != 0 && test "$failed" = 0; then failed=1; fi
    if test "$3" = 0 && test "$passed$skipped" = 00; then passed=1; fi
    test "$skipped" = 0 || note=", $skipped SKIPPED"
    test "$3" != 124 || note="$note, $(grep -aoE 'over the limit of [0-9]+ s|hangs' "$4" | tail -1)"
    if test "$failed" = 0; then
        printf 'ok    %-44s %6.1f s  %d%s\n' "$1" "$2" "$passed" "$note"
    else
        printf 'FAIL  %-44s %6.1f s  %d of %d failed%s\n%s\n' "$1" "$2" "$failed" "$((passed + failed))" "$note" \
            "$(grep -vE '^\[ +(RUN|OK) +\]|^  [^ ]+$' "$4" | awk '
                { line[NR] = $0 }
                /FAILED|rror:|Sanitizer|^failed/ && told < 12 { print "      | " $0; ++told }
                END {
                    if (told) print "      | ..."
                    for (i = 1; i <= NR; ++i) if (i <= 15 || i > NR - 10) print "      | " line[i]; else if (i == 16) print "      | ..."
                }')"
        echo "$1" >> "$results.failed"
    fi
    echo "$passed $failed" >> "$results"
}

# job "name|command"
job() {
    local name=${1%%|*} command=${1#*|} start=$EPOCHREALTIME
    local log=$logs/${name//[\/ ]/_} status seconds
    tests/limit "$limit" "$stall" bash -c "$command" > "$log" 2>&1
    status=$?
    seconds=$(awk "BEGIN { print $EPOCHREALTIME - $start }")
    report "$name" "$seconds" $status "$log"
    test $status = 0
}
export -f job report

# build folder name arguments...: -k: one program that does not compile does not hide the others; and where warnings are errors and one is found,
# the build fails but its tests still run.
build() {
    local folder=$1 name=$2
    shift 2
    local make="$MAKE -k -j$jobs BUILD=$folder $*"
    job "$name|$make || { $make WERROR=0 > /dev/null 2>&1; false; }"
}

# programs folder prefix command filter: a job for each test program of that build whose name the filter matches
programs() {
    local source name
    for source in tests/*/test_*.c; do
        name=${source#tests/}
        name=${name%.c}
        if [[ -f $source && $name =~ $4 ]]; then echo "$2$name|$3$1/tests/$name"; fi
    done
}

# sanitized thread|address in|out: the programs that tests/sanitized chooses for `make test` under that sanitizer; or the others, of which the
# thread sanitizer has something to say where they start threads
sanitized() {
    local sources=(tests/*/test_*.c)
    if test "$1" = thread; then mapfile -t sources < <(grep -lE 'workers|worker_count|pthread_create|pool_create' "${sources[@]}"); fi
    printf '%s\n' "${sources[@]}" | sed 's|^tests/||; s|\.c$||' | awk -v kind="$1" -v wanted="$2" '
        FNR == NR { if ($1 == kind) { sign[++n] = $2; pattern[n] = "^(" $3 ")$" } next }
        { chosen = "out"; for (i = 1; i <= n; ++i) if ($0 ~ pattern[i]) chosen = sign[i] == "+" ? "in" : "out" }
        chosen == wanted' tests/sanitized -
}
# build_sanitized thread|address folder SIMD-sets programs. The kernels are one source, and take half of the time to build
build_sanitized() {
    local kinds=$1 sets=$3
    if test "$1" = address; then kinds=address,undefined; fi
    build "$2" "build with -fsanitize=$kinds" SANITIZE=$kinds OPT=-O1 SIMD_OPT=-O1 WERROR=0 "'SIMD_SETS=$sets'" \
        "$(for name in $4; do printf '%s ' "$2/tests/$name"; done)"
}
# ThreadSanitizer needs its addresses free, which a randomized layout with many bits does not leave.
fixed_layout=
if setarch -R true 2> /dev/null; then fixed_layout="setarch -R "; fi

finish() {
    local passed failed
    read -r passed failed < <(awk '{ p += $1; f += $2 } END { print p + 0, f + 0 }' "$results")
    if test -s "$results.failed"; then sed 's/^/failed: /' "$results.failed"; fi
    echo "$passed passed, $failed failed"
    test "$failed" = 0 && test "$passed" != 0
    exit
}
# run_jobs [function]: the checks on stdin, each by job or by that function. $slot: a number from 0 on that no two at once have.
run_jobs() { xargs -r -d '\n' -P "$jobs" --process-slot-var=slot -I{} bash -c '"$1" "$2"' _ "${1:-job}" {}; }
