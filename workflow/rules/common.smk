# Settings of this run, and the plans that the rules take their inputs and parameters from (r37core.plans).
# Snakemake re-runs a job when a parameter of plain types changes; of other objects a hash or text stands beside.
import atexit
import os
import socket
import sys
import time
from pathlib import Path

from snakemake.exceptions import WorkflowError
from snakemake.settings.types import DeploymentMethod

from r37core.config import ConfigError, plain, settings_of_run, si_fields
from r37core.console import failures
from r37core.explorer import parts_hash
from r37core.console import interpreter, lock
from r37core.plans import paths
from r37core.console.closing import closing_lines
from r37core.plans.code import CodeHashes
from r37core.plans.import_plan import Imported
from r37core.console.progress import Progress, quieten
from r37core.plans.provenance import Provenance
from r37core.plans.shape_plan import Shapes
from r37core.figures.reporting import EVERY_SCENE, TOGETHER, captioned, shown
from r37core.plans.structure_plan import Structure
from r37core.plans.resources import Needs
from r37core.plans.run import check_part, replaced_level
from r37core.plans.sweep_plan import Sweep
from r37core.plans.tree import check_tree

BEGAN = time.time()
if workflow.is_main_process:
    failures.begin(f"{socket.gethostname()}_{os.getpid()}")
ROOT = Path(workflow.basedir)
ENVIRONMENT = ROOT / "envs" / "r37.yaml"
SCRIPTS = ROOT / "workflow" / "scripts"
TEXTS = ROOT / "workflow" / "report"
interpreter.quote()

if DeploymentMethod.CONDA in workflow.deployment_settings.deployment_method:
    raise WorkflowError("--sdm conda: jobs need the Python that runs Snakemake, with r37 in it; leave the option out")

# read here instead of by a `configfile:`, so that messages have lines and numbers are numbers in every file
try:
    check_tree(ROOT)
    settings = settings_of_run(
        ROOT,
        workflow.config_settings.configfiles,
        workflow.config_settings.config,
        only_given=workflow.config_settings.replace_workflow_config,
    )
except ConfigError as error:
    raise WorkflowError(str(error)) from None

for line in [*lock.lift_stale(), *settings.remarks, *replaced_level(settings)]:
    logger.info(line)

code = CodeHashes(ROOT / "src", SCRIPTS)
made = Provenance(settings)
structure = Structure(settings)
imported = Imported(settings, ROOT)
sweep = Sweep(settings, lambda **wildcards: checkpoints.refine.get(**wildcards).output[0])
shapes = Shapes(sweep)
needs = Needs(settings, sweep.most_runs)

# thousands of jobs, one line: Snakemake's own messages of each are in its log file, and here with R37_FULL_LOG=1 or --verbose
if not (os.environ.get("R37_FULL_LOG") or workflow.output_settings.dryrun or workflow.output_settings.verbose):
    quieten(logger.handlers, Progress(sweep.most_runs))


pathvars:
    results=str(settings.results),
    logs=str(settings.logs),


onstart:
    # the targets are not known before
    try:
        check_part(settings, workflow.dag_settings.targets)
    except ConfigError as error:
        raise WorkflowError(str(error)) from None
    if workflow.execution_settings.lock:
        lock.claim()
    # Snakemake 9.27 keeps to a number of jobs per second by timers, one more for every job that ends while others wait: a quarter of
    # a core in the default sweep. The limit is for the queues of clusters
    if workflow.local_exec:
        workflow.scheduler.job_rate_limiter = None


onsuccess:
    lock.release()
    # after Snakemake's own last words, and nothing where there is nothing to say
    atexit.register(
        lambda: sys.stderr.writelines(
            f"{line}\n" for line in [*failures.taken(), *closing_lines(settings.results, BEGAN, time.time())]
        )
    )


onerror:
    lock.release()
    # Snakemake has a few words after this; what matters comes last
    atexit.register(lambda: print("", *failures.taken(), sep="\n", file=sys.stderr))


wildcard_constraints:
    blade="|".join(settings.blades),
    scene="|".join(settings.scenes),
    tip_line="pressure_edge|camber|suction_edge",
    speed=r"[0-9.]+",
