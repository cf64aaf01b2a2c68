# Settings, and what every rule shares.
# Snakemake notices a changed parameter only if it is made of plain types: dataclasses are passed as dictionaries, or with a
# hash or repr of theirs beside them.
import hashlib
import json
import sys
from dataclasses import asdict
from functools import cache
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.settings.types import DeploymentMethod

from r37core.config import ConfigError, plain, settings_of_run
from r37core.speeds import exact_text
from r37core.studies.sampling import sample

ROOT = Path(workflow.basedir)
ENVIRONMENT = ROOT / "envs" / "r37.yaml"
SCRIPTS = ROOT / "workflow" / "scripts"
# of rules that start it themselves
PYTHON = "python" if DeploymentMethod.CONDA in workflow.deployment_settings.deployment_method else sys.executable

# read here instead of by a `configfile:`, so that messages have lines and numbers are numbers in every file
try:
    settings = settings_of_run(
        ROOT,
        workflow.config_settings.configfiles,
        workflow.config_settings.config,
        only_given=workflow.config_settings.replace_workflow_config,
    )
except ConfigError as error:
    raise WorkflowError(str(error)) from None


if settings.fidelity_is_chosen:
    measured = settings.fidelity.measured
    logger.info(
        f"fidelity auto: level {settings.fidelity_name}, measured error {100 * measured.error:g}%, "
        f"{measured.cpu_s_per_run:g} CPU s per run"
    )


wildcard_constraints:
    blade="|".join(settings.blades),
    scene="|".join(settings.scenes),
    tip_line="pressure_edge|camber|suction_edge",
    speed=r"[0-9.]+",


def code(*packages):
    """Hash of the modules and scripts a stage uses: as a rule parameter it re-runs the stage when they change."""
    digest = hashlib.sha256()
    for package in packages:
        for folder in (ROOT / "src" / "r37core", SCRIPTS):
            for module in sorted(folder.glob(package)):
                digest.update(module.read_bytes())
    return digest.hexdigest()[:16]


def shape_provenance(wildcards):
    """What a blade's geometry says about its making."""
    return {"blade": wildcards.blade, "input_hash": settings.shape_hash(wildcards.blade)}


@cache
def provenance_of_structure(blade):
    """What a blade's structural results say about their making: once, not for each of thousands of jobs."""
    return {"blade": blade, "fidelity": settings.fidelity_name, "input_hash": settings.structure_hash(blade)}


def structure_provenance(wildcards):
    """What a blade's structural results say about their making."""
    return provenance_of_structure(wildcards.blade)


def contact_model_file(wildcards):
    """What the simulations of a blade and scene start from."""
    return f"results/{wildcards.blade}/contact_{settings.scenes[wildcards.scene].tip_line}.npz"


def speed_files(wildcards):
    """The simulations of one blade and scene, by ascending speed."""
    blade, scene = wildcards.blade, wildcards.scene
    return [f"results/{blade}/{scene}/speed_{exact_text(speed)}.npz" for speed in settings.speeds[blade, scene]]


@cache
def provenance_of_sweep(blade, scene):
    """What the results of one blade and scene say about their making."""
    chosen = settings.scenes[scene]
    return provenance_of_structure(blade) | {
        "scene": scene,
        "scene_parameters": repr(chosen.scene),
        "revolutions": chosen.revolutions,
        "largest_time_step": settings.fidelity.march.time_step_s,
    }


def sweep_provenance(wildcards):
    """What the results of one blade and scene say about their making."""
    return provenance_of_sweep(wildcards.blade, wildcards.scene)


def recovery_file(wildcards):
    """The reduced model, for a scene whose stress is wanted."""
    chosen = settings.scenes[wildcards.scene]
    return {"rom": f"results/{wildcards.blade}/rom_{chosen.tip_line}.nc"} if "stress" in chosen.results else {}


def extreme_speeds(blade, scene):
    """The slowest speed of a sweep, and the fastest one or the basis's, whichever is faster: what limits of the step are for."""
    speeds = settings.speeds[blade, scene]
    return [speeds[0], max(speeds[-1], settings.structure.maximum_speed_rad_s)]


def blade_by_blade(wildcards):
    """Priority of a blade's simulations, above 0 and up to 1: results should be complete one blade after another."""
    blades = list(settings.blades)
    return 1 - blades.index(wildcards.blade) / len(blades)


def kept_of_a_run():
    """How much of a run its file keeps."""
    keys = ("spectrum_highest_order", "signal_revolutions", "wear_angles")
    return {key: getattr(settings.fidelity.march, key) for key in keys}


def task_of_a_run(wildcards):
    """What one simulation does, as JSON text."""
    chosen = settings.scenes[wildcards.scene]
    task = {
        "scene": asdict(chosen.scene),
        "choice": asdict(settings.march_choice(wildcards.scene, float(wildcards.speed))),
        "results": chosen.results,
        "kept": kept_of_a_run(),
        "provenance": sweep_provenance(wildcards),
    }
    return json.dumps(task)


def sample_of_sweep(blade, scene):
    """Some of the speeds of one blade and scene, evenly spread."""
    return sample(settings.speeds[blade, scene], settings.studies.estimate.every)


def scenes_with(kind):
    """Scenes whose results hold this kind of dataset."""
    return [name for name, chosen in settings.scenes.items() if kind == "rms" or kind in chosen.results]


KINDS = [kind for kind in ("rms", "spectrum", "stress", "wear") if scenes_with(kind)]


def runs_with(kind):
    """Pairs of blade and scene that hold this kind of dataset."""
    return [(blade, scene) for blade in settings.blades for scene in scenes_with(kind)]
