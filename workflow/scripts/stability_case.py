"""One extreme. Input: model (contact). Params: extreme, scene, choice. Output: JSON."""

from dataclasses import replace

from job import run

from r37core.io import write_json
from r37core.rom.contact_model import read_contact_model
from r37core.studies.stability import REFUSED, judge
from r37core.studies.stability_cases import Extreme
from r37core.time_integration.integration_choice import IntegrationChoice


def main(snakemake):
    params = snakemake.params
    extreme = Extreme(**params.extreme)
    model = read_contact_model(snakemake.input.contact)
    choice = replace(IntegrationChoice(**params.choice), revolutions=extreme.revolutions)
    if extreme.share_of_limit is not None:
        choice = replace(choice, time_step=extreme.share_of_limit * 2.0 / model.modes_at(1.01 * extreme.speed)[0][-1])
    if extreme.integrator is not None:
        choice = replace(choice, integrator=extreme.integrator)
    if params.scene is None:
        outcome = {"outcome": REFUSED, "detail": params.described}
    else:
        outcome = judge(model, params.scene, choice, extreme.speed)
    row = {"what": extreme.what, "value": extreme.value, "scene": extreme.scene} | outcome
    write_json(row, snakemake.output[0])


run(snakemake, main)
