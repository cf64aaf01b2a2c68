"""The rules of the main job as a Mermaid diagram, of docs/architecture.md. Run: make claims ONLY=rules."""

import re
import subprocess
import sys
import tempfile

from r37core.io import write_text

from .claim import ROOT, STUDIES


def rule_graph():
    """The diagram, without the rules' way to the final target.

    Drawn where there are no results: edges of rounds that are done are not drawn.
    """
    command = [sys.executable, "-m", "snakemake", "all_blades", "--rulegraph", "mermaid-js"]
    with tempfile.TemporaryDirectory() as empty:
        command += ["--directory", empty]
        text = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    names = dict(re.findall(r"(id\d+)\[(\w+)\]", text))
    edges = sorted((names[start], names[end]) for start, end in re.findall(r"(id\d+) --> (id\d+)", text))
    lines = [f"    {start} --> {end}" for start, end in edges if end != "all_blades"]
    return "\n".join(["```mermaid", "flowchart LR", *lines, "```"])


if __name__ == "__main__":
    write_text(rule_graph() + "\n", ROOT / STUDIES / "rules.md")
