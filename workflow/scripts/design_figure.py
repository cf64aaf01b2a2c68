"""Draw one family. Input: designs.csv. Params: blades, varied, caption. Output: png, pdf."""

import pandas as pd
from job import run

from r37core.figures.design_plot import draw_designs
from r37core.figures.style import save


def main(snakemake):
    table = pd.read_csv(snakemake.input[0])
    chosen = table[table["blade"].isin(snakemake.params.blades)]
    save(draw_designs(snakemake.wildcards.family, chosen, snakemake.params.varied), snakemake.output, snakemake.params.caption)


run(snakemake, main)
