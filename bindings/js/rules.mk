# make wasm: build/wasm/feather.wasm, the library as a module that asks its host for a clock and for numbers as text, and
# for nothing else. make js: build/js, the package feather-physics around it. make test-js: its tests.

WASM_CC ?= clang --target=wasm32-wasi --sysroot=/usr
WASM_AR ?= llvm-ar
NODE ?= node
# The module is loaded before the first step: bytes count as much as speed. -O2 of the kernels is worth 3 %, that of the
# rest nothing that can be measured, for a tenth of the bytes each.
WASM_OPT ?= -Os
WASM_SIMD_OPT ?= -O2
WASM_COLD_OPT ?= -Oz
# A step takes up to 22 KB of stack, a query on a sweep through a mesh less; below it the module traps, it does not overwrite.
WASM_LINK := -nostartfiles -Wl,--no-entry,--gc-sections,--strip-all,--stack-first,-z,stack-size=262144
JS_SOURCES := $(wildcard bindings/js/src/*)

.PHONY: wasm js test-js FORCE
wasm: $(BUILD)/wasm/feather.wasm
js: $(patsubst bindings/js/src/%,$(BUILD)/js/%,$(JS_SOURCES)) $(addprefix $(BUILD)/js/,api.js feather.wasm inline.js package.json README.md LICENSE)

$(BUILD)/wasm/library/libfeather.a: FORCE
	@+$(MAKE) --no-print-directory BUILD=$(BUILD)/wasm/library SIMD_SETS=wasm CC='$(WASM_CC)' AR=$(WASM_AR) OPT='$(WASM_OPT)' \
	    SIMD_OPT='$(WASM_SIMD_OPT)' COLD_OPT='$(WASM_COLD_OPT)' \
	    CFLAGS= LDFLAGS= BENCH_PEERS= $@
$(BUILD)/js/api.js: bindings/js/generate.mjs include/feather.h
	@mkdir -p $(BUILD)/js $(BUILD)/wasm
	$(RUN)$(NODE) $< include/feather.h $(BUILD)/js $(BUILD)/wasm/exports
$(BUILD)/js/api.d.ts $(BUILD)/wasm/exports: $(BUILD)/js/api.js
	@: # made with it; without a recipe make would not look again whether they are new
$(BUILD)/wasm/libc.o: bindings/js/libc.c
	@mkdir -p $(@D)
	$(RUN)$(WASM_CC) -std=gnu11 -Os -Wall -Wextra -c $< -o $@
$(BUILD)/wasm/feather.wasm: $(BUILD)/wasm/libc.o $(BUILD)/wasm/library/libfeather.a $(BUILD)/wasm/exports
	$(RUN)$(WASM_CC) $(WASM_LINK) @$(BUILD)/wasm/exports $(BUILD)/wasm/libc.o $(BUILD)/wasm/library/libfeather.a -lm -o $@

$(BUILD)/js/%: bindings/js/src/%
	@mkdir -p $(@D)
	@cp $< $@
$(BUILD)/js/feather.wasm: $(BUILD)/wasm/feather.wasm
	@mkdir -p $(@D)
	@cp $< $@
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
