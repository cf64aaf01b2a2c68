"""Published numbers beside ours. Inputs: geometry, campbells, runs. Params: names, yield_stress. Outputs: tables, figures."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.maps import draw_spectral_map
from r37core.figures.readings import draw_readings
from r37core.figures.style import save
from r37core.figures.validation import draw_blades, draw_histories, draw_reference, draw_stress
from r37core.io import write_text
from r37core.studies.check import validation_table
from r37core.studies.reading_list import CONVERGENCE, SHIPPED, SURVEY, TURNED
from r37core.studies.reading_table import readings_table
from r37core.studies.validation import reading_checks, structure_checks, survey_checks


def grouped(names, files):
    found = {}
    for (group, name), file in zip(names, files, strict=True):
        found.setdefault(group, {})[name] = read_dataset(file)
    return found


def main(snakemake):
    params, given, made = snakemake.params, snakemake.input, snakemake.output
    runs, models = grouped(params.runs, given.runs), grouped(params.campbells, given.campbells)
    level = {blade: meshes["level"] for blade, meshes in models.items() if "level" in meshes}
    shipped, survey = runs[SHIPPED], runs[SURVEY]
    checks = structure_checks(read_dataset(given.geometry), level) + reading_checks(shipped, params.yield_stress)
    checks += survey_checks(survey, shipped, params.yield_stress)
    others = {name: reading_checks(runs[name], params.yield_stress) for name in CONVERGENCE}
    for nodes in params.meshes:
        others[f"mesh_{nodes}"] += structure_checks(None, {"Ref": models["Ref"][str(nodes)]})
    write_text(validation_table(checks, others), made.validation)
    turned = {name: runs[name] for name in (SHIPPED, *TURNED)}
    write_text(readings_table(turned, params.yield_stress), made.readings)
    save(draw_readings(turned), made.picture)
    save(draw_reference(survey, shipped), made.reference)
    save(draw_blades(shipped), made.blades)
    save(draw_stress(shipped, params.yield_stress), made.stress)
    save(draw_histories(shipped, params.yield_stress), made.histories)
    save(draw_spectral_map(survey["Ref_lined"], level["Ref"], "Ref lined"), made.spectrum_lined)
    save(draw_spectral_map(survey["Ref_rigid"], level["Ref"], "Ref rigid"), made.spectrum_rigid)


run(snakemake, main)
