"""Published numbers beside ours. Inputs: geometry, campbells, runs. Params: names, yield_stress. Outputs: tables, figures."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.maps import draw_spectral_map
from r37core.figures.style import save
from r37core.io import write_text
from r37core.studies.check import validation_table
from r37core.studies.reading_list import SHIPPED, SURVEY, TURNED
from r37core.studies.reading_table import readings_table
from r37core.studies.readings_figure import draw_readings
from r37core.studies.validation import convergence_checks, shipped_checks
from r37core.studies.validation_figures import draw_blades, draw_histories, draw_reference, draw_stress


def grouped(names, files):
    found = {}
    for (group, name), file in zip(names, files, strict=True):
        found.setdefault(group, {})[name] = read_dataset(file)
    return found


def main(snakemake):
    params, made, limit = snakemake.params, snakemake.output, snakemake.params.yield_stress
    geometry = read_dataset(snakemake.input.geometry)
    runs, campbells = grouped(params.runs, snakemake.input.runs), grouped(params.campbells, snakemake.input.campbells)
    shipped, survey, turned = runs[SHIPPED], runs[SURVEY], {name: runs[name] for name in (SHIPPED, *TURNED)}
    checks = shipped_checks(geometry, campbells, runs, limit)
    write_text(validation_table(checks, convergence_checks(campbells, runs, limit)), made.validation)
    write_text(readings_table(turned, limit), made.readings)
    pictures = {"picture": draw_readings(turned), "reference": draw_reference(survey, shipped), "blades": draw_blades(shipped)}
    pictures |= {"stress": draw_stress(shipped, limit), "histories": draw_histories(shipped, limit)}
    for place in ("Ref_lined", "Ref_direct"):
        pictures[f"spectrum_{place[4:]}"] = draw_spectral_map(survey[place], campbells["Ref"]["level"], place)
    for name, figure in pictures.items():
        save(figure, getattr(made, name))


run(snakemake, main)
