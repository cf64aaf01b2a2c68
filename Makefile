# Two commands: `make all_blades` runs the main job, `make test` the tests. Both make the virtual environment themselves.
# `make campbell` does the structural half alone. CORES=8 uses more cores, FIDELITY=paper another accuracy level.
PYTHON ?= python3
CORES ?= 2
VENV := .venv
BIN := $(VENV)/bin
LOCK := envs/lock.txt
# programs are run as modules: in a folder with a blank in its name, pip writes scripts that a shell reads, and runs `$()` in the name

PIP_INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check --constraint $(LOCK)

.PHONY: all_blades campbell report test test-fast test-slurm mutants lint bench claims fingerprint site tutorial setup lock clean clean-results

all_blades campbell: $(VENV)/.ready
	$(BIN)/python -m snakemake $@ --cores $(CORES) $(if $(FIDELITY),--config fidelity=$(FIDELITY))

# figures, tables, workflow and run times of a finished run in one file, for a colleague; RESULTS=results/runs/<name> of one with a name
RESULTS ?= results
report: $(VENV)/.ready
	@$(BIN)/python -m snakemake all_blades --report '$(RESULTS)/report.zip' $(if $(FIDELITY),--config fidelity=$(FIDELITY)) || \
		{ echo "the report is made of a finished run: make all_blades, then make report" >&2; exit 1; }

# the files of tests spread over the cores, in the order of tests/conftest.py
test: $(VENV)/.ready
	$(BIN)/python -m pytest --numprocesses $(CORES) --dist loadfile --no-loadscope-reorder

# without those that run Snakemake or build larger models
test-fast: $(VENV)/.ready
	$(BIN)/python -m pytest -q -m 'not slow'

# parts of a sweep on a Slurm of one node, which the test starts; needs root, and installs Slurm where there is apt-get
test-slurm: $(VENV)/.ready
	sh envs/slurm.sh
	R37_SLURM=1 $(BIN)/python -m pytest tests/test_slurm.py

# whether the tests notice small changes of the code: a sample, about half an hour, and what they missed; MUTANTS='results/stress_recovery.py --each 20' for one module
mutants: $(VENV)/.ready
	$(PIP_INSTALL) --editable '.[test,mutants]'
	$(BIN)/python benchmarks/mutants.py $(MUTANTS)

lint: $(VENV)/.ready
	$(BIN)/python -m ruff check .
	$(BIN)/python -m ruff format --check .
	$(BIN)/python -m snakefmt --check Snakefile workflow src/r37/study.smk
	$(BIN)/python -m mypy
	$(BIN)/python -m snakemake --lint

# the time integration against plainer ways to write it
bench: $(VENV)/.ready
	$(BIN)/python -m snakemake results/Ref/contact_pressure_edge.npz --cores $(CORES) $(if $(FIDELITY),--config fidelity=$(FIDELITY))
	$(BIN)/python benchmarks/integration_speed.py $(BENCH)

# tables and pictures of README and docs/ that are older than what makes them: lists them with their minutes and makes them again, which
# may take hours; LIST=yes only lists, ONLY='growth.png accuracy.md' makes these, TAKEN=yes takes results that were just made by hand, SAME=yes renews
# the hashes alone, where code was rearranged and the results are the same
claims: $(VENV)/.ready
	PYTHONPATH=benchmarks $(BIN)/python -m claims $(ONLY) --cores $(CORES) $(if $(LIST),--list) $(if $(TAKEN),--taken) $(if $(SAME),--same)

# the numbers that stand for the engine in the hashes of the claims, after a change of them
fingerprint: $(VENV)/.ready
	PYTHONPATH=benchmarks $(BIN)/python -m claims.numbers

# the documentation as a site that opens from the disk: site/index.html; a warning is an error
site: $(VENV)/.docs
	$(BIN)/python -m sphinx --quiet --fail-on-warning --keep-going --conf-dir docs/site docs site

# docs/tutorial.ipynb of docs/tutorial.py, run; about a minute
tutorial: $(VENV)/.docs
	$(BIN)/python benchmarks/tutorial.py

$(VENV)/.docs: $(VENV)/.ready
	$(PIP_INSTALL) --editable '.[docs]'
	@touch $@

setup: $(VENV)/.ready

$(VENV)/.ready: pyproject.toml $(LOCK) envs/system_libraries.sh
	@'$(PYTHON)' -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "r37 needs Python 3.11 or newer; say which with: make PYTHON=/path/to/python3.11 ..." >&2; exit 1; }
	@'$(PYTHON)' -m venv $(VENV) || \
		{ echo "the venv module is missing; on Debian: apt-get install python3-venv" >&2; exit 1; }
	$(PIP_INSTALL) --editable '.[test]'
	sh envs/system_libraries.sh $(BIN)/python
	@touch $@

# the newest versions that pyproject.toml allows, of all packages that the commands here install, for everyone after
lock:
	'$(PYTHON)' -m venv --clear build/lock
	build/lock/bin/python -m pip install --quiet --disable-pip-version-check '.[test,mutants,docs,ansys,search]'
	{ echo "# written by make lock: what pip installed"; build/lock/bin/python -m pip freeze --exclude r37; } > $(LOCK).new
	mv $(LOCK).new $(LOCK)
	rm -rf build/lock

# what the configuration no longer asks for: lists it; REMOVE=yes removes it
clean: $(VENV)/.ready
	$(BIN)/python -m r37core.console.leftovers $(if $(REMOVE),--remove)

clean-results:
	rm -rf results logs
