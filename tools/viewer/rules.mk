# make viewer: build/viewer.html, one page that plays recordings. make test-viewer: its tests, in headless Chromium.
# Of npm it needs esbuild and three, as tools/viewer/package-lock.json pins them: from a network, or from what it has brought before.

.PHONY: viewer test-viewer
VIEWER_TOOLS := $(BUILD)/viewer-tools
VIEWER_NPM := $(VIEWER_TOOLS)/node_modules/.package-lock.json
VIEWER_SOURCES := $(wildcard tools/viewer/src/*) tools/viewer/build.mjs

viewer: $(BUILD)/viewer.html
$(VIEWER_NPM): tools/viewer/package.json tools/viewer/package-lock.json
	@mkdir -p $(VIEWER_TOOLS)
	@cp $^ $(VIEWER_TOOLS)
	@cd $(VIEWER_TOOLS) && npm ci --prefer-offline --no-audit --no-fund > npm.log 2>&1 || { \
	    echo '*** THE VIEWER NEEDS esbuild AND three FROM npm, AND THEY CANNOT BE HAD: see $(VIEWER_TOOLS)/npm.log ***'; exit 1; }
	@touch $@
$(BUILD)/viewer.html: $(VIEWER_NPM) $(VIEWER_SOURCES) js
	$(RUN)$(NODE) tools/viewer/build.mjs $(BUILD)/js $(VIEWER_TOOLS) $@

$(BUILD)/feather-viewer-case: $(BUILD)/tools/viewer/tests/case.o $(STATIC)
	$(RUN)$(CC) $< $(STATIC) $(LINK_FLAGS) -lm -o $@
test-viewer:
	@tools/deps.sh wasm
	@+tools/viewer/test $(BUILD)
