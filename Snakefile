# r37: blade shape in; Campbell diagrams, vibration, stress and wear maps out. Reads like a table of contents.
import os
import sys
from importlib.util import find_spec

from snakemake.exceptions import WorkflowError

if find_spec("r37core") is None:
    raise WorkflowError(
        f"r37's package is missing in {sys.executable}: `pip install .` in a clone of r37, or `make setup`"
    )

from r37core.console import failures

failures.end_interruptions_in_one_line()
# one thread per job: Snakemake runs jobs side by side, and results must not depend on the number of cores
for library in ("OPENBLAS", "OMP", "MKL", "NUMBA"):
    os.environ[f"{library}_NUM_THREADS"] = "1"
# figures are files, also where a notebook that started this has named a backend of its own
os.environ.update(MPLBACKEND="Agg")
# pictures of blades need no display: jobs that a server forks have this environment, whatever it has imported before (figures/offscreen.py)
if sys.platform == "linux":
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")


report: "workflow/report/workflow.rst"


include: "workflow/rules/common.smk"
include: "workflow/rules/step.smk"
include: "workflow/rules/structure.smk"
include: "workflow/rules/sweep.smk"
include: "workflow/rules/results.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/extensions.smk"


# what r37.run makes
rule tables:
    input:
        rules.campbell_of_all.output,
        rules.configuration.output,
        rules.summary.output,
        tables(sweep),


rule all_blades:
    default_target: True
    input:
        rules.campbell.input,
        rules.configuration.output,
        rules.summary.output,
        rules.explorer.output,
        paths.filled(targets(sweep)),
