"""Published numbers beside the range of ours under tolerances."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import xarray as xr

from r37core.dataset_file import read_dataset

from ..modelling_choices.report import campbells_of, runs_of
from ..modelling_choices.validation import choice_checks, shipped_checks
from .cases import NOMINAL
from .ranges import judge, range_report


def report(responses: Mapping[str, xr.Dataset], files: Any, values: Mapping[str, Any]) -> dict[str, Any]:
    """The table with its conclusion."""
    shipped = runs_of({name: read_dataset(file) for name, file in zip(values["shipped"], files.shipped, strict=True)})
    published = shipped_checks(read_dataset(files.geometry), campbells_of(files, values), shipped)
    checks = {member: choice_checks(runs) for member, runs in runs_of(responses).items()}
    nominal = checks.pop(NOMINAL)
    return {"table": range_report(judge(published, nominal, list(checks.values())), values["tolerances"])}
