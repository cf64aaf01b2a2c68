# Two commands: `make all_blades` runs the main job, `make test` the tests. Both make the virtual environment themselves.
# `make` alone lists all of them: what stands behind ## is their line. CORES=8 uses more cores, FIDELITY=paper another accuracy level.
PYTHON ?= python3
CORES ?= 2
# another one for another Python: make test-fast PYTHON=python3.13 VENV=build/python3.13
VENV ?= .venv
BIN := $(VENV)/bin
LOCK := envs/lock.txt
# programs are run as modules: in a folder with a blank in its name, pip writes scripts that a shell reads, and runs `$()` in the name

PIP_INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint $(LOCK)

.DEFAULT_GOAL := help
.PHONY: help all_blades campbell report test test-fast mutants size lint validation test-validation site setup lock clean-results

help: ## this list
	@awk -F ': .*## ' '/^[a-z][a-z_-]*:.*## / {printf "make %-14s %s\n", $$1, $$2}' Makefile

all_blades: ## the main job, all blades: simulations, figures, ranking, explorer; CORES=8, FIDELITY=draft
campbell: ## only the Campbell diagrams, without simulations
all_blades campbell: $(VENV)/.ready
	$(BIN)/python -m snakemake $@ --cores $(CORES) $(if $(FIDELITY),--config fidelity=$(FIDELITY))

RESULTS ?= results
report: $(VENV)/.ready ## a finished run in one file, for a colleague: report.zip; RESULTS=results/runs/NAME of a run with a name
	@$(BIN)/python -m r37core.console.report '$(RESULTS)'

# the files of tests spread over the cores, the longest first; TESTS names others than tests/; RECORD=yes writes their durations, which the order follows
SPREAD := --numprocesses $(CORES) --dist loadfile --no-loadscope-reorder --max-worker-restart 0
test: $(VENV)/.ready ## all tests
	$(BIN)/python -m pytest $(TESTS) $(SPREAD) $(if $(RECORD),--record-durations)

test-fast: $(VENV)/.ready ## the tests that neither run Snakemake nor build larger models
	$(BIN)/python -m pytest -q -m 'not slow' $(TESTS) $(SPREAD)

# a sample, and what they missed; MUTANTS='results/stress_recovery.py --each 20' for one module
mutants: $(VENV)/.ready ## whether the tests notice small changes of the code: about half an hour
	$(PIP_INSTALL) --editable '.[test,mutants]'
	$(BIN)/python validation/mutants.py $(MUTANTS)

size: ## tokens of each package, of tests and validation, next to the numbers kept in pyproject.toml
	@'$(PYTHON)' validation/size.py

lint: $(VENV)/.ready ## ruff, snakefmt, mypy, snakemake --lint
	$(BIN)/python -m ruff check .
	$(BIN)/python -m ruff format --check .
	$(BIN)/python -m snakefmt --check Snakefile workflow src/r37/study.smk validation
	$(BIN)/python -m mypy
	$(BIN)/python -m snakemake --lint

# the numbers of the engine first: what is behind them is out of date only if one of them moves. Two runs of the product at a time,
# or one model of the finest mesh beside a light step
validation: $(VENV)/.docs ## tables and pictures of the pages that are out of date; EVERY=true all of them, in two hours
	$(BIN)/python -m snakemake -s validation/Snakefile --cores $(CORES) engine
	$(BIN)/python -m snakemake -s validation/Snakefile --cores $(CORES) --resources mem_mb=4600 $(if $(EVERY),--config every=$(EVERY))

test-validation: ## the tests of what makes the tables and pictures of the pages
	$(MAKE) test TESTS=validation/tests

# a warning is an error
site: $(VENV)/.docs ## the documentation as a site that opens from the disk: site/index.html
	$(BIN)/python -m sphinx --quiet --fail-on-warning --keep-going --conf-dir docs/site docs site

$(VENV)/.docs: $(VENV)/.ready
	$(PIP_INSTALL) --editable '.[docs]'
	@touch $@

setup: $(VENV)/.ready ## the virtual environment .venv, which all others make where it is missing

$(VENV)/.ready: pyproject.toml $(LOCK) envs/system_libraries.sh
	@'$(PYTHON)' -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "r37 needs Python 3.11 or newer; say which with: make PYTHON=/path/to/python3.11 ..." >&2; exit 1; }
	@'$(PYTHON)' -m venv $(VENV) || \
		{ echo "the venv module is missing; on Debian: apt-get install python3-venv" >&2; exit 1; }
	$(PIP_INSTALL) --editable '.[test]'
	sh envs/system_libraries.sh $(BIN)/python
	@touch $@

lock: ## the newest versions that pyproject.toml allows, of all packages that these commands install: envs/lock.txt
	'$(PYTHON)' -m venv --clear build/lock
	build/lock/bin/python -m pip install --quiet --disable-pip-version-check '.[test,mutants,docs,ansys,search]'
	{ echo "# written by make lock: what pip installed"; build/lock/bin/python -m pip freeze --exclude r37; } > $(LOCK).new
	mv $(LOCK).new $(LOCK)
	rm -rf build/lock

clean-results: ## remove results/ and logs/
	rm -rf results logs
