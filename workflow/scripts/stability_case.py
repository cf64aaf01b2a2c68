"""One extreme. Input: model (contact). Params: extreme, entry, choice. Output: JSON."""

from dataclasses import replace

from job import run

from r37core.config import ConfigError, checked_scene
from r37core.io import write_json
from r37core.march.choice import MarchChoice
from r37core.rom.contact_model import read_contact_model
from r37core.studies.stability import REFUSED, changed, judge
from r37core.studies.stability_cases import Extreme


def main(snakemake):
    params = snakemake.params
    extreme = Extreme(**params.extreme)
    model = read_contact_model(snakemake.input.contact)
    choice = replace(MarchChoice(**params.choice), revolutions=extreme.revolutions)
    if extreme.share_of_limit is not None:
        choice = replace(choice, time_step=extreme.share_of_limit * 2.0 / model.modes_at(1.01 * extreme.speed)[0][-1])
    if extreme.integrator is not None:
        choice = replace(choice, integrator=extreme.integrator)
    try:
        scene = checked_scene(changed(params.entry, extreme.changes))
        outcome = judge(model, scene, choice, extreme.speed)
    except ConfigError as error:
        outcome = {"outcome": REFUSED, "detail": str(error)}
    row = {"what": extreme.what, "value": extreme.value, "scene": extreme.scene} | outcome
    write_json(row, snakemake.output[0])


run(snakemake, main)
