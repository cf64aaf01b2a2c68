"""Steps of the workflow (docs/architecture.md): the page to look at all results."""

from inspect import signature
from pathlib import Path
from typing import Any

from r37core.base.io import function_named
from r37core.base.plain import from_plain
from r37core.results.datasets import FURTHER_RUNS, with_further_runs
from r37core.results.operating_range import OperatingRange
from r37core.results.regions import read_judged
from r37core.results.table_file import read_table

from . import page_parts, write_page
from .contents import explorer_contents


def explorer(input: Any, output: Any, params: Any) -> None:
    """One page to look at all results. Inputs: datasets by kind, further runs if there, tables of panels. Output: page.

    Params: title, links (tables and figures), operating (the range, or None); panels: extension -> function that gives
    what its panels show of the tables of all, by the names of their files; programs: files that draw them.
    """
    files = dict(input.items())
    tables = {Path(file).stem: read_table(file) for file in (files.pop(name) for name in params.panels)}
    functions = {name: function_named(function) for name, function in params.panels.items()}
    panels = {
        name: function(**{each: tables[each] for each in signature(function).parameters if each in tables})
        for name, function in functions.items()
    }
    datasets = {kind: read_judged(file) for kind, file in files.items()}
    further = datasets.pop(FURTHER_RUNS, None)
    # maps of wear and casing have no speeds of their own
    datasets |= {
        kind: with_further_runs(kind, datasets[kind], further) for kind in ("rms", "stress", "fatigue") if kind in files
    }
    operating = params.operating and from_plain(OperatingRange, params.operating)
    contents = explorer_contents(datasets, operating) | {"panels": panels, "links": params.links}
    write_page(contents, params.title, output.page, page_parts(params.programs))
