# What the rules of all subjects use.
from evidence.configuration import overlay, settings_of
from evidence.pages import Pages

from r37core.console.executor import PYTHON
from r37core.plans.code import CodeHashes

ROOT = VALIDATION.parent
TABLES = "validation/tables"
BLADES = list(settings_of(ROOT).blades)
pages = Pages(ROOT)
code = CodeHashes(VALIDATION, VALIDATION, packages=("evidence",))


def evidence(function):
    """Parameters of a rule whose step is this function of validation/evidence, as `coriolis.tables`, with the hash of its code."""
    name = f"evidence.{function}"
    return {"step": name, "code": code("step", name)}


def behind_engine(*files, **named):
    """Inputs that are asked for only when the numbers of the engine are known to be the same, or were made again."""

    def inputs(wildcards):
        # of the jobs that are asked for alone
        workflow.dag.forcefiles.update(OUT_OF_DATE)
        checkpoints.engine_numbers.get()
        return {**named, **({"files": list(files)} if files else {})}

    return inputs


def models_of(blade, folder="results"):
    """Models of a blade for runs with stress, by kind."""
    return {kind: f"{folder}/{blade}/{kind}_pressure_edge.npz" for kind in ("contact", "stress")}


def responses(folder, *scenes):
    """Responses of all blades in some scenes of a run."""
    return [f"{folder}/{blade}/{scene}/response.nc" for scene in scenes for blade in BLADES]


# the pattern of the others, never run by itself
rule evidence:
    log:
        "logs/validation/evidence.log",
    conda:
        ROOT / "envs/r37.yaml"
    script:
        "../step.py"
