"""One page to look at all results. Inputs: datasets, summary, ranking and, if there, tolerances. Output: HTML.

Params: title, shapes, benchmark_scenes.
"""

from pathlib import Path

from job import run

from r37core.dataset_file import read_dataset
from r37core.explorer import write_page
from r37core.explorer.contents import explorer_contents
from r37core.results.ranking import read_ranking
from r37core.results.table_file import read_table


def main(snakemake):
    files = dict(snakemake.input.items())
    interactions, ranking = read_table(files.pop("summary")), read_ranking(files.pop("ranking"))
    datasets = {kind: read_dataset(file) for kind, file in files.items()}
    params, file = snakemake.params, Path(snakemake.output[0])
    in_report = {blade: str(snakemake.report_href(file.parent / f"shapes/{blade}.html")) for blade, _ in params.shapes}
    contents = explorer_contents(datasets, interactions, params.shapes, in_report, params.benchmark_scenes, ranking)
    write_page(contents, params.title, file)


run(snakemake, main)
