"""Simulate one blade at one speed in one scene. Input: contact model. Params: scene, choice, ... Output: speed_*.npz."""

from job import run

from r37core.march.choice import MarchChoice
from r37core.march.speed_file import write_speed
from r37core.march.speed_run import run_speed
from r37core.rom.contact_model import read_contact_model


def main(snakemake):
    params = snakemake.params
    result = run_speed(
        read_contact_model(snakemake.input.model),
        float(snakemake.wildcards.speed),
        params.scene,
        MarchChoice(**params.choice),
        params.results,
        **params.kept,
    )
    write_speed(result, snakemake.output[0], params.provenance)


run(snakemake, main)
