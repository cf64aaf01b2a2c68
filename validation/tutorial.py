"""Runs docs/tutorial.py as a notebook and writes docs/tutorial.ipynb, with its results. Run: make tutorial."""

from pathlib import Path

import jupytext
import nbformat
from nbclient import NotebookClient

FOLDER = Path(__file__).parents[1] / "docs"


def executed():
    """The notebook with the output of every cell; an error in one ends it."""
    notebook = jupytext.read(FOLDER / "tutorial.py")
    client = NotebookClient(notebook, timeout=1200, kernel_name="python3", resources={"metadata": {"path": str(FOLDER)}})
    client.execute()
    for number, cell in enumerate(notebook.cells):
        # when cells ran, and names made up anew each time, say nothing
        cell.metadata.pop("execution", None)
        cell.id = f"cell-{number}"
        # nor does what calls say while they work, which depends on what is kept
        if cell.cell_type == "code":
            cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
    return notebook


if __name__ == "__main__":
    nbformat.write(executed(), FOLDER / "tutorial.ipynb")
