"""Pages of the site that are made when it is built: the tutorial from its notebook, the API from the packages' docstrings."""

import base64
import re
from pathlib import Path

import nbformat
from mkdocs.structure.files import File

ROOT = Path(__file__).parent.parent.parent


def on_files(files, config):
    """Add the made pages."""
    for name, content in {**tutorial(), **api()}.items():
        files.append(File.generated(config, name, content=content))
    return files


def on_config(config):
    """Put the packages under the API."""
    config.nav.append({"API": ["api/index.md", "api/r37.md", *(f"api/{name}.md" for name in packages())]})
    return config


def on_page_markdown(markdown, page, config, files):
    """Name files that are no page instead of linking them, and make the graph of rules a table, for want of mermaid."""
    markdown = re.sub(r"\[([^\]]+)\]\(\.\./[^)]+\)", r"`\1`", markdown)
    return re.sub(r"```mermaid\nflowchart LR\n(.*?)```", lambda found: table(found[1]), markdown, flags=re.DOTALL)


def table(edges):
    """Edges of a flowchart, one row for all that leave a node."""
    rows = {}
    for one, other in re.findall(r"(\w+) --> (\w+)", edges):
        rows.setdefault(one, []).append(f"`{other}`")
    lines = [f"| `{one}` | {', '.join(others)} |" for one, others in rows.items()]
    return "\n".join(["| rule | its results go to |", "|---|---|", *lines])


def tutorial():
    """The executed notebook as a page, its pictures beside it."""
    notebook = nbformat.read(ROOT / "docs" / "tutorial.ipynb", as_version=4)
    parts, pictures = [], {}
    for number, cell in enumerate(notebook.cells):
        if cell.cell_type == "markdown":
            parts.append(cell.source)
            continue
        parts.append(f"```python\n{cell.source}\n```")
        for output in cell.outputs:
            data = output.get("data", {})
            if "image/png" in data:
                name = f"tutorial_{number}.png"
                pictures[name] = base64.b64decode(data["image/png"])
                parts.append(f"![Figure {number} of the tutorial]({name})")
            elif text := output.get("text") or data.get("text/plain"):
                parts.append(f"```text\n{text.rstrip()}\n```")
    return {"tutorial.md": "\n\n".join(parts), **pictures}


def packages():
    """Names of the packages and modules of r37core."""
    core = ROOT / "src" / "r37core"
    found = (path.stem for path in core.iterdir() if (path / "__init__.py").exists() or path.suffix == ".py")
    return sorted(name for name in found if not name.startswith("_"))


def api():
    """A page of r37, and one per package or module of r37core."""
    pages = {f"api/{name}.md": f"# r37core.{name}\n\n::: r37core.{name}\n" for name in packages()}
    listed = "\n".join(f"- [`r37core.{name}`]({name}.md)" for name in packages())
    text = "A package may import those above it in [the list of layers](../architecture.md#layers), none below it."
    pages["api/r37.md"] = "# r37\n\n::: r37\n    options:\n      show_submodules: false\n"
    listed = f"- [`r37`](r37.md), the [calls from Python](../python.md)\n{listed}"
    return {**pages, "api/index.md": f"# API\n\n{text}\n\n{listed}\n"}
