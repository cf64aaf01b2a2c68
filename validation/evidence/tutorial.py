"""The tutorial as a notebook: docs/tutorial.py, run, with its results."""

from pathlib import Path
from typing import Any

import jupytext
import nbformat
from nbclient import NotebookClient


def executed(program: Path) -> Any:
    """The notebook of a program, with the output of every cell; an error in one ends it."""
    notebook = jupytext.read(program)
    place = {"metadata": {"path": str(program.parent)}}
    client = NotebookClient(notebook, timeout=1200, kernel_name="python3", resources=place)
    client.execute()
    for number, cell in enumerate(notebook.cells):
        # when cells ran, and names made up anew each time, say nothing
        cell.metadata.pop("execution", None)
        cell.id = f"cell-{number}"
        # nor does what calls say while they work, which depends on what is kept
        if cell.cell_type == "code":
            cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
    return notebook


def write(input: Any, output: Any, params: Any) -> None:
    """Run the program. Output: notebook. Params: program."""
    nbformat.write(executed(Path(params.program)), output.notebook)
