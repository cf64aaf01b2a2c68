"""Copies of the project whose jobs only touch their outputs, so that what Snakemake plans can be tested in seconds."""

import re

from workflow_runs import copy_project, overlay

BLADES, SCENES = ("Ref", "CS100"), ("abradable", "direct")
REFINED = "{ start: 750, stop: 1550, step: 400, refine_to: 0.5 }"

_STUB = """
from pathlib import Path

for file in snakemake.output:
    path = Path(file)
    if not path.suffix:  # a folder
        path.mkdir()
        path = path / "content"
    path.write_text(f"made by {Path(__file__).name}")
"""

# three rounds: the certain speeds, then two more next to 1150, and that is all
_REFINE_STUB = """
import json

if snakemake.params.step == "r37core.adaptive.steps.refine":
    number = int(snakemake.wildcards.round)
    if number:
        before = json.loads(Path(snakemake.input.before).read_text())["new"]
        assert [Path(file).name for file in snakemake.input.speeds] == [f"speed_{speed:g}.npz" for speed in before]
    new = [list(snakemake.params.plan["certain"]), [1149, 1150.5], []][number]
    Path(snakemake.output[0]).write_text(json.dumps({"new": new, "measured": []}))
"""


def copy_stubbed(root, to):
    """A copy with the small sweep of copy_project, its script replaced."""
    copy_project(root, to)
    script = to / "workflow/scripts/step.py"
    # the imports stay: they decide what code a job depends on
    imports = [line for line in script.read_text().splitlines() if re.match(r"from r37core\S* import \w+(, \w+)*$", line)]
    lazy = "\n".join(["def _imports():", *(f"    {line}" for line in imports), "    return None"])
    script.write_text(f"{lazy}\n{_STUB}{_REFINE_STUB}")


def edit(project, name, old, new):
    """Change one place of a configuration file."""
    file = project / "config" / name
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))


def refine(folder, entry=REFINED):
    """Make the speeds of a copy adaptive."""
    overlay(folder, "config.yaml", f"speeds: [{entry}]")


def runs(speeds, blades=BLADES, scenes=SCENES):
    """Files of these simulations, in `results`."""
    return {f"{blade}/{scene}/speed_{speed}.npz" for blade in blades for scene in scenes for speed in speeds}


def simulated(text):
    """Output of every simulation that was started, in order, with repetitions."""
    return re.findall(r"^ +output: results/(\S+/speed_\S+\.npz)", text, re.MULTILINE)
