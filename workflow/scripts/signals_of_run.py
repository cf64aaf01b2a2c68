"""Record signals. Inputs: model, rom, and mesh, whole, campbell, response if needed. Params: speeds, ... Output: signals.nc."""

from job import run

from r37core.contact.scene import Scene
from r37core.dataset_file import read_dataset, write_dataset
from r37core.mesh.mesh_files import read_vtu
from r37core.plain import from_plain
from r37core.results.interactions import InteractionChoice, find_interactions, titles
from r37core.rom.contact_model import read_contact_model
from r37core.rom.rom_file import read_reduced_model
from r37core.signals.dataset import signals_dataset
from r37core.signals.gauges import Gauge, gauge_points, gauge_rows
from r37core.signals.record import record_signals
from r37core.time_integration.integration_choice import IntegrationChoice


def main(snakemake):
    given, params = snakemake.input, snakemake.params
    named, rows, places = {}, [], {}
    if hasattr(given, "response"):
        choice = from_plain(InteractionChoice, params.interactions)
        named = titles(find_interactions(read_dataset(given.response), read_dataset(given.campbell), choice))
    if params.gauges:
        mesh, gauges = read_vtu(given.mesh), from_plain(list[Gauge], list(params.gauges.values()))
        rows = gauge_rows(mesh, read_reduced_model(given.whole).whole_blade.basis, gauges)
        places = dict(zip(params.gauges, gauge_points(mesh, gauges), strict=True))
    model, scene = read_contact_model(given.model), from_plain(Scene, params.scene)
    choice = from_plain(IntegrationChoice, params.choice)
    records = {
        speed: record_signals(model, speed, scene, choice, rows, params.revolutions) for speed in params.speeds or sorted(named)
    }
    tip = read_reduced_model(given.rom).tip_lines[params.tip_line]
    dataset = signals_dataset(records, named, places, params.probes, tip)
    write_dataset(dataset, snakemake.output[0], params.provenance)


run(snakemake, main)
