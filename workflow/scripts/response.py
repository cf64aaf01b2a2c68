"""Reduce the speeds of one blade and scene. Inputs: rom, speeds. Params: speeds, stress, material, ... Output: response.nc."""

import math

from job import run

from r37core.fem.material import Material
from r37core.io import as_list
from r37core.plain import from_plain
from r37core.results.response import write_response
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.rom_file import read_reduced_model


def main(snakemake):
    params = snakemake.params
    material = from_plain(Material | None, params.material)
    recovery = StressRecovery(read_reduced_model(snakemake.input.rom), material) if params.stress else None
    write_response(
        as_list(snakemake.input.speeds),
        params.speeds,
        snakemake.output[0],
        recovery,
        stress_history_speeds=params.stress_history_speeds,
        stress_instants=params.stress_instants,
        yield_stress=material.yield_stress if material else math.inf,
        provenance=params.provenance,
    )


run(snakemake, main)
