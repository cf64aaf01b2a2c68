"""Copies of the project whose jobs only touch their outputs, so that what Snakemake plans can be tested in seconds."""

import re

from workflow_runs import copy_project, snakemake

_STUB = """
import sys
from pathlib import Path

for file in snakemake.output if "snakemake" in globals() else sys.argv[3:4]:
    path = Path(file)
    if not path.suffix:  # a folder
        path.mkdir()
        path = path / "content"
    path.write_text(f"made by {Path(__file__).name}")
"""


def copy_stubbed(root, to):
    """A copy with the small sweep of copy_project, its scripts replaced."""
    copy_project(root, to)
    for script in (to / "workflow/scripts").glob("*.py"):
        # the imports stay: they decide what code a job depends on
        imports = [line for line in script.read_text().splitlines() if re.match(r"from r37core\S* import \w+(, \w+)*$", line)]
        lazy = "\n".join(["def _imports():", *(f"    {line}" for line in imports), "    return None"])
        script.write_text(f"{lazy}\n{_STUB}")


def planned_outputs(folder, *arguments):
    """First output of every job that a dry run plans, by rule."""
    text = snakemake(folder, *(arguments or ("all_blades",)), "--cores", "1", "--dry-run")
    found = {}
    for block in re.split(r"\n\[", text):
        rule = re.search(r"^(?:local)?rule (\w+):", block, re.MULTILINE)
        output = re.search(r"^    output: ([^\s,]+)", block, re.MULTILINE)
        if rule and output:
            found.setdefault(rule[1], set()).add(output[1].removeprefix("results/"))
    return found
