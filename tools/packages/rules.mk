# make packages: every package in build/packages. The core is compiled once for each target: for this machine in build,
# where the other rules find it, for the others in build/packages/core/<target>. A target whose compiler is missing is
# left out with a line that says so. make test-packages: installs each from an empty folder and runs its first program.

PACKAGES := $(BUILD)/packages
PACKAGE_HOST := $(CSHARP_RID)
COMPILER_linux-x64 := x86_64-linux-gnu-gcc
COMPILER_linux-arm64 := aarch64-linux-gnu-gcc
COMPILER_win-x64 := x86_64-w64-mingw32-gcc
# targets beside this machine: PACKAGE_CROSS= makes packages for this machine alone
PACKAGE_WANTED := $(filter-out $(PACKAGE_HOST),linux-x64 linux-arm64 win-x64)
PACKAGE_CROSS ?= $(foreach target,$(PACKAGE_WANTED),$(if $(shell command -v $(COMPILER_$(target))),$(target)))
PACKAGE_CORES := $(PACKAGE_CROSS:%=$(PACKAGES)/core/%/libfeather.a)
# What starts a make of its own may not meet the variables of this one.
ALONE = env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL CC='$(CC)' CFLAGS='$(CFLAGS)' LDFLAGS='$(LDFLAGS)'

.PHONY: packages package-cores package-python package-deb package-lua package-csharp test-packages
packages: package-python package-deb package-lua package-csharp
	@for target in $(filter-out $(PACKAGE_CROSS),$(PACKAGE_WANTED)); do echo "*** NOT PACKAGED: $$target ***"; done
	@cd $(PACKAGES) && for file in python/*.* deb/*.deb lua/*.* csharp/*.*; do echo "  $$(du -k "$$file" | cut -f1) KB $$file"; done

package-cores: all $(PACKAGE_CORES)
$(PACKAGES)/core/%/libfeather.a: FORCE
	@+env -u CC -u AR $(MAKE) --no-print-directory BUILD=$(PACKAGES)/core/$* CC=$(COMPILER_$*) AR=$(COMPILER_$*:gcc=ar) \
	    WERROR=0 all

# the source distribution, and wheels made of it
PACKAGE_WHEELS := $(filter linux-%,$(PACKAGE_CROSS))
package-python: static $(PACKAGE_WHEELS:%=$(PACKAGES)/core/%/libfeather.a)
	$(RUN)$(ALONE) tools/packages/python $(PYTHON) $(PACKAGES) '$(PACKAGE_HOST)=$(STATIC)=$(CC)' \
	    $(foreach target,$(PACKAGE_WHEELS),$(target)=$(PACKAGES)/core/$(target)/libfeather.a=$(COMPILER_$(target)))

package-deb: package-cores
	@rm -rf $(PACKAGES)/deb
	$(RUN)tools/packages/deb $(MAKE) $(BUILD) '$(CC)' $(PACKAGES)/deb
	@set -e; $(foreach target,$(filter linux-%,$(PACKAGE_CROSS)),\
	    tools/packages/deb $(MAKE) $(PACKAGES)/core/$(target) $(COMPILER_$(target)) $(PACKAGES)/deb;)

# a rock of the sources, and a game of LÖVE with the native library for each target
package-lua: package-cores $(BUILD)/lua/core.c $(BUILD)/lua/feather/header.lua
	$(RUN)tools/packages/lua $(BUILD) $(PACKAGES) $(PACKAGE_HOST)=$(SHARED)=strip \
	    $(foreach target,$(PACKAGE_CROSS),$(target)=$(PACKAGES)/core/$(target)/$(if $(filter win-%,$(target)),feather.dll,libfeather.so)=$(COMPILER_$(target):gcc=strip))

# NuGet's package and Unity's, with the native library for each target
package-csharp: package-cores $(CSHARP)/feather_csharp.c $(CSHARP)/source/Records.cs $(CSHARP_SOURCES:bindings/csharp/FeatherPhysics/%=$(CSHARP)/source/%)
	$(RUN)tools/packages/csharp $(CSHARP) $(PACKAGES) $(VERSION) '$(PACKAGE_HOST)=$(STATIC)=$(CC)' \
	    $(foreach target,$(PACKAGE_CROSS),$(target)=$(PACKAGES)/core/$(target)/libfeather.a=$(COMPILER_$(target)))

test-packages:
	@+tests/packages/run $(BUILD)/test-packages
