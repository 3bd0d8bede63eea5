# Verbs only: CMake knows the files. `make help` lists them.
BUILD ?= build
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
MAKEFLAGS += --no-print-directory

.PHONY: all demo test prove check lint cgal-check check-sanitize valgrind fuzz faults determinism storm endurance bench paper clean \
  help
all:
	@.ci/setup
	@cmake -S . -B $(BUILD)
	@cmake --build $(BUILD) -j $(JOBS)

demo:
	@.ci/setup
	@cmake -S . -B $(BUILD)
	@cmake --build $(BUILD) -j $(JOBS) --target fpo-shape fpo-remesh fpo-quality
	@mkdir -p $(BUILD)/demo
	$(BUILD)/fpo-shape double-torus -o $(BUILD)/demo/double-torus.obj
	$(BUILD)/fpo-remesh $(BUILD)/demo/double-torus.obj -n 2000 -o $(BUILD)/demo/remesh.obj --picture $(BUILD)/demo/remesh.svg
	$(BUILD)/fpo-quality $(BUILD)/demo/remesh.obj --reference $(BUILD)/demo/double-torus.obj
	@echo "Wrote $(BUILD)/demo/double-torus.obj (the input), $(BUILD)/demo/remesh.obj (2000 samples), $(BUILD)/demo/remesh.svg (its picture)."

test:
	@.ci/setup tests
	@cmake -S . -B $(BUILD)
	@cmake --build $(BUILD) -j $(JOBS) --target fpo-tests
	.ci/tests $(BUILD)/fpo-tests $(JOBS)

# All cases, the long ones too: the same promises on more and larger examples.
prove:
	@.ci/setup tests
	@cmake -S . -B $(BUILD)
	@cmake --build $(BUILD) -j $(JOBS) --target fpo-tests
	FPO_PROVE=1 .ci/tests $(BUILD)/fpo-tests $(JOBS)

check: test
	.ci/check-sources
	.ci/library $(BUILD)

# Configures without building: clang-tidy asks for the commands only.
lint:
	@.ci/setup lint
	@cmake -S . -B $(BUILD)-lint -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DFPO_UNITY=OFF >/dev/null
	.ci/lint $(BUILD)-lint $(JOBS)

# Needs libcgal-dev, which nothing else does.
cgal-check:
	@.ci/setup cgal
	@cmake -S . -B $(BUILD)-cgal -DFPO_WITH_CGAL=ON
	@cmake --build $(BUILD)-cgal -j $(JOBS) --target cgal-tests
	$(BUILD)-cgal/cgal-tests

check-sanitize:
	@.ci/setup tests
	@cmake -S . -B $(BUILD)-sanitize -DFPO_SANITIZE=ON -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g"
	@cmake --build $(BUILD)-sanitize -j $(JOBS) --target fpo-tests
	.ci/tests $(BUILD)-sanitize/fpo-tests $(JOBS)

valgrind: all
	@.ci/setup valgrind
	.ci/valgrind $(BUILD)

# The tools with the sanitizers in (they are some ten times slower), on spoilt surfaces.
FUZZ_SECONDS ?= 60
FUZZ_SEED ?= 1
fuzz:
	@.ci/setup tests
	@cmake -S . -B $(BUILD)-sanitize -DFPO_SANITIZE=ON -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g"
	@cmake --build $(BUILD)-sanitize -j $(JOBS) --target fuzz
	$(BUILD)-sanitize/fuzz --seconds $(FUZZ_SECONDS) --seed $(FUZZ_SEED) --time-limit 60

# Signals at dozens of moments, full disks of several sizes, memory that ends anywhere, for all tools.
faults:
	@.ci/setup tests
	@cmake -S . -B $(BUILD)
	@cmake --build $(BUILD) -j $(JOBS) --target fpo-tests
	$(BUILD)/fpo-tests --no-skip --test-suite=faults

# The tools from two compilers and at two levels of optimization.
determinism: all
	@.ci/setup clang
	@cmake -S . -B $(BUILD)-clang -DCMAKE_CXX_COMPILER=clang++
	@cmake --build $(BUILD)-clang -j $(JOBS)
	@cmake -S . -B $(BUILD)-O1 -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG"
	@cmake --build $(BUILD)-O1 -j $(JOBS)
	.ci/determinism $(BUILD) $(BUILD)-clang $(BUILD)-O1

# Every exact predicate so many times, compared with exact integers.
STORM_COUNT ?= 10000000
STORM_SEED ?= 1
storm:
	@.ci/setup tests
	@cmake -S . -B $(BUILD)
	@cmake --build $(BUILD) -j $(JOBS) --target storm
	$(BUILD)/storm --count $(STORM_COUNT) --seed $(STORM_SEED) --threads $(JOBS)

# So many moves on every domain, verified; faults are saved among the replays, which are tests.
ENDURANCE_MOVES ?= 1000000
ENDURANCE_SEED ?= 1
endurance:
	@.ci/setup tests
	@cmake -S . -B $(BUILD)
	@cmake --build $(BUILD) -j $(JOBS) --target endurance
	$(BUILD)/endurance --moves $(ENDURANCE_MOVES) --seed $(ENDURANCE_SEED) --threads $(JOBS) --keep tests/fixtures/replays

bench: all
	@cmake --build $(BUILD) -j $(JOBS) --target benches
	@for program in $(BUILD)/bench-*; do \
	  case $$program in *-scaling) arguments=$(BUILD)/scaling;; *) arguments=;; esac; \
	  if [ -x $$program ]; then echo "== $$program $$arguments"; $$program $$arguments || exit 1; fi; done

# Tables 2 to 4 and figures 7 to 11 of the paper for those of its models that are in the folder.
MODELS ?= ../shared/models
paper: all
	$(BUILD)/fpo-paper $(MODELS) -o $(BUILD)/paper --threads $(JOBS)

clean:
	rm -rf $(BUILD) $(BUILD)-sanitize $(BUILD)-cgal $(BUILD)-lint $(BUILD)-clang $(BUILD)-O1

help:
	@echo "make demo            build, remesh a double torus with 2000 samples, print its quality"
	@echo "make test            build and run every test, JOBS at a time"
	@echo "make prove           the same tests with more and larger examples"
	@echo "make check           test, then check format and layering of the sources"
	@echo "make lint            clang-tidy and Cppcheck over all sources (installs them)"
	@echo "make cgal-check      predicates, triangulations and diagrams against CGAL (installs libcgal-dev)"
	@echo "make check-sanitize  the tests under AddressSanitizer and UndefinedBehaviorSanitizer"
	@echo "make valgrind        the smallest jobs of all tools under Valgrind (installs it)"
	@echo "make fuzz            the tools under the same on spoilt surfaces, FUZZ_SECONDS=60 from FUZZ_SEED=1"
	@echo "make faults          signals, full disks and little memory at many moments, for all tools"
	@echo "make determinism     the same bytes from GCC and Clang, -O1 and -O3, 1, 2 and 8 threads"
	@echo "make storm           every exact predicate STORM_COUNT=10000000 times on adversarial draws"
	@echo "make endurance       ENDURANCE_MOVES=1000000 moves on each of eight domains, verified"
	@echo "make bench           build and run the benchmarks; writes build/scaling.csv, build/scaling.svg"
	@echo "make paper           the paper's tables and figures again, for its models in MODELS=../shared/models"
	@echo "make clean           remove what was built"
