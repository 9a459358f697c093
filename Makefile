# Every target works in a fresh clone; the first one that needs it makes .venv.
# The interpreter to make it with, 3.10 or later: make PYTHON=python3.12 test

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready

.PHONY: demo test check fmt bench bless dist clean

demo: $(READY) ## Compile an example and show what was made.
	$(BIN)/swarmc build examples/search_and_rescue -o out
	find out -type f | LC_ALL=C sort

test: $(READY) ## Run the tests.
	$(BIN)/pytest

check: $(READY) ## Check format, style and types.
	$(BIN)/ruff format --check
	$(BIN)/ruff check
	$(BIN)/mypy

fmt: $(READY) ## Format the code and repair its style.
	$(BIN)/ruff format
	$(BIN)/ruff check --fix

bench: $(READY) ## Measure the phases on large models.
	$(BIN)/python benchmarks/bench.py

bless: $(READY) ## Take today's output as what the golden tests expect.
	$(BIN)/pytest --bless

dist: $(READY) ## Build the source distribution and the wheel.
	$(BIN)/python -m build

clean: ## Remove what was built, except .venv.
	rm -rf build dist out .mypy_cache .ruff_cache .pytest_cache .hypothesis
	find src generators tests benchmarks -name __pycache__ -prune -exec rm -rf {} +

$(READY): pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[dev]'
	touch $@
