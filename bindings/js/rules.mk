# make wasm: build/wasm/feather.wasm, the library as a module that asks its host for a clock and for numbers as text, and
# for nothing else; build/wasm/feather-threads.wasm, the same on a memory that threads of the host share. make js:
# build/js, the package feather-physics around both. make test-js: its tests.

# clang 19, where it is there with its runtime, makes 4 % fewer bytes than Debian's clang 14, and 4 % faster ones.
WASM_CC ?= $(shell test -e "$$(clang-19 --target=wasm32-wasi --print-libgcc-file-name 2> /dev/null)" && echo clang-19 || echo clang) \
    --target=wasm32-wasi --sysroot=/usr
WASM_AR ?= llvm-ar
NODE ?= node
# The module is loaded before the first step: bytes count as much as speed. -O2 of the kernels is worth 3 %, that of the
# rest nothing that can be measured, for a tenth of the bytes each.
WASM_OPT ?= -Os
WASM_SIMD_OPT ?= -O2
WASM_COLD_OPT ?= -Oz
# Engines that know SIMD know these: a conversion is one instruction.
WASM_FEATURES := -mnontrapping-fptoint -msign-ext
# binaryen's wasm-opt, where it is there, takes 8 % of the bytes away. No object lies below 1024: the stack does, and
# ends above it. What one function alone calls is inlined when it is small; else gzip finds less to join.
WASM_SHRINK := $(and $(shell command -v wasm-opt),wasm-opt -O2 -Os --low-memory-unused --one-caller-inline-max-function-size=20 \
    --strip-debug --enable-mutable-globals --enable-simd --enable-nontrapping-float-to-int --enable-sign-ext)
# A step takes up to 18 KB of stack, a query on a sweep through a mesh less; below it the module traps, it does not overwrite.
WASM_LINK := -nostartfiles -Wl,--no-entry,--gc-sections,--strip-all,--stack-first,-z,stack-size=262144,--export=memory_growths
# Else each export is wrapped in a call of the destructors. There are neither.
WASM_LINK += -Wl,--export=__wasm_call_ctors
# Debian's wasi-libc knows no atomics: the linker is told that it may do without. What of it the library calls keeps
# nothing between calls, but malloc, which core/memory.c locks; the host calls it while no worker runs. Bytes of memory:
# as threads.js has them.
WASM_SHARED := -matomics -mbulk-memory -ftls-model=local-exec
WASM_SHARED_LINK := -Wl,--import-memory,--shared-memory,--initial-memory=4194304,--max-memory=1073741824,--no-check-features \
    -Wl,--export=__stack_pointer,--export=__wasm_init_tls
# One script of them all, as node takes half a millisecond for each that it loads: one after the other, without what they
# import from those before, and without their comments, 6 KB. host.js is a worker's too.
JS_CORE := $(patsubst %,bindings/js/src/%.js,host runtime) $(BUILD)/wasm/api.js $(patsubst %,bindings/js/src/%.js,recorder batch hand player)
JS_SOURCES := bindings/js/src/host.js $(filter-out $(JS_CORE),$(wildcard bindings/js/src/*))

.PHONY: wasm js test-js FORCE
.PRECIOUS: $(BUILD)/wasm/%/libfeather.a
wasm: $(BUILD)/wasm/feather.wasm $(BUILD)/wasm/feather-threads.wasm
js: $(patsubst bindings/js/src/%,$(BUILD)/js/%,$(JS_SOURCES)) $(addprefix $(BUILD)/js/,core.js api.d.ts feather.wasm feather-threads.wasm inline.js package.json README.md LICENSE)

$(BUILD)/wasm/shared/libfeather.a: WASM_FEATURES += $(WASM_SHARED)
$(BUILD)/wasm/%/libfeather.a: FORCE
	@+$(MAKE) --no-print-directory BUILD=$(@D) SIMD_SETS=wasm CC='$(WASM_CC) $(WASM_FEATURES)' AR=$(WASM_AR) OPT='$(WASM_OPT)' \
	    SIMD_OPT='$(WASM_SIMD_OPT)' COLD_OPT='$(WASM_COLD_OPT)' \
	    CFLAGS= LDFLAGS= BENCH_PEERS= $@
# the golden scripts by these objects: tests/determinism/wasm
$(BUILD)/wasm/library/feather-golden: $(BUILD)/wasm/library/libfeather.a
	@+$(MAKE) --no-print-directory BUILD=$(@D) SIMD_SETS=wasm CC='$(WASM_CC) $(WASM_FEATURES)' AR=$(WASM_AR) OPT='$(WASM_OPT)' \
	    SIMD_OPT='$(WASM_SIMD_OPT)' COLD_OPT='$(WASM_COLD_OPT)' \
	    CFLAGS= LDFLAGS= BENCH_PEERS= $@
$(BUILD)/wasm/api.js: bindings/js/generate.mjs include/feather.h
	@mkdir -p $(@D)
	$(RUN)$(NODE) $< include/feather.h $(@D)
$(BUILD)/wasm/api.d.ts $(BUILD)/wasm/exports: $(BUILD)/wasm/api.js
	@: # made with it; without a recipe make would not look again whether they are new
$(BUILD)/wasm/libc.o: bindings/js/libc.c
	@mkdir -p $(@D)
	$(RUN)$(WASM_CC) $(WASM_FEATURES) -std=gnu11 -Os -Wall -Wextra -c $< -o $@
$(BUILD)/wasm/libc-shared.o: bindings/js/libc.c
	@mkdir -p $(@D)
	$(RUN)$(WASM_CC) $(WASM_FEATURES) $(WASM_SHARED) -std=gnu11 -Os -Wall -Wextra -c $< -o $@
$(BUILD)/wasm/feather-threads.wasm: $(BUILD)/wasm/libc-shared.o $(BUILD)/wasm/shared/libfeather.a $(BUILD)/wasm/exports
	$(RUN)$(WASM_CC) $(WASM_LINK) $(WASM_SHARED_LINK) @$(BUILD)/wasm/exports $(BUILD)/wasm/libc-shared.o \
	    $(BUILD)/wasm/shared/libfeather.a -lm -o $@
	$(if $(WASM_SHRINK),$(RUN)$(WASM_SHRINK) --enable-threads --enable-bulk-memory $@ -o $@)
$(BUILD)/wasm/feather.wasm: $(BUILD)/wasm/libc.o $(BUILD)/wasm/library/libfeather.a $(BUILD)/wasm/exports
	$(RUN)$(WASM_CC) $(WASM_LINK) @$(BUILD)/wasm/exports $(BUILD)/wasm/libc.o $(BUILD)/wasm/library/libfeather.a -lm -o $@
	$(if $(WASM_SHRINK),$(RUN)$(WASM_SHRINK) $@ -o $@)

$(BUILD)/js/%: bindings/js/src/%
	@mkdir -p $(@D)
	@cp $< $@
$(BUILD)/js/%: $(BUILD)/wasm/%
	@mkdir -p $(@D)
	@cp $< $@
$(BUILD)/js/core.js: $(JS_CORE)
	@mkdir -p $(@D)
	@sed '/^import .* from /d; /^ *\/\/ /d' $(JS_CORE) > $@
$(BUILD)/js/inline.js: bindings/js/inline.mjs $(BUILD)/wasm/feather.wasm
	@mkdir -p $(@D)
	$(RUN)$(NODE) $< $(BUILD)/wasm/feather.wasm > $@
$(BUILD)/js/package.json: bindings/js/package.json include/feather.h
	@mkdir -p $(@D)
	@sed 's/"version": "[^"]*"/"version": "$(VERSION)"/' $< > $@
$(BUILD)/js/README.md: docs/javascript.md
	@mkdir -p $(@D)
	@cp $< $@
$(BUILD)/js/LICENSE: LICENSE
	@mkdir -p $(@D)
	@cp $< $@

test-js:
	@tools/deps.sh wasm
	@+bindings/js/test $(BUILD)
