"""Pages of the API, docs/api/*.rst: r37, and one page per package or module of r37core with all modules in it."""

import re
from pathlib import Path

CORE = Path(__file__).parent.parent.parent / "src" / "r37core"


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


def core_page(package):
    """A package of r37core, module by module; a name stands where it is defined."""
    first, *others = modules(package)
    parts = [heading(first, "="), described(first, "ignore-module-all")]
    for name in others:
        parts += [heading(name, "-"), described(name, "ignore-module-all")]
    return "\n".join(parts)


def write_pages(app):
    """Write the pages that differ from what is there, so that a second build reads only what is new."""
    pages = {"r37": "\n".join([heading("r37", "="), described("r37", "imported-members")])}
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
    text = "\n\n".join(f"::\n\n{part}" if part.startswith("    ") else escaped(part) for part in paragraphs)
    lines[:] = [*text.split("\n"), ""]


def escaped(text):
    """Text without markup but `code`."""
    parts = re.split(r"(`[^`]+`)", text)
    return "".join(part if part.startswith("`") else re.sub(r"[|*_\\]", r"\\\g<0>", part) for part in parts)


def setup(app):
    """Register it with Sphinx."""
    app.connect("builder-inited", write_pages)
    app.connect("autodoc-process-docstring", as_plain_text)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
