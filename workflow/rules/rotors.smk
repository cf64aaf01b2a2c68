# Whole rotors: what the simulations of a scene with a rotor have of every blade.
from r37core.rotors.plan import DATASET, ROTOR_OF_RUN, TABLE, rotor_runs


use rule step as rotor_of_run with:
    input:
        speeds=sweep.speed_files,
    output:
        rotor=ROTOR_OF_RUN,
    log:
        "<logs>/{blade}/{scene}/rotor.log",
    params:
        **step("rotors.steps.rotor_of_run"),
        speeds=sweep.speeds,
        yield_stress=sweep.yield_stress,
        provenance=made.sweep,


use rule step as rotors_dataset with:
    input:
        rotors=paths.filled({ROTOR_OF_RUN: paths.run_keys(rotor_runs(sweep))}),
    output:
        dataset=DATASET,
        table=shown(TABLE, PACKAGE / "rotors/report.rst", TOGETHER, "whole rotors"),
    log:
        "<logs>/rotors_dataset.log",
    params:
        **step("rotors.steps.join"),
        runs=rotor_runs(sweep),
        fidelity=settings.fidelity_name,
