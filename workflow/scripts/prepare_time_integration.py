"""Compile the time integration; refuse a step too long. Input: contact model. Params: scene, choice, speed. Output: stamp."""

from job import run

from r37core.rom.contact_model import read_contact_model
from r37core.time_integration.integration_choice import IntegrationChoice
from r37core.time_integration.simulate import Simulation


def main(snakemake):
    params = snakemake.params
    model, choice = read_contact_model(snakemake.input[0]), IntegrationChoice(**params.choice)
    problem = Simulation(model, params.speed, params.scene, choice).problem
    print(f"{params.speed:g} rad/s: highest mode {problem.frequencies[-1]:.6g} rad/s, steps of {problem.time_step:.6g} s")


run(snakemake, main)
