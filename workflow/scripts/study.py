"""Report of a study. Inputs: responses of its cases, and what else it reads. Params: study, cases, values. Outputs: by name."""

from importlib import import_module

import xarray as xr
from job import run

from r37core.dataset_file import read_dataset, write_dataset
from r37core.figures.style import save
from r37core.io import as_list, write_text


def write(content, file):
    if isinstance(content, str):
        write_text(content, file)
    elif isinstance(content, xr.Dataset):
        write_dataset(content, file)
    elif callable(content):
        content(file)
    else:
        save(content, file)


def main(snakemake):
    given, params = snakemake.input, snakemake.params
    responses = {name: read_dataset(file) for name, file in zip(params.cases, as_list(given.cases), strict=True)}
    report = import_module(f"r37core.studies.{params.study}.report").report
    for name, content in report(responses, given, params.values).items():
        write(content, getattr(snakemake.output, name))


run(snakemake, main)
