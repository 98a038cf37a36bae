.DEFAULT_GOAL := help
PYTHON ?= python3
BIN := .venv/bin
PORT ?= 8000
PAGE := backend/svsa_server/page/index.html
GUIDE := backend/svsa_server/guide
PAGE_SOURCES := $(shell find frontend/web -path '*/node_modules' -prune -o -type f -print) \
  frontend/scene/svsa_scene/cameras.json docs/openapi.json
UV := 0.13.9
LOCKED_EXTRAS := server client bench plot nidaqmx pandas xarray cluster lti gym
# Each test module in one process, in the order of tests/conftest.py: the browser tests are last.
# Four processes on two cores, because many tests wait for a server or a browser.
BY_MODULE := --dist loadfile --no-loadscope-reorder
BY_FOUR := -n 4 $(BY_MODULE)
# For compute-bound tests, and in `make test` for wall-clock tests.
BY_TWO := -n 2 $(BY_MODULE)
# Less search depth than in `make test-all` (tests/conftest.py).
SHOWN := --hypothesis-profile=shown
SLOWEST := --durations=10
SERVED := package docs hardware scene server client browser
# Files in which the terms of .ci/replaced_terms.txt are rejected.
WRITTEN := CHANGELOG.md CONTRIBUTING.md README.md backend docs frontend svsa \
  tests ':!tests/data'
WEB := PATH="$(CURDIR)/$(BIN):$$PATH" npm --prefix frontend/web
WALL_CLOCK = $$(grep -rl --include='test_*.py' 'mark\.wall_clock' tests)
export PYTHONDONTWRITEBYTECODE =
# The tests of the page and the import of the tests need no compiled functions: they run in parallel
# with the compiler.
COMPILE_AND_TEST_PAGE = $(BIN)/python -m tests.compile_all $(COMPILED) & \
  $(WEB) test && $(MAKE) --no-print-directory .venv/tests; \
  page=$$?; wait $$! && exit $$page

.PHONY: help run dev bench-demo test test-all test-rest quick check check-beside-types hooks format page docs schema lock screenshots ranking examples benchmark clean

help:  ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 20

run: .venv/installed $(PAGE)  ## start the lab on http://127.0.0.1:8000/ (PORT=…)
	@$(BIN)/svsa serve --port $(PORT)

# Ctrl-C stops both.
dev: .venv/installed $(PAGE)  ## start the lab; the page is rebuilt on every change (use the port that Vite prints)
	@$(BIN)/svsa serve --port 8000 & $(WEB) run dev

bench-demo: .venv/installed $(PAGE)  ## start the lab on the emulator
	@$(BIN)/svsa emulator --idle-s 30 & $(BIN)/svsa serve --port $(PORT) --bench svsa/hardware/emulator/bench.toml

test: .venv/installed $(PAGE)  ## run fast tests of almost all documented behaviour, and of the main workflows
	@$(COMPILE_AND_TEST_PAGE)
	$(BIN)/pytest $(BY_FOUR) $(SHOWN) $(SLOWEST) -m "not exhaustive and not wall_clock and (smoke or not browser)"
	$(BIN)/pytest $(BY_TWO) $(SLOWEST) -m "not exhaustive and wall_clock and smoke" $(WALL_CLOCK)

test-all: COMPILED = --exhaustive
test-all: .venv/installed $(PAGE)  ## run every test
	@$(COMPILE_AND_TEST_PAGE)
	$(BIN)/pytest $(BY_FOUR) $(SLOWEST) -m "not wall_clock"
	$(BIN)/pytest $(SLOWEST) -m wall_clock $(WALL_CLOCK)

test-rest: COMPILED = --exhaustive
test-rest: .venv/installed $(PAGE)  ## run what `make test` leaves out, and its searches at full depth
	@$(BIN)/python -m tests.compile_all $(COMPILED) & $(MAKE) --no-print-directory .venv/tests && wait $$!
	$(BIN)/pytest $(BY_FOUR) $(SLOWEST) -m "(exhaustive or hypothesis or browser and not smoke) and not wall_clock"
	$(BIN)/pytest $(SLOWEST) -m "wall_clock and not smoke" $(WALL_CLOCK)

quick: COMPILED = --quick
quick: .venv/installed  ## run fast tests without server, bench or browser
	@$(COMPILE_AND_TEST_PAGE)
	$(BIN)/pytest $(BY_TWO) $(SHOWN) -q -m "not long and not exhaustive and not wall_clock" $(SERVED:%=--ignore=tests/%)

check: .venv/installed $(PAGE)  ## check format, lint, terms, types, import layers, generated files, size
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	git ls-files -z -- $(WRITTEN) | xargs -0 $(BIN)/codespell
	@echo $(BIN)/basedpyright; $(BIN)/basedpyright > .venv/types 2>&1 & \
	  $(MAKE) --no-print-directory check-beside-types; beside=$$?; \
	  wait $$!; types=$$?; cat .venv/types; exit $$((types | beside))

# The type check takes longest; its output is printed after that of the other checks.
check-beside-types:
	$(BIN)/lint-imports
	@$(BIN)/python -m tests.package.size --check
	@$(BIN)/svsa openapi | diff -q docs/openapi.json - || (echo "Run: make schema"; exit 1)
	$(WEB) run check

hooks: .venv/installed  ## run `make check` before every commit
	@$(BIN)/pre-commit install

format: .venv/installed $(PAGE)  ## format the code
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(WEB) run format

page: $(PAGE)  ## build the page

$(PAGE): .venv/installed $(PAGE_SOURCES)
	@$(BIN)/python frontend/web/hatch_build.py
	@touch $@

schema: .venv/installed  ## docs/openapi.json, docs/permissions.txt, docs/deploy/lab.env, the page's types of the API
	$(BIN)/svsa openapi > docs/openapi.json
	$(BIN)/svsa openapi --permissions > docs/permissions.txt
	$(BIN)/svsa openapi --settings > docs/deploy/lab.env
	$(WEB) run schema

docs: .venv/installed  ## build the documentation site, which the lab serves at /docs/guide/
	@$(BIN)/python frontend/web/hatch_build.py --guide

screenshots: .venv/installed $(PAGE)  ## create the README's pictures
	$(BIN)/python -m tests.browser.screenshots

ranking: .venv/installed  ## after a change of a law: tune and measure every law, and write the pages
	$(BIN)/svsa tune --all
	$(BIN)/svsa ranking run --save svsa/evaluation/ranking/results.json
	$(BIN)/svsa ranking bench ndobc_s ndobc_w --save svsa/evaluation/ranking/bench_results.json
	$(BIN)/svsa ranking publish

examples: .venv/installed  ## compute the finished study and scenario that the page shows first
	@rm -rf .venv/examples && mkdir -p svsa/evaluation/studies/examples/load-example
	SVSA_DATA=.venv/examples $(BIN)/svsa study run load --runs 256 --name load-example
	cp .venv/examples/studies/load-example/study.json \
	  .venv/examples/studies/load-example/rows.parquet svsa/evaluation/studies/examples/load-example
	$(BIN)/svsa falsify search impulse --output svsa/evaluation/falsifier/examples/impulse-ndobc.toml

benchmark: .venv/installed  ## measure the cost of the loop and of a C loop with the same work
	$(BIN)/svsa benchmark

lock: .venv/installed  ## write requirements.lock with the newest version of every package and its hashes
	$(BIN)/uv pip compile --universal --python-version 3.11 --generate-hashes --no-header \
	  --no-annotate --group dev $(LOCKED_EXTRAS:%=--extra %) pyproject.toml -o requirements.lock --upgrade -q

.venv/installed: requirements.lock pyproject.toml
	@echo "Preparing the environment (once; a minute or two) …"
	@test -x $(BIN)/python || $(PYTHON) -m venv .venv
	@$(BIN)/uv --version 2>&1 | grep -q "^uv $(UV) " || \
	  $(BIN)/pip install --quiet --disable-pip-version-check uv==$(UV)
	@$(BIN)/uv pip sync --quiet --compile-bytecode --require-hashes requirements.lock
	@$(BIN)/uv pip install --quiet --no-deps --no-build-isolation --editable .
	@touch $@

# Every pytest process imports all test files. After a first process has done so, this takes half the time.
.venv/tests: .venv/installed $(shell find tests -name '*.py')
	@$(BIN)/pytest --collect-only -q > $@.read || { cat $@.read; false; }
	@mv $@.read $@

clean:  ## remove installed and built files
	rm -rf .venv backend/svsa_server/page $(GUIDE) docs/_build docs/reference/generated frontend/web/node_modules
