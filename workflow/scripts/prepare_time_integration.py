"""Compile the time integration; refuse a step too long. Input: contact model. Params: scene, choice, speed. Output: stamp."""

from job import run

from r37core.contact.scene import Scene
from r37core.plain import from_plain
from r37core.rom.contact_model import read_contact_model
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import Simulation


def main(snakemake):
    params = snakemake.params
    scene, choice = from_plain(Scene, params.scene), from_plain(IntegrationChoice, params.choice)
    problem = Simulation(read_contact_model(snakemake.input[0]), params.speed, scene, choice).problem
    print(f"{params.speed:g} rad/s: highest mode {problem.frequencies[-1]:.6g} rad/s, steps of {problem.time_step:.6g} s")


run(snakemake, main)
