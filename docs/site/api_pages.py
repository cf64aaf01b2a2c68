"""Pages of the API, docs/api/*.rst: r37 call by call, and one page per package or module of r37core with all modules in it."""

import re
from pathlib import Path

CORE = Path(__file__).parent.parent.parent / "src" / "r37core"

INSIDE = "above, check, document, family, with_results"
"""Members of the classes of r37 that its own calls alone use."""


def modules(package):
    """Dotted names of a module, or of a package and all that is in it."""
    files = sorted((CORE / package).rglob("*.py")) if (CORE / package).is_dir() else [CORE / f"{package}.py"]
    names = (".".join(file.relative_to(CORE.parent).with_suffix("").parts).removesuffix(".__init__") for file in files)
    return sorted(name for name in names if "._" not in name)


def packages():
    """Names of the packages and modules of r37core."""
    found = (path.stem for path in CORE.iterdir() if (path / "__init__.py").exists() or path.suffix == ".py")
    return sorted(name for name in found if not name.startswith("_"))


def heading(text, underline):
    """A heading, its underscores no links."""
    text = text.replace("_", "\\_")
    return f"{text}\n{underline * len(text)}\n"


def described(module, *options):
    """What autodoc makes of a module."""
    return "\n".join([f".. automodule:: {module}", "   :members:", *(f"   :{option}:" for option in options), ""])


def calls_page():
    """What `import r37` gives: each call under a heading of its own, which the side bar and the search show."""
    import r37

    objects = {name: getattr(r37, name) for name in r37.__all__ if callable(getattr(r37, name))}
    classes = [name for name, value in objects.items() if isinstance(value, type)]
    parts = [heading("r37", "="), ".. automodule:: r37", ""]
    for name in (*(name for name in objects if name not in classes), *classes):
        made = [f".. autoclass:: r37.{name}", "   :members:", f"   :exclude-members: {INSIDE}"]
        call = [f".. autofunction:: r37.{name}"]
        parts += [heading(f"r37.{name}", "-"), *(made if name in classes else call), ""]
    return "\n".join(parts)


def core_page(package):
    """A package of r37core, module by module; a name stands where it is defined."""
    first, *others = modules(package)
    parts = [heading(first, "="), described(first, "ignore-module-all")]
    for name in others:
        parts += [heading(name, "-"), described(name, "ignore-module-all")]
    return "\n".join(parts)


def write_pages(app):
    """Write the pages that differ from what is there, so that a second build reads only what is new."""
    pages = {"r37": calls_page()}
    pages |= {f"r37core.{name}": core_page(name) for name in packages()}
    folder = Path(app.srcdir) / "api"
    folder.mkdir(exist_ok=True)
    for old in folder.glob("*.rst"):
        if old.stem not in pages:
            old.unlink()
    for name, text in pages.items():
        file = folder / f"{name}.rst"
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")


def as_plain_text(app, what, name, obj, options, lines):
    """Docstrings are plain text with `code`, whatever | * _ mean to docutils; an indented paragraph is shown as it is."""
    paragraphs = re.split(r"\n{2,}", "\n".join(lines))
    lines[:] = [*"\n\n".join(map(shown, paragraphs)).split("\n"), ""]


def shown(paragraph):
    """A paragraph, or a section of a docstring: its underlined title, then terms with what they are, or an example."""
    if paragraph.startswith("    "):
        return f"::\n\n{paragraph}"
    first, _, rest = paragraph.partition("\n")
    underline, _, body = rest.partition("\n")
    if not underline or underline.strip("-"):
        return escaped(paragraph)
    return f"**{first}**\n\n{body if body.startswith('>>>') else escaped(body)}"


def escaped(text):
    """Text without markup but `code`."""
    parts = re.split(r"(`[^`]+`)", text)
    return "".join(part if part.startswith("`") else re.sub(r"[|*_\\]", r"\\\g<0>", part) for part in parts)


def setup(app):
    """Register it with Sphinx."""
    app.connect("builder-inited", write_pages)
    app.connect("autodoc-process-docstring", as_plain_text)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
