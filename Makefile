# Feather's build for Linux and other systems with GNU make and gcc or clang. CMakeLists.txt builds the same library.
#
#   make            build/libfeather.a and build/libfeather.so
#   make demo       builds the library and runs examples/demo.c; needs a C compiler and make, nothing else
#   make check      what a change is tried with first: builds, and asks the fast tests, in under two minutes on 2 cores
#   make test       everything that is checked before a change is accepted (TESTS=pattern: the matching programs only)
#   make test-long  what takes too long for each change, in parts of an hour at most: LONG=laws, soak, fuzz, mutations or rest, or a pattern.
#                   Each prints its seed; SEED=that one goes on where it ended
#   make test-state what of that is about snapshots: 1000 random moments of 100 random scenes, 90 000 altered snapshots
#   make test-many  what of that is about many worlds: 1000 batches beside loops, 1 000 000 resets
#   make python     the Python package in build/python; make test-python: its tests; likewise for the other languages of bindings/
#   make fuzz       FUZZ_SECONDS=600 of random calls of the API, then COOKED_SECONDS=120 of broken bytes of assets and
#                   STATE_SECONDS=120 of broken snapshots, with clang's libFuzzer and sanitizers
#   make bench      every case, judged, with 8 or 32 variants where rounding decides; speed, beside Bullet and ODE where they are installed
#   make proof      docs/dev/PROOF.md: every case and speed scene in every engine; 40 minutes (PROOF="lines page": only these parts, see tools/proof)
#   make proof-check  does that page say what the committed one says, times apart?
#   make viewer     build/viewer.html, a page that plays recordings; make test-viewer: its tests
#   make gallery    pictures of scenes, docs/images/*.png, and the page that shows them, docs/gallery.html
#   make docs       the site of the API and of the documents in build/docs/html, by doxygen; what is undocumented is an error
#   make amalgamation   the library as one file: build/amalgamation/feather.c, and its header
#   make packages   packages for every language and target in build/packages; make test-packages: installs each, runs its first program
#   make install    PREFIX, LIBDIR, INCLUDEDIR, DESTDIR;  make uninstall takes it away again
#   make examples, deps, format, clean
#
# CC, CXX, CFLAGS, CXXFLAGS, LDFLAGS, AR and BUILD (the folder) may be given. WERROR=1: warnings are errors (CI=true implies it).
# V=1: show the commands.

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SECONDARY:
.SUFFIXES:

BUILD ?= build
PREFIX ?= /usr/local
LIBDIR ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
PKG_CONFIG ?= pkg-config
CLANG_FORMAT ?= clang-format
ifeq ($(origin CC),default)
CC := $(notdir $(firstword $(shell command -v cc || command -v gcc || command -v clang || echo cc)))
endif
ifeq ($(CI),true)
WERROR ?= 1
endif
comma := ,
RUN = $(if $(V),,@echo '  $@';)

# ---- flags ----------------------------------------------------------------------------------------------------------------------

OPT ?= -O2
SIMD_OPT ?= -O3
COLD_OPT ?=
# Constants are enumerators here, and count in floats too; clang 19 would warn of each.
WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wno-enum-float-conversion $(if $(filter 1,$(WERROR)),-Werror)
CXX_WARNINGS := -Wall -Wextra $(if $(filter 1,$(WERROR)),-Werror)
# -g1: the lines of a report. Where variables lie, as -g tells, takes gcc two thirds of its time on the kernels.
SANITIZE_FLAGS := $(if $(SANITIZE),-fsanitize=$(SANITIZE) -fno-sanitize-recover=all -fno-omit-frame-pointer -g1 -DFE_SANITIZED=1)
# These checks make the kernels' compilation ten times slower; there the machine itself traps on NULL and on misaligned vectors, and the
# address sanitizer finds what is out of bounds.
SANITIZE_SIMD := $(if $(findstring undefined,$(SANITIZE)),-fno-sanitize=null$(comma)alignment$(comma)pointer-overflow$(comma)object-size)

# The target's machine, from the compiler itself, so that a cross compiler is understood.
MACROS := $(shell printf '' | $(CC) $(CFLAGS) -dM -E -x c - 2>/dev/null | awk '{ print $$2 }')
ifneq ($(filter __x86_64__,$(MACROS)),)
SIMD_SETS := plain sse2 avx2 avx512
else ifneq ($(filter __aarch64__,$(MACROS)),)
SIMD_SETS := plain neon
else ifneq ($(filter __wasm__,$(MACROS)),)
SIMD_SETS := plain wasm
else
SIMD_SETS := plain
endif
# The 387 computes in 80 bits and would give results of its own.
MACHINE_FLAGS := $(if $(filter __i386__,$(MACROS)),-msse2 -mfpmath=sse)
# Windows: gcc lays 32-byte vectors on a stack that is aligned to 16 (GCC bug 54412); unaligned moves, which cost the same, take them
# from there. Programs end in .exe, and the library in .dll, whose exports the header marks.
WINDOWS := $(filter _WIN32,$(MACROS))
MACHINE_FLAGS += $(if $(WINDOWS),-DFE_SHARED -D__USE_MINGW_ANSI_STDIO=1 $(if $(filter __clang__,$(MACROS)),,-Wa$(comma)-muse-unaligned-vector-move))
EXE := $(if $(WINDOWS),.exe)
# An engine that lacks WebAssembly's SIMD refuses a module with any of it: then all of the code may have it.
MACHINE_FLAGS += $(if $(filter __wasm__,$(MACROS)),$(if $(filter wasm,$(SIMD_SETS)),-msimd128))
# WebAssembly has neither shared objects nor, as wasm32-wasi, threads of its own: see bindings/js/rules.mk.
SHARING := $(if $(filter __wasm__ _WIN32,$(MACROS)),,-fPIC -pthread)

SIMD_plain := -DFE_W=4 -DFE_PLAIN_C
SIMD_sse2 := -DFE_W=4 -msse2
SIMD_avx2 := -DFE_W=8 -mavx2
SIMD_avx512 := -DFE_W=16 -mavx512f -mprefer-vector-width=512
SIMD_neon := -DFE_W=4
SIMD_wasm := -DFE_W=4
HAVE_plain :=
HAVE_sse2 := -DFE_HAVE_SSE2=1
HAVE_avx2 := -DFE_HAVE_AVX2=1
HAVE_avx512 := -DFE_HAVE_AVX512=1
HAVE_neon := -DFE_HAVE_NEON=1
HAVE_wasm := -DFE_HAVE_WASM=1

# STRICT comes last on every command line: whatever CFLAGS hold, results keep their bits. No SLP vectorizer: that of gcc 12 takes a double
# rounded to float and back for the double itself.
STRICT := -fno-fast-math -fno-math-errno -ffp-contract=off -fno-tree-slp-vectorize
DEFINES := -DFE_BUILD $(if $(filter plain,$(SIMD_SETS)),,-DFE_WITHOUT_PLAIN) $(if $(SANITIZE),,-DNDEBUG) $(foreach set,$(SIMD_SETS),$(HAVE_$(set)))
C_FLAGS = -std=gnu11 $(OPT) -fvisibility=hidden $(SHARING) $(WARNINGS) -Iinclude -Isrc $(DEFINES) $(SANITIZE_FLAGS) $(CFLAGS) $(MACHINE_FLAGS)
CXX_FLAGS = -std=c++17 $(OPT) -pthread $(CXX_WARNINGS) -Iinclude $(CXXFLAGS)
LINK_FLAGS = $(SANITIZE_FLAGS) $(LDFLAGS) $(filter -pthread,$(SHARING)) $(if $(WINDOWS),-static -lsynchronization)
DEPENDENCIES = -MMD -MP -MF $(@:.o=).d

# ---- the library ----------------------------------------------------------------------------------------------------------------

SOURCES := $(sort $(wildcard src/*/*.c src/*/*/*.c))
SIMD_SOURCES := $(filter %.simd.c,$(SOURCES))
PLAIN_SOURCES := $(filter-out %.simd.c,$(SOURCES))
OBJECTS := $(PLAIN_SOURCES:src/%.c=$(BUILD)/obj/%.o) \
           $(foreach set,$(SIMD_SETS),$(SIMD_SOURCES:src/%.simd.c=$(BUILD)/obj/%.$(set).o))

SONAME := $(if $(WINDOWS),feather.dll,libfeather.so.1)
STATIC := $(BUILD)/libfeather.a
SHARED := $(BUILD)/$(if $(WINDOWS),libfeather.dll.a,libfeather.so)
VERSION = $(shell awk '/define FE_VERSION_(MAJOR|MINOR|PATCH)/ { v = v dot $$3; dot = "." } END { print v }' include/feather.h)

.PHONY: all static shared demo examples gallery tests read-tests check test test-long test-state test-many fuzz bench bench-build proof proof-check docs install uninstall deps format clean FORCE
all: static shared
static: $(STATIC)
shared: $(SHARED)

# Rewritten only when it changes, so that another compiler, other flags or a removed source rebuild what they concern.
define stamp
@mkdir -p $(@D)
@echo '$(1)' | cmp -s - $@ || echo '$(1)' > $@
endef
$(BUILD)/flags: FORCE
	$(call stamp,$(subst ','"'"',$(CC) $(filter-out -Werror,$(C_FLAGS)) $(SIMD_OPT)$(COLD_OPT:%= %) $(STRICT) $(LINK_FLAGS)))
$(BUILD)/objects: FORCE
	$(call stamp,$(OBJECTS:$(BUILD)/%=%))

$(BUILD)/obj/%.o: src/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(RUN)$(CC) $(C_FLAGS) $(HOT) $(STRICT) $(DEPENDENCIES) -c $< -o $@
# small matrices, whose loops are to be unrolled
$(BUILD)/obj/solver/tree/%.o: HOT := $(SIMD_OPT)
# rooms that no step enters
COLD := api record replay state draw store collision/hull_build collision/mesh_build collision/cooked collision/surface
$(COLD:%=$(BUILD)/obj/%/%.o): HOT := $(COLD_OPT)

# Once per SIMD set. SIMD_OPT follows CFLAGS: a distribution's -O2 must not slow the kernels down.
define simd_rule
$(BUILD)/obj/%.$(1).o: src/%.simd.c $(BUILD)/flags
	@mkdir -p $$(@D)
	$$(RUN)$(CC) $$(C_FLAGS) -Wno-psabi -Wno-ignored-attributes $(SANITIZE_SIMD) $(SIMD_OPT) -DFE_SIMD_SET=$(1) $(SIMD_$(1)) $(STRICT) $$(DEPENDENCIES) -c $$< -o $$@
endef
$(foreach set,$(SIMD_SETS),$(eval $(call simd_rule,$(set))))

$(STATIC): $(OBJECTS) $(BUILD)/objects
	@rm -f $@
	$(RUN)$(AR) rcs $@ $(OBJECTS)

ifeq ($(WINDOWS),)
$(BUILD)/$(SONAME): $(OBJECTS) $(BUILD)/objects feather.map
	$(RUN)$(CC) -shared -Wl,-soname,$(SONAME) -Wl,--version-script=feather.map $(if $(SANITIZE),,-Wl,-z,defs) $(OBJECTS) $(LINK_FLAGS) -lm -o $@
$(SHARED): $(BUILD)/$(SONAME)
	@ln -sf $(SONAME) $@
else
# The import library comes with it. Windows' own libraries only: what gcc brings is linked in.
$(BUILD)/$(SONAME): $(OBJECTS) $(BUILD)/objects
	$(RUN)$(CC) -shared -Wl,--out-implib,$(SHARED) $(OBJECTS) $(LINK_FLAGS) -o $@
$(SHARED): $(BUILD)/$(SONAME)
endif

# ---- examples -------------------------------------------------------------------------------------------------------------------

# For who types `make demo` and nothing more: as many compilers at once as there are processors.
PARALLEL = $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j$(shell getconf _NPROCESSORS_ONLN 2>/dev/null))

# examples/level.c reads its files with assimp. `make examples` leaves it out where there is none.
WITHOUT_ASSIMP := $(shell pkg-config --exists assimp 2>/dev/null || echo examples/level.c)
# examples/rollback_udp.c starts its processes with fork.
WITHOUT_FORK := $(if $(EXE),examples/rollback_udp.c)
EXAMPLES := $(patsubst examples/%.c,$(BUILD)/feather-%$(EXE),$(filter-out $(WITHOUT_ASSIMP) $(WITHOUT_FORK),$(sort $(wildcard examples/*.c))))

$(BUILD)/feather-%$(EXE): $(BUILD)/examples/%.o $(STATIC)
	$(RUN)$(CC) $< $(STATIC) $(LINK_FLAGS) $(READER) -lm -o $@
$(BUILD)/feather-level$(EXE): READER = $(shell pkg-config --libs assimp)
$(BUILD)/examples/%.o: examples/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(RUN)$(CC) $(C_FLAGS) $(STRICT) $(DEPENDENCIES) -c $< -o $@

examples: $(EXAMPLES)
demo:
	@+$(MAKE) --no-print-directory $(PARALLEL) $(BUILD)/feather-demo$(EXE)
	@$(WINE) $(BUILD)/feather-demo$(EXE)

# tools/picture: a program of its own below; its parts are tested
PICTURE_OBJECTS := $(patsubst tools/picture/%.c,$(BUILD)/tools/picture/%.o,$(sort $(wildcard tools/picture/*.c)))
PICTURE_PARTS := $(filter-out %/main.o,$(PICTURE_OBJECTS))

# ---- tests ----------------------------------------------------------------------------------------------------------------------
# tests/<folder>/test_*.c are programs; tests/*.c and tests/support/*.c are linked with each of them.

TEST_SOURCES := $(sort $(wildcard tests/*/test_*.c))
TEST_SUPPORT := $(patsubst tests/%.c,$(BUILD)/tests/%.o,$(sort $(wildcard tests/*.c tests/support/*.c)))
TEST_PROGRAMS := $(TEST_SOURCES:tests/%.c=$(BUILD)/tests/%$(EXE))

$(BUILD)/tests/%.o: tests/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(RUN)$(CC) $(C_FLAGS) -Itests $(STRICT) $(DEPENDENCIES) -c $< -o $@
$(TEST_PROGRAMS): %$(EXE): %.o $(TEST_SUPPORT) $(STATIC)
	$(RUN)$(CC) $< $(TEST_SUPPORT) $(PARTS) $(STATIC) $(LINK_FLAGS) -lcmocka -lm -o $@
$(BUILD)/tests/determinism/test_picture$(EXE): PARTS = $(PICTURE_PARTS)
$(BUILD)/tests/determinism/test_picture$(EXE): $(PICTURE_PARTS)

# tests/determinism/aarch64 builds it for another machine
GOLDEN_OBJECTS := $(BUILD)/tests/determinism/print_golden.o $(patsubst tests/%.c,$(BUILD)/tests/%.o,$(sort $(wildcard tests/support/play*.c)))
$(BUILD)/feather-golden$(EXE): $(GOLDEN_OBJECTS) $(STATIC)
	$(RUN)$(CC) $(GOLDEN_OBJECTS) $(STATIC) $(LINK_FLAGS) -lm -o $@

tests: $(TEST_PROGRAMS)
# The warnings of a compiler about them, without building them
read-tests:
	$(RUN)$(CC) $(C_FLAGS) -Itests $(STRICT) -fsyntax-only $(TEST_SOURCES)
check test test-long test-state test-many: export MAKE := $(MAKE)
check test test-long test-state test-many: export CC := $(CC)
check test test-long test-state test-many: export CXX := $(CXX)
check test test-long test-state test-many: export CFLAGS := $(CFLAGS)
check test test-long test-state test-many: export LDFLAGS := $(LDFLAGS)
check:
	@tools/deps.sh check
	@+tests/check $(BUILD)
test:
	@tools/deps.sh test
	@+tests/run '$(TESTS)'
test-long:
	@tools/deps.sh all
	@+tests/long '$(LONG)' '$(SEED)'
test-state:
	@+tests/long '^state/'
test-many:
	@+tests/long '^many/'

# ---- fuzz -----------------------------------------------------------------------------------------------------------------------
# What breaks it is left as build/fuzz/crash-*, to be given to build/fuzz/feather-fuzz, -cooked or -state, again.

FUZZ_SECONDS ?= 600
COOKED_SECONDS ?= 120
STATE_SECONDS ?= 120
# 0: by chance, and printed
FUZZ_SEED ?= 0
FUZZ_OBJECTS := $(addprefix $(BUILD)/tests/,fuzz/fuzz_api.o support/fuzz.o support/fuzz_calls.o support/fuzz_joints.o support/fuzz_pairs.o support/fuzz_reads.o support/fuzz_terrain.o)

$(BUILD)/feather-fuzz: $(FUZZ_OBJECTS) $(STATIC)
	$(RUN)$(CC) $(FUZZ_OBJECTS) $(STATIC) -fsanitize=fuzzer $(LINK_FLAGS) -lm -o $@
COOKED_OBJECTS := $(addprefix $(BUILD)/tests/,fuzz/fuzz_cooked.o support/cooked.o)
$(BUILD)/feather-fuzz-cooked: $(COOKED_OBJECTS) $(STATIC)
	$(RUN)$(CC) $(COOKED_OBJECTS) $(STATIC) -fsanitize=fuzzer $(LINK_FLAGS) -lm -o $@
STATE_OBJECTS := $(BUILD)/tests/fuzz/fuzz_state.o $(patsubst tests/%.c,$(BUILD)/tests/%.o,$(sort $(wildcard tests/support/play*.c)))
$(BUILD)/feather-fuzz-state: $(STATE_OBJECTS) $(STATIC)
	$(RUN)$(CC) $(STATE_OBJECTS) $(STATIC) -fsanitize=fuzzer $(LINK_FLAGS) -lcmocka -lm -o $@
fuzz:
	@tools/deps.sh fuzz
	@+$(MAKE) --no-print-directory $(PARALLEL) CC=clang BUILD=$(BUILD)/fuzz OPT=-O1 SIMD_OPT=-O1 SANITIZE=address,undefined \
	    CFLAGS='$(CFLAGS) -fsanitize=fuzzer-no-link' $(BUILD)/fuzz/feather-fuzz $(BUILD)/fuzz/feather-fuzz-cooked $(BUILD)/fuzz/feather-fuzz-state
	@mkdir -p $(BUILD)/fuzz/corpus $(BUILD)/fuzz/corpus-cooked $(BUILD)/fuzz/corpus-state
	cd $(BUILD)/fuzz && ./feather-fuzz -seed=$(FUZZ_SEED) -max_total_time=$(FUZZ_SECONDS) -max_len=1500 -timeout=30 corpus
	cd $(BUILD)/fuzz && ./feather-fuzz-cooked -seed=$(FUZZ_SEED) -max_total_time=$(COOKED_SECONDS) -max_len=600 -len_control=0 -timeout=30 corpus-cooked
	cd $(BUILD)/fuzz && ./feather-fuzz-state -seed=$(FUZZ_SEED) -max_total_time=$(STATE_SECONDS) -max_len=129 -len_control=0 -timeout=30 corpus-state

# ---- bench ----------------------------------------------------------------------------------------------------------------------

BENCH_PEERS := $(if $(filter bench bench-build %/feather-bench,$(MAKECMDGOALS)),$(foreach peer,bullet ode box2d,\
    $(shell $(PKG_CONFIG) --exists $(peer) 2>/dev/null && echo $(peer))))
# It has no .pc file
BENCH_PEERS += $(if $(filter bench bench-build %/feather-bench,$(MAKECMDGOALS)),$(if $(wildcard /usr/include/mujoco/mujoco.h),mujoco))
BENCH_PEERS := $(strip $(BENCH_PEERS))
BENCH_PACKAGES := $(filter-out mujoco,$(BENCH_PEERS))
BENCH_SOURCES := $(sort $(wildcard bench/*.c bench/*/*.c)) $(if $(BENCH_PEERS),$(sort $(wildcard bench/peers/*.cpp)))
BENCH_OBJECTS := $(addprefix $(BUILD)/,$(addsuffix .o,$(basename $(BENCH_SOURCES))))
# The peers' headers as system headers: their warnings are theirs.
PEER_CFLAGS := $(if $(filter bullet,$(BENCH_PEERS)),-DFE_BENCH_BULLET=1) $(if $(filter ode,$(BENCH_PEERS)),-DFE_BENCH_ODE=1) \
    $(if $(filter box2d,$(BENCH_PEERS)),-DFE_BENCH_BOX2D=1) $(if $(filter mujoco,$(BENCH_PEERS)),-DFE_BENCH_MUJOCO=1) \
    $(if $(BENCH_PACKAGES),$(patsubst -I%,-isystem%,$(filter-out -I/usr/include,$(shell $(PKG_CONFIG) --cflags $(BENCH_PACKAGES)))))
PEER_LIBS := $(if $(BENCH_PACKAGES),$(shell $(PKG_CONFIG) --libs $(BENCH_PACKAGES))) $(if $(filter mujoco,$(BENCH_PEERS)),-lmujoco)

$(BUILD)/bench-peers: FORCE
	$(call stamp,$(PEER_CFLAGS))
$(BUILD)/bench/%.o: bench/%.c $(BUILD)/flags $(BUILD)/bench-peers
	@mkdir -p $(@D)
	$(RUN)$(CC) $(C_FLAGS) -Ibench $(PEER_CFLAGS) $(STRICT) $(DEPENDENCIES) -c $< -o $@
$(BUILD)/bench/%.o: bench/%.cpp $(BUILD)/flags $(BUILD)/bench-peers
	@mkdir -p $(@D)
	$(RUN)$(CXX) $(CXX_FLAGS) -Ibench $(PEER_CFLAGS) $(DEPENDENCIES) -c $< -o $@
$(BUILD)/feather-bench: $(BENCH_OBJECTS) $(STATIC)
	$(RUN)$(if $(BENCH_PEERS),$(CXX),$(CC)) $(BENCH_OBJECTS) $(STATIC) $(LINK_FLAGS) $(PEER_LIBS) -lm -o $@

bench-build: $(BUILD)/feather-bench
	@for peer in bullet ode box2d mujoco; do case ' $(BENCH_PEERS) ' in *" $$peer "*) ;; *) \
	    echo "*** BENCH WITHOUT $$peer: it is not installed (make deps), so there is nothing to compare with ***" ;; esac; done
bench: bench-build
	$(BUILD)/feather-bench scenes --variants 32
	$(BUILD)/feather-bench speed
# docs/dev/PROOF.md anew, from every case and speed scene in every engine
proof:
	@tools/deps.sh all
	@+$(MAKE) --no-print-directory $(PARALLEL) bench-build
	tools/proof $(BUILD) $(PROOF)
proof-check:
	@tools/proof --check

# ---- pictures -------------------------------------------------------------------------------------------------------------------

$(BUILD)/tools/%.o: tools/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(RUN)$(CC) $(C_FLAGS) $(SIMD_OPT) $(STRICT) $(DEPENDENCIES) -c $< -o $@
$(BUILD)/feather-picture$(EXE): $(PICTURE_OBJECTS) $(STATIC)
	$(RUN)$(CC) $(PICTURE_OBJECTS) $(STATIC) $(LINK_FLAGS) -lm -o $@

gallery: $(BUILD)/feather-picture$(EXE)
	@mkdir -p docs/images
	@for scene in $$($< --list); do echo "  docs/images/$$scene.png"; $< $$scene docs/images/$$scene.png || exit 1; done
	@$< --page > docs/gallery.html

# ---- one file -------------------------------------------------------------------------------------------------------------------

.PHONY: amalgamation
amalgamation:
	@tools/deps.sh amalgamation
	$(RUN)CC='$(CC)' tools/amalgamate $(BUILD)/amalgamation

# ---- docs -----------------------------------------------------------------------------------------------------------------------

docs:
	@tools/deps.sh docs
	@mkdir -p $(BUILD)/docs
	@(cat docs/Doxyfile; echo 'OUTPUT_DIRECTORY = $(BUILD)/docs'; echo 'PROJECT_NUMBER = $(VERSION)') | doxygen -
	@echo '  $(BUILD)/docs/html/index.html'

# ---- bindings: `make python`, `make test-python` and so on --------------------------------------------------------------------------------

include $(wildcard bindings/*/rules.mk tools/*/rules.mk)

# the scene that every language plays; what calls cost in C
$(BUILD)/feather-scenario $(BUILD)/feather-cost $(BUILD)/feather-play: $(BUILD)/feather-%: $(BUILD)/tests/bindings/%.o $(STATIC)
	$(RUN)$(CC) $< $(STATIC) $(LINK_FLAGS) -lm -o $@

# ---- install --------------------------------------------------------------------------------------------------------------------
# LIBDIR and INCLUDEDIR lie under PREFIX, so that the installed tree can be moved: the files written here name both relative to it.

empty :=
LIB_NAME = $(patsubst $(PREFIX)/%,%,$(LIBDIR))
INCLUDE_NAME = $(patsubst $(PREFIX)/%,%,$(INCLUDEDIR))
CMAKE_DIR = $(LIBDIR)/cmake/feather
UP = $(subst $(empty) $(empty),/,$(patsubst %,..,$(subst /, ,$(LIB_NAME)/cmake/feather)))
FILL = sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@LIB_NAME@|$(LIB_NAME)|' -e 's|@INCLUDE_NAME@|$(INCLUDE_NAME)|' \
           -e 's|@VERSION@|$(VERSION)|' -e 's|@UP@|$(UP)|'
INSTALLED = $(INCLUDEDIR)/feather.h $(LIBDIR)/libfeather.a $(LIBDIR)/libfeather.so $(LIBDIR)/$(SONAME) $(LIBDIR)/libfeather.so.$(VERSION) \
            $(LIBDIR)/pkgconfig/feather.pc $(addprefix $(CMAKE_DIR)/feather-,config.cmake config-version.cmake targets.cmake)

install: all
	$(if $(WINDOWS),$(error make install lays out what Linux wants: on Windows install with CMake))mkdir -p $(DESTDIR)$(INCLUDEDIR) $(DESTDIR)$(LIBDIR)/pkgconfig $(DESTDIR)$(CMAKE_DIR)
	install -m 644 include/feather.h $(DESTDIR)$(INCLUDEDIR)/feather.h
	install -m 644 $(STATIC) $(DESTDIR)$(LIBDIR)/libfeather.a
	install -m 755 $(BUILD)/$(SONAME) $(DESTDIR)$(LIBDIR)/libfeather.so.$(VERSION)
	ln -sf libfeather.so.$(VERSION) $(DESTDIR)$(LIBDIR)/$(SONAME)
	ln -sf $(SONAME) $(DESTDIR)$(LIBDIR)/libfeather.so
	$(FILL) feather.pc.in > $(DESTDIR)$(LIBDIR)/pkgconfig/feather.pc
	$(FILL) cmake/feather-config.cmake > $(DESTDIR)$(CMAKE_DIR)/feather-config.cmake
	$(FILL) cmake/feather-config-version.cmake.in > $(DESTDIR)$(CMAKE_DIR)/feather-config-version.cmake
	$(FILL) cmake/feather-targets.cmake.in > $(DESTDIR)$(CMAKE_DIR)/feather-targets.cmake
uninstall:
	rm -f $(addprefix $(DESTDIR),$(INSTALLED))
	-rmdir $(DESTDIR)$(CMAKE_DIR) 2>/dev/null || true

# ---- the rest -------------------------------------------------------------------------------------------------------------------

deps:
	@tools/deps.sh all

# Without the records of the ABI, which stay as they were written.
FORMATTED = $(foreach top,src tests bench examples tools,$(foreach ext,c h inl cpp,$(foreach depth,* */* */*/*,$(wildcard $(top)/$(depth).$(ext)))))
format:
	$(CLANG_FORMAT) -i include/feather.h $(filter-out tests/abi/feather_% tests/abi/layout%.h,$(FORMATTED))

clean:
	rm -rf $(BUILD)

-include $(OBJECTS:.o=.d) $(PICTURE_OBJECTS:.o=.d) $(TEST_PROGRAMS:=.d) $(TEST_SUPPORT:.o=.d) $(BENCH_OBJECTS:.o=.d) $(wildcard $(BUILD)/examples/*.d)
