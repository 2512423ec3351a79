# radsig: make help lists the targets.

VERSION := 0.1.0
SAN ?=
CC := gcc
CXX := g++
empty :=
comma := ,
space := $(empty) $(empty)
VARIANT := $(if $(SAN),san-$(subst $(comma),-,$(SAN)),release)
BUILD := build/$(VARIANT)
PROGRAM := $(if $(SAN),$(BUILD),build)/radsig

PACKAGES := build-essential pkg-config python3 python3-numpy python3-pyopencl python3-pytest \
	python3-spectral pocl-opencl-icd ocl-icd-opencl-dev opencl-headers libopenmesh-dev \
	libtinyobjloader-dev libopenimageio-dev libtomlplusplus-dev libcmocka-dev libmd-dev fonts-dejavu-core
LINT_PACKAGES := clang-format clang cppcheck python3-venv

# A plain python3 on the path may lack Debian's packages.
PYTHON = $(firstword $(foreach p,.venv/bin/python /usr/bin/python3 python3,$(if \
	$(shell $(p) -c 'import numpy, pyopencl, pytest' 2>/dev/null && echo yes),$(p))) python3)

# Expanded lazily: pkg-config may not be installed before `deps` has run.
SANITIZE = $(if $(SAN),-fsanitize=$(SAN) -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
WARNINGS = -Wall -Wextra -Wshadow
CPPFLAGS = -Ihost -Ikernels -Imeshio -MMD -MP -DRADSIG_VERSION='"$(VERSION)"'
CFLAGS = -std=c11 -D_DEFAULT_SOURCE -D_POSIX_C_SOURCE=200809L -O2 -g -ffp-contract=off $(WARNINGS) \
	-Wdouble-promotion $(SANITIZE)
CXXFLAGS = -std=c++17 -O2 -g -ffp-contract=off $(WARNINGS) -Wno-maybe-uninitialized $(SANITIZE) \
	$(shell pkg-config --cflags OpenImageIO tomlplusplus 2>/dev/null)
LDLIBS = -lOpenCL -lOpenMeshCore $(shell pkg-config --libs OpenImageIO tomlplusplus 2>/dev/null) -lmd -lm

HOST := $(filter-out host/main.c host/command%,$(wildcard host/*.c))
COMMANDS := host/main.c $(wildcard host/command*.c)
MESHIO := $(wildcard meshio/*.cpp)
KERNELS := $(sort $(wildcard kernels/*.h kernels/*.cl))
LIBRARY := $(HOST:%.c=$(BUILD)/%.o) $(MESHIO:%.cpp=$(BUILD)/%.o) $(BUILD)/kernel_files.o
HOST_TESTS := $(patsubst tests/host/%_test.c,$(BUILD)/tests/%,$(sort $(wildcard tests/host/*_test.c)))
SCENES := $(patsubst scenes/%/make_geometry.py,scenes/%/.geometry,$(wildcard scenes/*/make_geometry.py))

.DELETE_ON_ERROR:
.SECONDARY:
.SECONDEXPANSION:
.PHONY: help deps all scenes demo test lint bench renders clean

## help: list the targets
help:
	@sed -n 's/^## //p' Makefile

## deps: install the Debian packages that are missing (root or sudo -n; otherwise print the line)
deps: build/deps
	@$(call install,$(PACKAGES))

# install PACKAGES: installs what dpkg does not know, or prints the line that would.
define install
missing=$$(for p in $(1); do \
	    dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || echo $$p; done); \
	[ -z "$$missing" ] && exit 0; \
	set -- $$missing; line="apt-get install -y --no-install-recommends $$*"; \
	if [ "$$(id -u)" = 0 ]; then run=; \
	elif sudo -n true 2>/dev/null; then run=sudo; \
	else echo "these packages are missing; as root run:"; \
	    echo "  apt-get update && $$line"; exit 1; fi; \
	echo "installing: $$*"; \
	$$run apt-get update -qq && DEBIAN_FRONTEND=noninteractive $$run $$line
endef

build/deps: Makefile
	@$(call install,$(PACKAGES))
	@mkdir -p build && touch $@

## all: build the program and generate the scenes' geometry
all: $(PROGRAM) scenes

build/radsig: build/release/radsig
	ln -f $< $@

$(BUILD)/radsig: $(COMMANDS:%.c=$(BUILD)/%.o) $(LIBRARY)
	$(CXX) $(SANITIZE) -o $@ $^ $(LDLIBS)

$(BUILD)/%.o: %.c | build/deps
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) -c -o $@ $<

$(BUILD)/%.o: %.cpp | build/deps
	@mkdir -p $(@D)
	$(CXX) $(CPPFLAGS) $(CXXFLAGS) -c -o $@ $<

$(BUILD)/kernel_files.o: $(BUILD)/kernel_files.c
	$(CC) $(CPPFLAGS) $(CFLAGS) -c -o $@ $<

# The text of every kernel file as a C string.
$(BUILD)/kernel_files.c: $(KERNELS) Makefile | build/deps
	@mkdir -p $(@D)
	@{ echo '#include "kernel_source.h"'; echo 'const kernel_file kernel_files[] = {'; \
	for f in $(notdir $(KERNELS)); do echo "{\"$$f\","; \
	    sed 's/\\/\\\\/g; s/"/\\"/g; s/.*/"&\\n"/' kernels/$$f; echo '},'; done; \
	echo '{0, 0}};'; } > $@

## scenes: generate the geometry and the library files of scenes/ (they are not in git)
scenes: $(SCENES) scenes/library/.emissivity

scenes/%/.geometry: $$(wildcard scenes/$$*/*.py) scenes/library/materials.mat | build/deps
	$(PYTHON) scenes/$*/make_geometry.py
	@touch $@

scenes/library/.emissivity: scenes/library/make_emissivity.py scenes/library/materials.mat | build/deps
	$(PYTHON) $<
	@touch $@

## demo: build, then render the airport into out/airport
demo: deps all
	build/radsig render scenes/airport/scene.toml -o out/airport
	@echo "written:"; ls out/airport | sed 's,^,  out/airport/,'

## test: build and run all tests; SAN=address,undefined builds them with sanitizers
test: deps all $(HOST_TESTS)
	@set -e; for t in $(HOST_TESTS); do $(RUN_SANITIZED) $$t; done
	$(RUN_SANITIZED) RADSIG=$(PROGRAM) $(PYTHON) -m pytest -q -p no:cacheprovider tests

# PoCL and LLVM keep memory until the process ends.
RUN_SANITIZED = $(if $(SAN),LSAN_OPTIONS=suppressions=tests/sanitizer.supp,) \
	RADSIG_SHARED=$${RADSIG_SHARED:-../shared}

$(BUILD)/tests/%: $(BUILD)/tests/host/%_test.o $(LIBRARY)
	@mkdir -p $(@D)
	$(CXX) $(SANITIZE) -o $@ $^ $(LDLIBS) -lcmocka

## lint: format, kernel syntax, include arrows, cppcheck, ruff
lint: deps
	@$(call install,$(LINT_PACKAGES))
	tests/lint

## bench: time the demo's stages and the whole process
bench: deps all
	$(PYTHON) bench/render.py

## renders: render every scene under scenes/ into out/
renders: deps all
	@set -e; for s in $(wildcard scenes/*/scene.toml); do n=$$(basename $$(dirname $$s)); \
	    build/radsig render $$s -o out/$$n; echo "out/$$n"; done

## clean: remove what was built and generated
clean:
	rm -rf build out $(SCENES) scenes/library/.emissivity
	rm -f scenes/*/*.gdb scenes/library/*.ems

-include $(patsubst %.o,%.d,$(LIBRARY) $(COMMANDS:%.c=$(BUILD)/%.o)) $(wildcard $(BUILD)/tests/host/*.d)
