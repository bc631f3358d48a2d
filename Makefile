# SPDX-License-Identifier: GPL-3.0-or-later
# One non-recursive Makefile.  `make help` lists the targets.
#
# Layering: a library sees the headers of the libraries in its USES_ line, and of those that they
# use, and no others: an upward include stops with "No such file or directory".

OPT  ?= Release
B    := build/$(OPT)

# ---- the layers, lowest first -------------------------------------------------------------------
LIBS := core/base core/dictionary core/control geometry surfaceTools fileFormats particles placement \
        linearSolvers/matrices linearSolvers/direct linearSolvers/multigrid linearSolvers/krylov \
        operators/pairs operators/viscosity operators/order \
        boundary/surfaces boundary/walls boundary/open boundary/patches \
        solid/reference solid/surface solid/materials solid/springs solid/discretisations solid/selection case \
        schemes/resistance schemes/common schemes/projection schemes/solids schemes/monolithic schemes/selection \
        functionObjects/surfaces functionObjects/base functionObjects/fields functionObjects/bodies functionObjects/list

USES_core/base               :=
USES_core/dictionary         := core/base
USES_core/control            := core/dictionary
USES_geometry                := core/base
USES_surfaceTools            := geometry
USES_fileFormats             := core/dictionary
USES_particles               := core/base
USES_placement               := particles geometry
USES_linearSolvers/matrices  := core/base
USES_linearSolvers/direct    := linearSolvers/matrices
USES_linearSolvers/multigrid := linearSolvers/matrices core/dictionary
USES_linearSolvers/krylov    := linearSolvers/direct linearSolvers/multigrid
USES_operators/pairs         := particles linearSolvers/matrices core/dictionary
USES_operators/viscosity     := operators/pairs
USES_operators/order         := operators/pairs
USES_boundary/surfaces       := particles geometry fileFormats core/control
USES_boundary/walls          := boundary/surfaces operators/pairs
USES_boundary/open           := boundary/surfaces
USES_boundary/patches        := boundary/walls boundary/open
USES_solid/reference         := linearSolvers/matrices particles core/dictionary
USES_solid/surface           := solid/reference
USES_solid/materials         := core/dictionary
USES_solid/springs           := solid/reference solid/materials linearSolvers/krylov
USES_solid/discretisations   := solid/reference solid/materials
USES_solid/selection         := solid/springs solid/discretisations
USES_case                    := boundary/patches operators/viscosity operators/order solid/selection
USES_schemes/resistance      := case
USES_schemes/common          := schemes/resistance solid/surface
USES_schemes/projection      := schemes/common
USES_schemes/solids          := schemes/common
USES_schemes/monolithic      := schemes/solids
USES_schemes/selection       := schemes/projection schemes/monolithic
USES_functionObjects/surfaces := schemes/common
USES_functionObjects/base    := functionObjects/surfaces
USES_functionObjects/fields  := functionObjects/base
USES_functionObjects/bodies  := functionObjects/base
USES_functionObjects/list    := functionObjects/fields functionObjects/bodies

# Programs: one folder each, all its *.C.  They see every library; packages beyond the common ones:
APPS := $(sort $(dir $(wildcard applications/solvers/*/*.C applications/utilities/*/*/*.C)))
PKG_generateParticles := -lgmsh

# Tests: one doctest program per folder of tests/, seeing the libraries of the same name and below; one
# named after a program sees every library and all of the program but its main.  ALSO_: what a test needs beyond
TESTS := $(sort $(notdir $(patsubst %/,%,$(dir $(wildcard tests/*/main.C)))))
ALSO_operators := linearSolvers/krylov
ALSO_boundary  := operators/viscosity
PKG_TEST_generateParticles := $(PKG_generateParticles)

# ---- flags ---------------------------------------------------------------------------------------
CXX      ?= g++
# g++ 12 is wrong about word + word (GCC bug 105651), and says so once <string> is in a precompiled header
WARN     := -Wall -Wextra -Wno-psabi -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds
FLAGS_Release  := -O3 -DNDEBUG
FLAGS_Debug    := -O0 -g -D_GLIBCXX_ASSERTIONS
# A finding ends the program.  Sanitizers make g++ 12 warn of libstdc++'s and Eigen's own code (GCC bug 105562)
SANITIZERS     := address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS
FLAGS_Sanitize := -O2 -g1 -Wno-maybe-uninitialized -fsanitize=$(SANITIZERS)
# `make fuzz` only, with clang: its libFuzzer is what chooses the bytes
FLAGS_Fuzz     := -O1 -g1 -fsanitize=fuzzer-no-link,$(SANITIZERS)
ifeq ($(FLAGS_$(OPT)),)
$(error OPT=$(OPT) is not known; valid: Release Debug Sanitize)
endif
ifeq ($(OPT),Fuzz)
WARN += -Wno-unknown-warning-option
endif
# Threads are started in core/base/execution only: Eigen's own would spin and depend on their number.
# no-math-errno and no-trapping-math keep NaN checks working; finite-math-only would not
HDF5_I   := $(shell pkg-config --cflags hdf5 2>/dev/null || echo -I/usr/include/hdf5/serial)
HDF5_L   := $(shell pkg-config --libs-only-L hdf5 2>/dev/null || echo -L/usr/lib/x86_64-linux-gnu/hdf5/serial)
CXXFLAGS := -std=c++20 $(WARN) $(FLAGS_$(OPT)) -fno-math-errno -fno-trapping-math -fopenmp \
            -DEIGEN_DONT_PARALLELIZE -isystem /usr/include/eigen3 -isystem /usr/include/suitesparse $(HDF5_I:-I%=-isystem %)
LDLIBS   := $(HDF5_L) -lmuparser -lre2 -lhdf5 -lcholmod -lumfpack -lopenblas -fopenmp

# ---- rules ---------------------------------------------------------------------------------------
reverse   = $(if $(1),$(call reverse,$(wordlist 2,$(words $(1)),$(1))) $(firstword $(1)))
closure   = $(sort $(1) $(foreach u,$(1),$(call closure,$(USES_$(u)))))
ordered   = $(filter $(call closure,$(1)),$(LIBS))
quoted    = $(foreach l,$(1),-iquote src/$(l))
archives  = $(foreach l,$(call reverse,$(LIBS)),$(if $(wildcard src/$(l)/*.C),$(B)/lib/$(l).a))
archivesOf= $(foreach l,$(call reverse,$(call ordered,$(1))),$(if $(wildcard src/$(l)/*.C),$(B)/lib/$(l).a))
group     = $(if $(filter $(1) $(1)/%,$(LIBS)),$(filter $(1) $(1)/%,$(LIBS)) $(ALSO_$(1)))

.PHONY: all test validate validateLong fuzz demo bench benchPressure clean help format
all: ## build every library and program
help: ## this list
	@grep -hE '^[a-zA-Z]+:.*## ' Makefile | sed -E 's/^([a-zA-Z]+):.*## /  \1\t/' | expand -t 14
	@echo "  OPT=Release|Debug|Sanitize chooses the build; each has its own folder below build/"

define LIBRARY
OBJ_$(1) := $$(patsubst %.C,$(B)/%.o,$$(wildcard src/$(1)/*.C))
$$(OBJ_$(1)): INC = $$(call quoted,$$(call ordered,$(1)))
$(B)/lib/$(1).a: $$(OBJ_$(1))
	@mkdir -p $$(@D); rm -f $$@; ar rcs $$@ $$^
all: $$(if $$(wildcard src/$(1)/*.C),$(B)/lib/$(1).a)
OBJECTS += $$(OBJ_$(1))
endef
$(foreach l,$(LIBS),$(eval $(call LIBRARY,$(l))))

define PROGRAM
OBJ_app_$(notdir $(1)) := $$(patsubst %.C,$(B)/%.o,$$(wildcard $(1)/*.C))
$$(OBJ_app_$(notdir $(1))): INC = $$(call quoted,$$(LIBS)) -iquote $(1)
$(B)/bin/$(notdir $(1)): $$(OBJ_app_$(notdir $(1))) $$(call archives)
	@mkdir -p $$(@D); echo "LD   $$@"
	@$$(CXX) $$(FLAGS_$$(OPT)) $$^ -o $$@ $$(PKG_$(notdir $(1))) $$(LDLIBS)
.PHONY: $(notdir $(1))
$(notdir $(1)): $(B)/bin/$(notdir $(1))
all: $(B)/bin/$(notdir $(1))
OBJECTS += $$(OBJ_app_$(notdir $(1)))
endef
$(foreach a,$(patsubst %/,%,$(APPS)),$(eval $(call PROGRAM,$(a))))

define TEST
OBJ_test_$(1) := $$(patsubst %.C,$(B)/%.o,$$(filter-out %/libFuzzer/entry.C,$$(wildcard tests/$(1)/*.C tests/$(1)/*/*.C)))
$$(OBJ_test_$(1)): INC = $$(call quoted,$$(if $$(call group,$(1)),$$(call ordered,$$(call group,$(1))),$$(LIBS))) -iquote tests -iquote tests/$(1) $$(addprefix -iquote ,$$(filter %/$(1)/,$$(APPS)))
$(B)/testPrograms/$(1): $$(OBJ_test_$(1)) $$(filter-out %/$(1).o,$$(OBJ_app_$(1))) $$(if $$(call group,$(1)),$$(call archivesOf,$$(call group,$(1))),$$(call archives))
	@mkdir -p $$(@D); echo "LD   $$@"
	@$$(CXX) $$(FLAGS_$$(OPT)) $$^ -o $$@ $$(PKG_TEST_$(1)) $$(LDLIBS)
OBJECTS += $$(OBJ_test_$(1))
testPrograms: $(B)/testPrograms/$(1)
endef
# Headers that no source of ours changes are compiled once.  PRECOMPILED= compiles without: a source must name what it needs
PRECOMPILED ?= $(if $(filter Fuzz,$(OPT)),,$(B)/precompiled.H)
$(B)/precompiled.H.gch: Makefile
	@mkdir -p $(@D); echo "CXX  $(B)/precompiled.H"
	@printf '#include <%s>\n' Eigen/Dense algorithm array cmath filesystem fstream functional iomanip iostream limits map memory \
	    numeric optional set sstream stdexcept string vector > $(B)/precompiled.H
	@$(CXX) $(CXXFLAGS) -x c++-header $(B)/precompiled.H -o $@
OBJECTS += $(addsuffix .gch,$(PRECOMPILED))

.PHONY: testPrograms testPackages
testPrograms:
testPackages: # lists what is missing and installs it, as the demo does
	@{ echo '#include <doctest/doctest.h>' | $(CXX) -E -x c++ - && command -v h5dump && command -v gmsh; } \
	    > /dev/null 2>&1 || bin/installDependencies run test
$(foreach t,$(TESTS),$(eval $(call TEST,$(t))))
ifneq ($(filter test testPrograms,$(MAKECMDGOALS)),)
$(OBJECTS): | testPackages
endif

# Programs that libFuzzer drives: one per reader of foreign files (tests/fuzz/targets.H)
FUZZED := dictionary csv stl hdf5 hdf5Damaged
define FUZZER
$(B)/fuzz/$(1): tests/fuzz/libFuzzer/entry.C $(B)/tests/fuzz/$(1:Damaged=)Target.o $$(call archivesOf,geometry fileFormats)
	@mkdir -p $$(@D); echo "LD   $$@"
	@$$(CXX) $$(CXXFLAGS) -fsanitize=fuzzer -iquote src/core/base -iquote src/core/dictionary -iquote tests/fuzz -DTARGET=$(1) $$^ -o $$@ $$(HDF5_L) -lmuparser -lre2 -lhdf5
fuzzTargets: $(B)/fuzz/$(1)
endef
.PHONY: fuzzTargets
$(foreach f,$(FUZZED),$(eval $(call FUZZER,$(f))))

$(B)/%.o: %.C Makefile $(addsuffix .gch,$(PRECOMPILED))
	@mkdir -p $(@D); echo "CXX  $<"
	@$(CXX) $(CXXFLAGS) $(addprefix -include ,$(PRECOMPILED)) $(INC) -MMD -MP -c $< -o $@

test: all testPrograms ## install what is missing, build and run every test, JOBS at a time (OPT=Sanitize: hours)
	@ISPF_BIN=$(B)/bin JOBS=$(or $(JOBS),$(shell nproc)) OMP_NUM_THREADS=1 LIMIT=$(if $(filter Release,$(OPT)),1800,36000) bin/runTests $(B)/testPrograms

validate: all ## every tutorial against its reference (at most 2 hours on 2 cores); CASES="a b" runs a choice of them
	@bin/ispfValidate -tier validate -jobs $(or $(JOBS),2) $(CASES)

validateLong: all ## the same with the studies of days; what was interrupted goes on
	@bin/ispfValidate -tier validateLong -jobs $(or $(JOBS),2) $(CASES)

fuzz: ## RUNS (100000) arbitrary inputs for each reader of foreign files, with clang's libFuzzer
	@bin/installDependencies run fuzz
	@$(MAKE) --no-print-directory OPT=Fuzz CXX=clang++ fuzzTargets
	@bin/runFuzz build/Fuzz/fuzz $(or $(RUNS),100000) $(FUZZED)

demo: ## install what is missing, build, run the benchmark, draw it, compare with the published numbers
	@bin/demo

bench: all ## what a step, a start, a write and memory cost on the whole HCC, beside STREAM and icoFoam: tests/benchmarks/results.csv
	@bin/bench $(BENCH)

# The baseline of the pressure benchmark is built where its library is installed (bin/installDependencies bench)
BASELINE := $(B)/benchmarks/pressureBaseline
OBJ_baseline := $(B)/tests/benchmarks/pressureBaseline.o $(B)/tests/benchmarks/boomerAMG.o
$(OBJ_baseline): INC = $(call quoted,$(LIBS)) -iquote tests/benchmarks -DOMPI_SKIP_MPICXX -isystem /usr/include/hypre $(shell pkg-config --cflags mpi-c)
$(BASELINE): $(OBJ_baseline) $(call archives)
	@mkdir -p $(@D); echo "LD   $@"
	@$(CXX) $(FLAGS_$(OPT)) $^ -o $@ -lHYPRE $(shell pkg-config --libs mpi-c) $(LDLIBS)
OBJECTS += $(OBJ_baseline)

benchPressure: all $(if $(wildcard /usr/include/hypre/HYPRE.h),$(BASELINE)) ## the pressure solvers on the demo's geometry, with the paper's scheme, beside hypre's
	@bin/benchPressure

format: ## clang-format all sources in place
	@clang-format -i $$(git ls-files '*.C' '*.H')

clean: ## remove build/
	@rm -rf build

-include $(patsubst %.o,%.d,$(filter %.o,$(OBJECTS)))
