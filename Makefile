# One target for each task. The builds themselves are CMake presets.

FUZZ_SECONDS ?= 30
# A compilation takes up to 2 GB of memory; set JOBS=1 if memory is scarce.
JOBS ?= $(shell nproc)

RELEASE := build/release
SINGLE := build/single
TOOL := $(RELEASE)/gearlash
EXAMPLE := examples/elinco-fd162
INSTALL := bash scripts/install-dependencies
BUILD := cmake --build --parallel $(JOBS) --preset

export CTEST_PARALLEL_LEVEL ?= $(JOBS)

.DEFAULT_GOAL := help
.PHONY: help demo tool test python web web-serve web-bench bench versions clang sanitize fuzz oracle million followed believed designed mapped tuned references referenced \
        programs python-sweep dask-rates rivals derivatives seeded-faults single includes release-check \
        coverage readme readme-check docs docs-check format format-check tidy clean wheel package package-check

help:  ## this list
	@awk -F':.*## ' '/^[a-z-]+:.*## / { printf "  make %-14s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: tool  ## build the tool; does the servo of the thesis hunt? with its picture
	$(TOOL) limit-cycle $(EXAMPLE).toml --plot phase=$(EXAMPLE).svg
	@echo "Picture: $(EXAMPLE).svg"

# A first build leaves out the tests, because their packages may be missing. A build that has tests
# keeps them.
tool:  ## build the tool alone: build/release/gearlash
	@$(INSTALL) run
	@test -f $(RELEASE)/build.ninja || cmake --preset release -DGEARLASH_BUILD_TESTS=OFF
	@$(BUILD) release --target gearlash_tool

test:  ## build everything and run every test
	@$(INSTALL) test
	cmake --preset release -DGEARLASH_BUILD_TESTS=ON -DGEARLASH_BUILD_PYTHON=ON
	$(BUILD) release
	@$(MAKE) --no-print-directory web
	ctest --preset release

python:  ## build the Python module, build/release/python, and run its tests
	@$(INSTALL) test
	cmake --preset release -DGEARLASH_BUILD_TESTS=ON -DGEARLASH_BUILD_PYTHON=ON
	$(BUILD) release --target gearlash_python_package --target gearlash_tool
	ctest --preset release --label-regex '^python$$'

SITE := build/web/site
PORT ?= 8000
web:  ## the explorer in the browser: build/web/site, and in one file explorer.html
	@$(INSTALL) web
	cmake --preset web
	$(BUILD) web

web-serve: web  ## serve it on this machine alone: PORT (8000)
	@echo "http://127.0.0.1:$(PORT)/   (Ctrl-C ends it)"
	@/usr/bin/python3 -m http.server --bind 127.0.0.1 --directory $(SITE) $(PORT)

web-bench: web  ## how fast the page answers a drag, and how much is fetched
	@$(INSTALL) test
	taskset --cpu-list 0 node benchmarks/web/drags.mjs

bench:  ## measure the speed beside SUNDIALS CVODE, Boost.odeint and version 0.1
	@$(INSTALL) bench
	cmake --preset bench
	$(BUILD) bench
	$(BUILD) bench --target run_benchmarks
	@$(MAKE) --no-print-directory versions

# Builds version 0.1 from git's history; without that it says so and measures nothing.
versions:  ## the part of bench beside version 0.1: drives, their time, memory and verdicts
	@$(INSTALL) bench
	cmake --preset bench
	$(BUILD) bench --target gearlash_tool --target score_drives
	benchmarks/beside-version-0.1 --jobs $(JOBS)

python-sweep:  ## gearlash.sweep of a million servos beside the call of C++
	@$(INSTALL) bench python
	cmake --preset bench -DGEARLASH_BUILD_PYTHON=ON
	$(BUILD) bench --target sweep_million --target gearlash_python_package
	PYTHONPATH=build/bench/python benchmarks/python/sweep build/bench/benchmarks/sweep_million

dask-rates:  ## searched drives a second on one Dask worker and on two, and a plan for many nodes
	@$(INSTALL) python
	cmake --preset release -DGEARLASH_BUILD_PYTHON=ON
	$(BUILD) release --target gearlash_python_package
	PYTHONPATH=$(RELEASE)/python benchmarks/python/dask-rates

rivals: tool  ## the thesis's servo through Siconos and Scilab: error and time beside Gearlash
	@$(INSTALL) rivals
	benchmarks/rivals/run --tool $(TOOL)

clang:  ## build everything with clang 16, warnings being errors, and run every test
	@$(INSTALL) test clang
	cmake --preset clang-16
	$(BUILD) clang-16
	ctest --preset clang-16

# The build is a project around Gearlash, tests/around. Left out: tests that read sources, build other
# programs or run scripts, where the sanitizers watch nothing; those that count allocations, which the
# sanitizers count themselves; those of the documents' output and of the page, which repeat those of
# the command line; the oracles, which compare numbers; and fourteen tests that do for minutes what others
# do for seconds.
# SANITIZED, names of folders of tests, builds and runs the tests of these alone, and watches only
# rooms of these names.
ROOMS := base numeric model hybrid closed_form general question input output picture thesis
AROUND := cd tests/around &&
SANITIZED_TARGETS = own_eigen test_on_one_thread gearlash_tool gearlash_python_package reader_fuzzer \
                    $(filter-out test_python,$(SANITIZED:%=test_%))
space := $(subst ,, )
sanitize:  ## clang 16 with AddressSanitizer and UndefinedBehaviorSanitizer, warnings being errors
	@$(INSTALL) test clang
	$(AROUND) cmake --preset asan-ubsan -DGEARLASH_BUILD_PYTHON=ON \
	  -DUNSANITIZED_ROOMS='$(subst $(space),;,$(if $(SANITIZED),$(filter-out $(SANITIZED),$(ROOMS))))'
	$(AROUND) $(BUILD) asan-ubsan $(if $(SANITIZED),--target $(SANITIZED_TARGETS))
	$(AROUND) ctest --preset asan-ubsan \
	  $(if $(SANITIZED),--label-regex '^(around|$(subst $(space),|,$(strip $(SANITIZED))))(-.*)?$$')

# libFuzzer writes new inputs to the first folder, in the build, and only reads the corpus in the
# sources. The build is that of `make sanitize`.
FUZZED := build/asan-ubsan/fuzz
FUZZER := build/asan-ubsan/gearlash/tests/input/fuzz/reader_fuzzer
fuzz:  ## feed random bytes to the readers for FUZZ_SECONDS (30)
	@$(INSTALL) test clang
	$(AROUND) cmake --preset asan-ubsan
	$(AROUND) $(BUILD) asan-ubsan --target reader_fuzzer
	mkdir -p $(FUZZED)
	$(FUZZER) -max_total_time=$(FUZZ_SECONDS) -print_final_stats=1 \
	  -dict=tests/input/fuzz/reader.dict -artifact_prefix=$(FUZZED)- \
	  $(FUZZED) tests/input/fuzz/corpus

oracle: programs  ## 1,000 random servos beside a slow and independent integration
	$(RELEASE)/tests/oracle/oracle_run

followed: programs  ## 2,000 random drives: no ceiling and no proof by energy is violated
	GEARLASH_DRIVES=2000 $(RELEASE)/tests/test_question \
	  --gtest_filter='PropertyCeiling*:PropertyAbsenceByEnergy*:PropertyGapSpeed*:PropertySafeStarts*'
	$(RELEASE)/tests/oracle/drives/bound_drives --count 200 --follow

KINDS := industrial filtered-cascade weight-at-limit state-space moving-reference extreme \
         without-integral
believed: programs  ## 500 random drives of six kinds: each start followed longer, and others
	set -e; for kind in $(KINDS); do echo; echo "== $$kind"; $(RELEASE)/tests/oracle/drives/score_drives \
	  --kind $$kind --seeds 1:84 --starts 3 --random-starts 20 --follow --most-events 300000; done
	$(RELEASE)/tests/oracle/drives/score_drives --kind frictionless --seeds 1:2000 --starts 0 --follow

designed: programs  ## random design tasks of drives without a closed form, put back into them
	GEARLASH_TASKS=300 $(RELEASE)/tests/test_question --gtest_filter='PropertySearchedValues.Meet*'
	GEARLASH_TASKS=60 $(RELEASE)/tests/test_question --gtest_filter='PropertySearchedValues.ACondition*'
	$(RELEASE)/tests/oracle/drives/design_drives --count 300

mapped: programs  ## 500 points of 20 maps, followed from neighbour to neighbour, beside their own searches
	GEARLASH_MAPS=20 $(RELEASE)/tests/oracle/drives/test_oracle_drives --gtest_filter='PropertyFollowedMaps*'

tuned: programs  ## gains of 20 industrial drives, tuned for their series, in the fixed-step simulator
	tests/oracle/drives/tune-drives --build $(RELEASE)

references:  ## write the reference numbers of many digits again: tests/*/data/*.dat
	@$(INSTALL) test
	tests/references/make

# REFERENCED times as many as the tests have.
REFERENCED ?= 4
referenced: programs  ## 18,000 other servos and much else beside numbers of many digits
	tests/references/make --times $(REFERENCED) --to build/references
	set -e; for room in closed_form general question; do GEARLASH_REFERENCES=$(CURDIR)/build/references \
	  $(RELEASE)/tests/test_$$room --gtest_filter='*Oracle*'; done

derivatives: programs  ## 300 random limit cycles: their derivatives beside differences
	GEARLASH_CYCLES=300 $(RELEASE)/tests/test_question --gtest_filter='PropertySearchedSensitivity*'

seeded-faults: programs single  ## put small faults into the code: which does no test notice?
	CMAKE_BUILD_PARALLEL_LEVEL=$(JOBS) tests/seeded_faults/run $(RELEASE) --single $(SINGLE) --jobs $(JOBS)

million: programs  ## 1,000,000 random servos beside the certified count of crossings
	$(RELEASE)/tests/oracle/million_servos

programs:  ## build everything, with the programs of tests/oracle that no test runs
	@$(INSTALL) test
	cmake --preset release -DGEARLASH_BUILD_TESTS=ON
	$(BUILD) release --target all --target oracle_programs

coverage:  ## the share of lines that the tests run
	@$(INSTALL) test lint
	cmake --preset coverage
	$(BUILD) coverage
	ctest --preset coverage
	gcovr --root . --filter include --filter src --filter apps build/coverage

readme: shown  ## renew the outputs and the pictures in README.md and docs
	scripts/readme --jobs $(JOBS)

readme-check: shown  ## are they what their commands make now? The slow ones too, which the tests leave out
	scripts/readme --check --jobs $(JOBS)

.PHONY: shown
shown: tool
	@$(BUILD) release --target hybrid_examples --target drive_examples

docs: tool  ## write the pages of docs as HTML: build/docs/html/index.html
	@$(INSTALL) docs python
	@cmake --preset release -DGEARLASH_BUILD_PYTHON=ON
	@$(BUILD) release --target gearlash_drive_schema --target gearlash_python_package
	docs/make/build $(TOOL) $(RELEASE)/records/parameters.json $(RELEASE)/python $(RELEASE)/schemas

docs-check: docs  ## dead links, spelling and long sentences in the pages
	/usr/bin/python3 docs/make/check_pages.py build/docs/source/docs/reference/generated

FORMAT := find include src apps python web/core tests benchmarks examples records -name '*.[ch]pp' \
            -exec clang-format-16

format:  ## lay out all C++ as .clang-format says
	@$(INSTALL) lint
	$(FORMAT) -i {} +

format-check:  ## is all C++ laid out so?
	@$(INSTALL) lint
	$(FORMAT) --dry-run --Werror {} +

# All product files take ten processor-minutes; CI sets TIDIED to the changed ones.
TIDIED ?= $(shell find src apps web/core -name '*.cpp' -not -name wasm_entry.cpp)
tidy: single  ## clang-tidy with the checks of .clang-tidy over the libraries and the tool
	@$(INSTALL) lint
	echo $(TIDIED) | xargs -r -n 1 -P $(JOBS) clang-tidy-16 -p $(SINGLE) --quiet

# All files take over half an hour of a processor; CI sets INCLUDED to the changed ones.
# Left out are what Emscripten compiles, and another project's programs, which have options of their
# own and a compilation each.
INCLUDED ?= $(shell find include src apps python web/core tests -name '*.[ch]pp')
LEFT_OUT := web/core/wasm_entry.cpp tests/install/consumer/%
includes: single  ## does every header and every .cpp file compile by itself?
	@scripts/includes --jobs $(JOBS) $(SINGLE) $(filter-out $(LEFT_OUT),$(INCLUDED))

# Each file has a compilation of its own there. Headers that the build writes are made, no more.
single:
	@$(INSTALL) test
	cmake --preset single
	$(BUILD) single $(addprefix --target ,gearlash_unit_table gearlash_records gearlash_documents \
	                                      gearlash_python_records gearlash_reply_records \
	                                      made_up_records)

# Packed files have the date of the last commit, or of the changelog without git, so that the same
# sources give the same bytes.
wheel package: export SOURCE_DATE_EPOCH ?= $(shell git log -1 --format=%ct 2>/dev/null || \
                                             stat --format=%Y CHANGELOG.md)
wheel:  ## the Python module as a wheel for Debian 12's python3: build/*.whl
	@$(INSTALL) package
	cmake --preset package
	rm -f build/*.whl
	$(BUILD) package --target gearlash_wheel
	mv build/package/wheel/*.whl build

package: web  ## the tool, the library and the Python module as Debian packages: build/*.deb
	@$(INSTALL) package
	cmake --preset package
	rm -f build/*.deb
	$(BUILD) package
	cpack --config build/package/CPackConfig.cmake -B build/package/packages
	mv build/package/packages/*.deb build

package-check: package wheel  ## install them into a bare Debian 12, build/package-root, and use them
	scripts/package-check build/*.deb build/*.whl

# Hours. CONTRIBUTING.md says how a release is made.
release-check: FUZZ_SECONDS := 600
release-check: programs includes readme-check seeded-faults sanitize fuzz bench package-check  ## before a release, beside make test

clean:  ## remove all that was built
	rm -rf build examples/*.svg
