"""Published numbers beside ours. Inputs: geometry, campbell, readings. Params: yield_stress, names. Outputs: tables, figure."""

from job import run

from r37core.dataset_file import read_dataset
from r37core.figures.readings import draw_readings
from r37core.figures.style import save
from r37core.io import write_text
from r37core.studies.validation import CONVERGENCE, lined_checks, rigid_checks, score_table, structure_checks, validation_table


def main(snakemake):
    given, made, params = snakemake.input, snakemake.output, snakemake.params
    lined = {name: read_dataset(file) for name, file in zip(params.lined, given.lined, strict=True)}
    rigid = {name: read_dataset(file) for name, file in zip(params.rigid, given.rigid, strict=True)}
    checks = structure_checks(read_dataset(given.geometry), read_dataset(given.campbell))
    checks += lined_checks(lined["benchmark"], rigid["benchmark"], params.yield_stress)
    checks += rigid_checks(rigid["benchmark"], params.yield_stress)
    variants = {}
    for name in CONVERGENCE:
        ours = lined_checks(lined[name], None, params.yield_stress) if name in lined else []
        ours += rigid_checks(rigid[name], params.yield_stress) if name in rigid else []
        variants[name] = {check.name: check.ours for check in ours}
    write_text(validation_table(checks, variants), made.validation)
    write_text(score_table(lined, rigid, params.yield_stress), made.readings)
    save(draw_readings(lined, rigid), made.figure)


run(snakemake, main)
