"""What made a result: attributes of joined datasets, and the crate of all that lies beside them."""

import hashlib
import json
import time

import netCDF4
import numpy as np
import pytest

import r37core
from r37core.base.io import InputFileError
from r37core.base.origin import code_hash, origin
from r37core.results.crate import METADATA, crate


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


def test_a_crate_lists_tables_and_datasets(small_sweep):
    results = small_sweep / "results"
    graph = {entity["@id"]: entity for entity in json.loads((results / METADATA).read_text())["@graph"]}
    files = {file.name for file in results.iterdir() if file.suffix in (".nc", ".csv")} | {"configuration.json"}
    assert {part["@id"] for part in graph["./"]["hasPart"]} == files
    assert graph[METADATA]["about"] == {"@id": "./"} and graph["./"]["license"]["@id"] in graph
    for name in files:
        assert graph[name]["sha256"] == hashlib.sha256((results / name).read_bytes()).hexdigest()
        assert graph[name]["contentSize"] == str((results / name).stat().st_size)
    assert graph["#run"]["object"]["@id"] == "configuration.json"


def test_a_crate_of_a_file_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(InputFileError, match="rms"):
        crate([tmp_path / "rms.nc"], tmp_path)
