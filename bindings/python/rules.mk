# make python builds the package in build/python: use it with PYTHONPATH=build/python. make test-python runs its tests.
# `pip install .` builds by setup.py.

PYTHON ?= $(if $(wildcard /usr/bin/python3),/usr/bin/python3,python3)
SWIG ?= swig
PYTHON_PACKAGE := $(BUILD)/python/feather_physics
PYTHON_SOURCES := $(wildcard bindings/python/feather_physics/*)
PYTHON_FLAGS = $(shell $(PYTHON) -c 'import sysconfig; print("-I" + sysconfig.get_paths()["include"])')
# what draws a world's picture
PYTHON_PICTURE := $(filter-out %/scenes.o,$(PICTURE_PARTS))
# SWIG's own code, not ours
# WRAPPER_OPT: tests that compile it three times and more have another level
WRAPPER_OPT ?= -O2
WRAPPER_FLAGS = -std=gnu11 $(WRAPPER_OPT) -fPIC -pthread -ffp-contract=off -Wno-unused-but-set-variable -Iinclude -Ibindings

.PHONY: python test-python
python: $(PYTHON_PACKAGE)/_flat.so $(PYTHON_SOURCES:bindings/python/%=$(BUILD)/python/%)

$(BUILD)/python/flat.c: bindings/feather.i bindings/records.i bindings/twins.h bindings/rows.h bindings/python/python.i include/feather.h
	@mkdir -p $(@D)
	$(RUN)$(SWIG) -python -builtin -Iinclude -Ibindings -outdir $(@D) -o $@ bindings/feather.i
$(PYTHON_PACKAGE)/_flat.so: $(BUILD)/python/flat.c bindings/python/convert.h bindings/python/found.h bindings/python/batch.h bindings/python/picture.h $(PYTHON_PICTURE) $(STATIC)
	@mkdir -p $(@D)
	$(RUN)$(CC) -shared $(WRAPPER_FLAGS) $(PYTHON_FLAGS) $< $(PYTHON_PICTURE) $(STATIC) $(LINK_FLAGS) -Wl,--exclude-libs,ALL -lm -o $@
$(PYTHON_PACKAGE)/%: bindings/python/feather_physics/%
	@mkdir -p $(@D)
	@cp $< $@

test-python: export PYTHON := $(PYTHON)
test-python: export CC := $(CC)
test-python:
	@tools/deps.sh python
	@+bindings/python/test $(BUILD)
