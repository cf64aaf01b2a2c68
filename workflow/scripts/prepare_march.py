"""Compile the march and refuse a step that is too long. Input: contact model. Params: scene, choice, speed. Output: stamp."""

from job import run

from r37core.march.choice import MarchChoice
from r37core.march.simulate import March
from r37core.rom.contact_model import read_contact_model


def main(snakemake):
    params = snakemake.params
    march = March(read_contact_model(snakemake.input[0]), params.speed, params.scene, MarchChoice(**params.choice))
    print(f"{params.speed:g} rad/s: highest mode {march.frequencies[-1]:.6g} rad/s, steps of {march.time_step:.6g} s")
    march.compile()


run(snakemake, main)
