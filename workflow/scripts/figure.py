"""Draw a figure. Inputs: named as its function takes them. Params: draw, caption, other arguments. Output: png, pdf."""

from importlib import import_module

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.style import save
from r37core.results.table_file import read_table


def read(file, wildcards):
    """A table, or the part of a dataset that is of the figure's blade and scene."""
    if file.endswith(".csv"):
        return read_table(file)
    return read_dataset(file, {name: wildcards[name] for name in ("blade", "scene") if name in wildcards})


def main(snakemake):
    wildcards, arguments = dict(snakemake.wildcards.items()), dict(snakemake.params.items())
    draw, caption, _ = (arguments.pop(name) for name in ("draw", "caption", "code"))
    arguments |= {name: read(file, wildcards) for name, file in snakemake.input.items()}
    named = [wildcards[name] for name in ("family", "blade", "scene") if name in wildcards]
    if named:
        arguments["title"] = ", ".join(named)
    module, _, function = draw.rpartition(".")
    figure = getattr(import_module(f"r37core.{module}"), function)(**arguments)
    save(figure, snakemake.output, caption)


run(snakemake, main)
