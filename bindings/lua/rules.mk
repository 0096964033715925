# make lua: build/lua with the package and one C module for each Lua whose headers are there, to be used with
# LUA_PATH='build/lua/?/init.lua;build/lua/?.lua;;' LUA_CPATH='build/lua/5.4/?.so;;'. make test-lua: its tests.

LUA_VERSIONS := $(foreach version,5.1 5.3 5.4,$(if $(shell $(PKG_CONFIG) --exists lua$(version) 2>/dev/null && echo yes),$(version)))
LUA_SOURCES := $(wildcard bindings/lua/feather/*.lua)

.PHONY: lua test-lua
lua: $(LUA_VERSIONS:%=$(BUILD)/lua/%/feather/core.so) $(LUA_SOURCES:bindings/lua/%=$(BUILD)/lua/%)
lua: $(BUILD)/lua/feather/header.lua $(BUILD)/lua/libfeather.so $(BUILD)/lua/library/feather.lua

$(BUILD)/lua/core.c: bindings/feather.i bindings/records.i bindings/twins.h bindings/rows.h bindings/lua/lua.i include/feather.h
	@mkdir -p $(@D)
	$(RUN)$(SWIG) -lua -nomoduleglobal -Iinclude -Ibindings -o $@ bindings/feather.i
$(BUILD)/lua/%/feather/core.so: $(BUILD)/lua/core.c $(wildcard bindings/lua/*.h) $(STATIC)
	@mkdir -p $(@D)
	$(RUN)$(CC) -shared $(WRAPPER_FLAGS) -Dluaopen_core=luaopen_feather_core $(shell $(PKG_CONFIG) --cflags lua$*) \
	    $< $(STATIC) $(LINK_FLAGS) -Wl,--exclude-libs,ALL -lm -o $@
$(BUILD)/lua/feather/%.lua: bindings/lua/feather/%.lua
	@mkdir -p $(@D)
	@cp $< $@
$(BUILD)/lua/library/%.lua: bindings/lua/library/%.lua
	@mkdir -p $(@D)
	@cp $< $@
$(BUILD)/lua/libfeather.so: $(SHARED)
	@cp -L $< $@
# for LuaJIT's ffi: the header without its preprocessor, as a Lua string
$(BUILD)/lua/feather/header.lua: bindings/lua/header.awk include/feather.h
	@mkdir -p $(@D)
	$(RUN)awk -f bindings/lua/header.awk include/feather.h > $@

# what feather-scm-1.rockspec installs, for the Lua whose headers are in LUA_INCDIR
.PHONY: lua-rock
lua-rock: $(BUILD)/lua/core.c $(BUILD)/lua/feather/header.lua $(BUILD)/lua/libfeather.so $(STATIC)
	@mkdir -p $(BUILD)/rock
	@cp $(BUILD)/lua/feather/header.lua $(BUILD)/lua/libfeather.so $(BUILD)/rock
	$(RUN)$(CC) -shared $(WRAPPER_FLAGS) -Dluaopen_core=luaopen_feather_core -I$(LUA_INCDIR) $(BUILD)/lua/core.c \
	    $(STATIC) $(LINK_FLAGS) -Wl,--exclude-libs,ALL -lm -o $(BUILD)/rock/core.so

test-lua: export CC := $(CC)
test-lua:
	@tools/deps.sh lua
	@+bindings/lua/test $(BUILD)
