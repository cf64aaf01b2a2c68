"""One value of one parameter. Inputs: model (rom, contact, cost), campbell. Params: scenes, choices, ... Output: netCDF."""

from job import run

from r37core.dataset_file import read_dataset, write_dataset
from r37core.fem.material import Material
from r37core.io import read_json
from r37core.results.stress_recovery import StressRecovery
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.studies.tradeoff import Place, case_dataset, run_scenes
from r37core.time_integration.integration_choice import IntegrationChoice


def main(snakemake):
    params, given = snakemake.params, snakemake.input
    crossing = read_dataset(given.campbell)["crossing_speed"].sel(mode="1B", engine_order=params.engine_order).item()
    places = {name: Place(**place).of(crossing) for name, place in params.places.items()}
    model = read_contact_model(given.contact)
    recovery = StressRecovery(read_reduced_model(given.rom), Material(**params.material))
    choices = {scene: IntegrationChoice(**choice) for scene, choice in params.choices.items()}
    parameter, value = snakemake.wildcards.parameter, snakemake.wildcards.value
    runs = run_scenes(parameter, value, model, recovery, params.scenes, choices, places)
    cost = read_json(given.cost)
    write_dataset(case_dataset(parameter, value, places, runs, cost), snakemake.output[0])


run(snakemake, main)
