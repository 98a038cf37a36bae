# make run     the running lab            make check   format, lint, types, layers
# make bench-demo  the lab on the emulated rig
# make test    every test                 make format  put the code into shape
# make quick   those that need no server, bench or browser
PYTHON ?= python3
BIN := .venv/bin
PORT ?= 8000
PAGE := backend/svsa_server/page/index.html
PAGE_SOURCES := $(shell find frontend/web -path '*/node_modules' -prune -o -type f -print)
# Each module in one of two processes, in the order of the folders: the browser last.
SIDE_BY_SIDE := -n 2 --dist loadfile --no-loadscope-reorder
WEB := PATH="$(CURDIR)/$(BIN):$$PATH" npm --prefix frontend/web

.PHONY: run bench-demo test quick check format page schema lock screenshots bench clean

run: .venv/installed $(PAGE)
	@$(BIN)/svsa serve --port $(PORT)

bench-demo: .venv/installed $(PAGE)
	@$(BIN)/svsa rig --idle-s 30 & $(BIN)/svsa serve --port $(PORT) --bench svsa/rig/bench.toml

test: .venv/installed $(PAGE)
	@$(BIN)/svsa compile
	$(BIN)/pytest $(SIDE_BY_SIDE) -m "not wall_clock"
	$(BIN)/pytest -m wall_clock
	$(WEB) test

quick: .venv/installed
	@$(BIN)/svsa compile
	$(BIN)/pytest $(SIDE_BY_SIDE) -q tests/equations tests/experiment
	$(WEB) test

check: .venv/installed $(PAGE)
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/basedpyright
	$(BIN)/lint-imports
	@$(BIN)/svsa openapi > .venv/openapi.json
	@$(WEB) run --silent schema -- "$(CURDIR)/.venv/openapi.json" --check
	$(WEB) run check

format: .venv/installed $(PAGE)
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .
	$(WEB) run format

page: $(PAGE)

$(PAGE): .venv/installed $(PAGE_SOURCES)
	@$(BIN)/python frontend/web/hatch_build.py
	@touch $@

schema: .venv/installed
	$(BIN)/svsa openapi > .venv/openapi.json
	$(WEB) run schema -- "$(CURDIR)/.venv/openapi.json"

screenshots: .venv/installed $(PAGE)
	$(BIN)/python -m tests.browser.screenshots

bench: .venv/installed
	$(BIN)/python -m tests.bench

lock: .venv/installed
	$(BIN)/uv pip compile --universal --python-version 3.11 --generate-hashes --no-header \
	  --no-annotate --group dev --all-extras pyproject.toml -o requirements.lock --upgrade -q

.venv/installed: requirements.lock pyproject.toml
	@echo "Preparing the environment (once; a minute or two) …"
	@test -x $(BIN)/python || $(PYTHON) -m venv .venv
	@test -x $(BIN)/uv || $(BIN)/pip install --quiet --disable-pip-version-check uv
	@$(BIN)/uv pip sync --quiet --compile-bytecode --require-hashes requirements.lock
	@$(BIN)/uv pip install --quiet --no-deps --no-build-isolation --editable .
	@touch $@

clean:
	rm -rf .venv backend/svsa_server/page frontend/web/node_modules
