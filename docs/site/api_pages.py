"""Pages of the API, docs/api/*.rst: one for each public name of r37, and one for each folder of the packages below it."""

import inspect
import re
import textwrap
from pathlib import Path

from sphinx.pycode import ModuleAnalyzer
from written_pages import write_folder

SOURCE = Path(__file__).parent.parent.parent / "src"
BELOW = ("r37core", "r37imports", "r37studies")
"""Packages that r37 stands on."""

INSIDE = "above, check, designs, is_family"
"""Members of the classes of r37 that its own calls alone use."""

SECTIONS = {"Args": "Arguments", "Returns": "Returns", "Raises": "Raises", "Examples": "Examples"}
"""Sections of the docstrings of r37, and their titles on the pages."""


def modules(package):
    """Dotted names of a module, or of a package and all that is in it."""
    path = SOURCE.joinpath(*package.split("."))
    files = sorted(path.rglob("*.py")) if path.is_dir() else [path.with_suffix(".py")]
    names = (".".join(file.relative_to(SOURCE).with_suffix("").parts).removesuffix(".__init__") for file in files)
    return sorted(name for name in names if "._" not in name)


def packages():
    """Dotted names of the folders and modules of the packages."""
    found = (path for package in BELOW for path in (SOURCE / package).glob("*"))
    found = (path for path in found if (path / "__init__.py").exists() or path.suffix == ".py")
    return sorted(f"{path.parent.name}.{path.stem}" for path in found if not path.stem.startswith("_"))


def heading(text, underline):
    """A heading, its underscores no links."""
    text = text.replace("_", "\\_")
    return f"{text}\n{underline * len(text)}\n"


def described(module, *options):
    """What autodoc makes of a module."""
    return "\n".join([f".. automodule:: {module}", "   :members:", *(f"   :{option}:" for option in options), ""])


def public_names():
    """Title of a group -> names of r37 in it, with the value of each."""
    import r37

    groups = {"Functions": {}, "Figures": {}, "Classes": {}, "Errors": {}, "Constants": {}}
    for name in r37.__all__:
        value = getattr(r37, name)
        groups[group_of(name, value)][name] = value
    return groups


def group_of(name, value):
    """Title of the group that a public name belongs to."""
    if isinstance(value, type):
        return "Errors" if issubclass(value, Exception) else "Classes"
    if not callable(value):
        return "Constants"
    return "Figures" if name.startswith("plot_") else "Functions"


def constant_docs():
    """Name of a constant of r37 -> the docstring below it, from the module that it is defined in."""
    import r37

    docs = {"__version__": "Version of r37, which every result carries."}
    for module, names in r37._NAMES_OF.items():
        full_name = f"r37{module}" if module.startswith(".") else module
        comments = ModuleAnalyzer.for_module(full_name).find_attr_docs()
        docs |= {name: " ".join(comments["", name]).strip() for name in names if ("", name) in comments}
    return docs


def overview_page():
    """All public names of r37 in tables, with the first sentence of each, and links to their pages."""
    parts = [heading("r37", "="), ".. automodule:: r37", ""]
    constants = constant_docs()
    for title, members in public_names().items():
        rows = []
        for name, value in members.items():
            text = constants[name] if title == "Constants" else inspect.getdoc(value).split("\n\n")[0]
            shown_name = f"`r37.{name}`" if title == "Constants" else f":doc:`{name} <r37.{name}>`"
            rows += [f"   * - {shown_name}", f"     - {escaped(' '.join(text.split()))}"]
        parts += [heading(title, "-"), ".. list-table::", "   :widths: 25 75", "", *rows, ""]
    return "\n".join([*parts, ".. toctree::", "   :hidden:", "", *(f"   r37.{name}" for name in documented()), ""])


def documented():
    """Public names of r37 with a page of their own, and their values."""
    return {name: value for title, members in public_names().items() if title != "Constants" for name, value in members.items()}


def name_page(name, value):
    """A function, class or error of r37."""
    if isinstance(value, type):
        body = [f".. autoclass:: r37.{name}", "   :members:", "   :inherited-members: dict, Mapping, Exception"]
        body.append(f"   :exclude-members: {INSIDE}")
    else:
        body = [f".. autofunction:: r37.{name}"]
    return "\n".join([heading(f"r37.{name}", "="), *body, ""])


def core_page(package):
    """A folder or module of a package, module by module; a name stands where it is defined."""
    first, *others = modules(package)
    parts = [heading(first, "="), described(first, "ignore-module-all")]
    for name in others:
        parts += [heading(name, "-"), described(name, "ignore-module-all")]
    return "\n".join(parts)


def write_pages(app):
    """Write the pages of all names and packages."""
    pages = {"r37": overview_page()}
    pages |= {f"r37.{name}": name_page(name, value) for name, value in documented().items()}
    pages |= {name: core_page(name) for name in packages()}
    write_folder(Path(app.srcdir) / "api", ".rst", pages)


def as_plain_text(app, what, name, obj, options, lines):
    """Docstrings are plain text with `code`, whatever | * _ mean to docutils; an indented paragraph is shown as it is."""
    paragraphs = re.split(r"\n{2,}", "\n".join(lines))
    lines[:] = [*"\n\n".join(map(shown, paragraphs)).split("\n"), ""]


def shown(paragraph):
    """A paragraph, or a section of a docstring: its title, then terms with what they are, a text, or an example."""
    if paragraph.startswith("    "):
        return f"::\n\n{paragraph}"
    title, _, rest = paragraph.partition(":\n")
    if title not in SECTIONS:
        return escaped(paragraph)
    body = textwrap.dedent(rest)
    if title in ("Args", "Raises"):
        body = re.sub(r"^(\S.*?): ", r"\1\n    ", body, flags=re.MULTILINE)
    return f"**{SECTIONS[title]}**\n\n{body if body.startswith('>>>') else escaped(body)}"


def escaped(text):
    """Text without markup but `code`, which is a link where it is a name of r37."""
    parts = re.split(r"(`[^`]+`)", text)
    return "".join(linked(part) if part.startswith("`") else re.sub(r"[|*_\\]", r"\\\g<0>", part) for part in parts)


def linked(code):
    """Code in a text, as a link to the page of a public name that it is."""
    return f":py:obj:{code}" if re.fullmatch(r"`r37\.\w+`", code) else code


def setup(app):
    """Register it with Sphinx."""
    app.connect("builder-inited", write_pages)
    app.connect("autodoc-process-docstring", as_plain_text)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
