"""Compile the march for every scene, into numba's cache. Params: scenes. Output: a stamp."""

from job import run

from r37core.march.warm import warm_kernel


def main(snakemake):
    for scene, results in snakemake.params.scenes:
        warm_kernel(scene, stress="stress" in results, energy="energy" in results)


run(snakemake, main)
