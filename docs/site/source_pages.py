"""Source of the API, one plain page for each module, and links to the lines: a tenth of what sphinx.ext.viewcode writes."""

import inspect
from html import escape
from pathlib import Path

from api_pages import BELOW
from sphinx.pycode import ModuleAnalyzer

HEAD = '<!doctype html><meta charset="utf-8"><meta name="color-scheme" content="light dark"><title>{}</title><pre>'


def linkcode_resolve(domain, info):
    """Address of the line where a name of the API is defined, from its page; nothing for a constant."""
    import r37

    module, name = info["module"], info["fullname"]
    if module == "r37" and name:
        first, *members = name.split(".")
        value = inspect.unwrap(getattr(r37, first))
        module, name = getattr(value, "__module__", module), ".".join([getattr(value, "__qualname__", first), *members])
    tags = ModuleAnalyzer.for_module(module).find_tags()
    return f"../source/{module}.html#{tags[name][1]}" if name in tags else None


def write_sources(app, exception):
    """A page for each module, with an anchor at each line."""
    root = Path(__file__).parent.parent.parent / "src"
    folder = Path(app.outdir) / "source"
    folder.mkdir(exist_ok=True)
    for file in [*root.glob("r37/*.py"), *(file for package in BELOW for file in root.glob(f"{package}/**/*.py"))]:
        module = ".".join(file.relative_to(root).with_suffix("").parts).removesuffix(".__init__")
        lines = enumerate(escape(file.read_text(encoding="utf-8"), quote=False).split("\n"), 1)
        text = HEAD.format(module) + "\n".join(f"<a id={number}></a>{line}" for number, line in lines)
        (folder / f"{module}.html").write_text(text, encoding="utf-8")


def setup(app):
    """Register it with Sphinx, next to sphinx.ext.linkcode."""
    app.connect("build-finished", write_sources)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
