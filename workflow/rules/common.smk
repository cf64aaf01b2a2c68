# Settings of this run, and the plans that the rules take their inputs and parameters from (r37core.plans).
# Snakemake re-runs a job when a parameter of plain types changes.
from functools import partial
from pathlib import Path

from snakemake.exceptions import WorkflowError

from r37core.config import contact_of_blades, level_errors, operating_range, plain
from r37core.config.remarks import elastic_casings
from r37core.config.settings import merged_settings
from r37core.console.snakemake_run import begin
from r37core.explorer import parts_hash, page_parts
from r37core.base.plain import to_plain
from r37core.plans import paths
from r37core.plans.code import CodeHashes
from r37core.plans.stages import structure_stages
from r37core.plans.sweep_plan import Sweep
from r37core.product.targets import EVERY_SCENE, TOGETHER, drawing as drawing_of
from r37core.product.targets import (
    added,
    links,
    offered,
    panels,
    simulated,
    tables,
    targets,
)

ROOT = Path(workflow.current_basedir).parent.parent
ENVIRONMENT = ROOT / "envs" / "r37.yaml"
SCRIPTS = ROOT / "workflow" / "scripts"
TEXTS = ROOT / "workflow" / "report"

console = begin(workflow, logger, WorkflowError, ROOT, config)
settings = console.settings
SOURCE = console.source
code = CodeHashes(SOURCE, SCRIPTS)
# parameters of rules: a step, which is a function of a package, and the hash of its code
step = code.step
sweep = Sweep(settings, lambda **wildcards: checkpoints.refine.get(**wildcards).output[0])
more_motions, further_runs = offered("motions", sweep), offered("further_runs", sweep)
run_up_dataset, members = offered("run_ups", sweep), offered("members", sweep)
# speeds in operation, by which results are judged as well
operating = to_plain(operating_range(settings))
drawing = partial(drawing_of, code, operating)
stages = structure_stages(sweep)


def stage(name):
    """Parameters of a step that single calls from Python do, too (r37core.plans.stages). The docstring of the step says what they are."""
    made = next(made for made in stages.values() if made.step == name)
    return {**step(made.step, *made.modules), **made.params}


more_columns = {table: added(table, sweep) for table in ("summary", "ranking")}


def adding(name, table):
    """Parameters of the rule of a step whose table gets columns from extensions."""
    functions = {extension: each.function for extension, each in more_columns[table].items()}
    modules = [function.rpartition(".")[0] for function in functions.values()]
    return {**step(name, *modules), "added": functions}


def shown(file, text, category, figure, subcategory=EVERY_SCENE):
    """An output that stands in the report; `text`: the .rst file of its caption."""
    return report(file, caption=text, category=category, subcategory=subcategory, labels={"figure": figure})


def pictures(name, category, subcategory, figure):
    """Outputs of a figure: the PNG, which stands in the report, and the PDF."""
    png = shown(f"<results>/figures/{name}.png", TEXTS / "figure.rst", category, figure, subcategory)
    return {"png": png, "pdf": f"<results>/figures/{name}.pdf"}


pathvars:
    results=str(settings.results),
    # logs/runs/<name> of a run with a name
    logs=str(Path("logs", *settings.results.parts[1:])),


onstart:
    console.start()


onsuccess:
    console.succeed()


onerror:
    console.fail()


wildcard_constraints:
    blade="|".join(settings.blades),
    scene="|".join(settings.scenes),
    tip_line="pressure_edge|camber|suction_edge",
    speed=r"[0-9.]+",
