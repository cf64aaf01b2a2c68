"""One value of one knob. Inputs: model (rom, contact, cost), campbell. Params: scenes, choices, places, ... Output: netCDF."""

from job import run

from r37core.dataset_file import read_dataset, write_dataset
from r37core.fem.material import Material
from r37core.io import read_json
from r37core.march.choice import MarchChoice
from r37core.results.stress import StressRecovery
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.studies.tradeoff import Place, case_dataset, run_scenes


def main(snakemake):
    params, given = snakemake.params, snakemake.input
    crossing = read_dataset(given.campbell)["crossing_speed"].sel(mode="1B", engine_order=params.engine_order).item()
    places = {name: Place(**place).of(crossing) for name, place in params.places.items()}
    model = read_contact_model(given.contact)
    recovery = StressRecovery(read_reduced_model(given.rom), Material(**params.material))
    choices = {scene: MarchChoice(**choice) for scene, choice in params.choices.items()}
    knob, value = snakemake.wildcards.knob, snakemake.wildcards.value
    runs = run_scenes(knob, value, model, recovery, params.scenes, choices, places)
    cost = read_json(given.cost)
    write_dataset(case_dataset(knob, value, places, runs, cost), snakemake.output[0])


run(snakemake, main)
