"""Compile the march for one scene, into numba's cache. Params: parts. Output: a stamp."""

from job import run

from r37core.march.warm import warm_kernel


def main(snakemake):
    warm_kernel(**snakemake.params.parts)


run(snakemake, main)
