# Whole rotors: what the simulations of a scene with a rotor have of every blade.
from r37studies.rotors import plan as rotors_plan


use rule step as rotor_of_run with:
    input:
        speeds=sweep.speed_files,
    output:
        rotor=rotors_plan.ROTOR_OF_RUN,
    log:
        "<logs>/{blade}/{scene}/rotor.log",
    params:
        **step("r37studies.rotors.steps.rotor_of_run"),
        speeds=sweep.speeds,
        yield_stress=sweep.yield_stress,
        provenance=sweep.provenance,


use rule step as rotors_dataset with:
    input:
        rotors=paths.filled({rotors_plan.ROTOR_OF_RUN: paths.run_keys(rotors_plan.rotor_runs(sweep))}),
    output:
        dataset=rotors_plan.DATASET,
        table=shown(rotors_plan.TABLE, SOURCE / "r37studies/rotors/report.rst", TOGETHER, "whole rotors"),
    log:
        "<logs>/rotors_dataset.log",
    params:
        **step("r37studies.rotors.steps.join"),
        runs=rotors_plan.rotor_runs(sweep),
        fidelity=settings.fidelity_name,
