# make csharp: the C# sources and the native library in build/csharp. make nuget, make unity-package: packages of them.
# make test-csharp: their tests.

CSHARP := $(BUILD)/csharp
CSHARP_VERSION = $(VERSION)
CSHARP_SYSTEM := $(if $(filter Darwin,$(shell uname -s)),osx,linux)
CSHARP_RID ?= $(CSHARP_SYSTEM)-$(if $(filter aarch64 arm64,$(shell uname -m)),arm64,x64)
CSHARP_NATIVE := $(CSHARP)/runtimes/$(CSHARP_RID)/native/libfeather_csharp.so
CSHARP_SOURCES := $(wildcard bindings/csharp/FeatherPhysics/*.cs)
# no callbacks into C#, no static constructor: each call costs what a call costs
CSHARP_WITHOUT = EXCEPTION_HELPER STRING_HELPER WSTRING_HELPER IMCLASS_STATIC_CONSTRUCTOR
CSHARP_SWIG = -csharp -namespace FeatherPhysics -dllimport feather_csharp $(CSHARP_WITHOUT:%=-DSWIG_CSHARP_NO_%)
CSHARP_INTERFACE := bindings/feather.i bindings/twins.h bindings/csharp/csharp.i bindings/csharp/shell.h

.PHONY: csharp nuget unity-package test-csharp
csharp: $(CSHARP_NATIVE) $(CSHARP)/source/Records.cs
csharp: $(CSHARP_SOURCES:bindings/csharp/FeatherPhysics/%=$(CSHARP)/source/%)

# On iOS the library is linked into the program.
$(CSHARP)/feather_csharp.c: $(CSHARP_INTERFACE) include/feather.h bindings/csharp/rules.mk
	@mkdir -p $(CSHARP)/source
	$(RUN)$(SWIG) $(CSHARP_SWIG) -Iinclude -Ibindings -outdir $(CSHARP)/source -o $@ bindings/feather.i
	@sed -i.bak 's/DllImport("feather_csharp"/DllImport(NativeLibraryName.Value/' $(CSHARP)/source/NativePINVOKE.cs
	@rm -f $(CSHARP)/source/*.bak
$(CSHARP_NATIVE): $(CSHARP)/feather_csharp.c $(STATIC)
	@mkdir -p $(@D)
	$(RUN)$(CC) -shared $(WRAPPER_FLAGS) $< $(STATIC) $(LINK_FLAGS) -Wl,--exclude-libs,ALL -lm -o $@
$(CSHARP)/source/Records.cs: bindings/csharp/records.py tools/header.py include/feather.h
	@mkdir -p $(@D)
	$(RUN)$(PYTHON) $< include/feather.h $@
$(CSHARP)/source/%.cs: bindings/csharp/FeatherPhysics/%.cs
	@mkdir -p $(@D)
	@cp $< $@

# ---- packages: needs the SDK of .NET 10 ------------------------------------------------------------------------------
# More native libraries, built on other machines, are taken in when they lie in build/csharp/runtimes/<rid>/native.

nuget: csharp
	@mkdir -p $(CSHARP)/package
	@cp bindings/csharp/FeatherPhysics/FeatherPhysics.csproj docs/csharp.md LICENSE $(CSHARP)/source/
	$(RUN)dotnet pack -c Release -v quiet -p:FeatherVersion=$(CSHARP_VERSION) -o $(CSHARP)/package \
		$(CSHARP)/source/FeatherPhysics.csproj

unity-package: csharp
	$(RUN)bindings/csharp/unity/pack $(CSHARP) $(CSHARP_VERSION)

# ---- tests -----------------------------------------------------------------------------------------------------------
test-csharp:
	@tools/deps.sh csharp
	@+bindings/csharp/test $(BUILD)
