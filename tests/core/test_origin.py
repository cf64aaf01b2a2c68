"""What made a result: attributes of joined datasets."""

import subprocess
import sys
import time

import netCDF4
import numpy as np
import pytest

import r37core
from r37core.base.origin import code_hash, date_created, origin


def attributes(file):
    with netCDF4.Dataset(file) as dataset:
        return {name: dataset.getncattr(name) for name in dataset.ncattrs()}


def test_joined_datasets_say_what_made_them(small_sweep):
    results = small_sweep / "results"
    for file in results.glob("*.nc"):
        found = attributes(file)
        assert {"title", "history", "references", "license", "input_hash", "fidelity"} <= found.keys(), file
        assert found["source"].startswith(f"r37 {r37core.__version__}, code {code_hash()}; Python ")
        assert f"numpy {np.__version__}" in found["source"]
        assert found["date_created"] == "2001-09-09T01:46:40+00:00"
        # the bits of what runs and reduces speeds do not change with the day
    for file in results.rglob("response.nc"):
        assert not {"date_created", "source"} & attributes(file).keys()


def test_the_date_is_now_unless_the_environment_has_one(monkeypatch):
    monkeypatch.delenv("SOURCE_DATE_EPOCH")
    made = origin("any")
    assert made["date_created"].startswith(time.strftime("%Y-%m-", time.gmtime()))
    assert made["title"] == "any" and made["history"].startswith(made["date_created"])


@pytest.mark.parametrize("given", ["yesterday", "1e9", "9" * 30])
def test_a_date_of_nonsense_names_its_variable(monkeypatch, given):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", given)
    with pytest.raises(ValueError, match=f"SOURCE_DATE_EPOCH: found '{given}'; allowed: whole seconds since 1970"):
        date_created()


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ("import sys; sys.platform = 'win32'; import r37", "on Windows use WSL, the Windows Subsystem for Linux"),
        (
            "import os; os.environ['XDG_CACHE_HOME'] = '/proc/none'; import snakemake_executor_plugin_warm",
            "XDG_CACHE_HOME: found",
        ),
    ],
)
def test_a_machine_that_cannot_run_it_is_told_in_the_last_line(change, told):
    done = subprocess.run([sys.executable, "-c", change], capture_output=True, text=True, check=False)
    assert done.returncode == 1 and told in done.stderr.splitlines()[-1]
