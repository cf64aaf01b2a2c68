"""Texts that docstrings of calls have in common: each is written here once, and stands in the docstring of every call."""

import inspect
import re
import textwrap
from collections.abc import Callable, Iterable
from typing import Any, get_args

_NAMES = "Names, or the results of `r37.{}`; changed ones need a `name`."

_DESCRIPTIONS = {
    "blade": "A name, or the result of `r37.blade`.",
    "scene": "A name, or the result of `r37.scene`.",
    "blades": _NAMES.format("blade"),
    "scenes": _NAMES.format("scene"),
    "speeds": 'Angular speeds (rad/s), or ranges `{"start": 750, "stop": 2000, "step": 20}`. With `"refine_to": 1` the range '
    "is sampled adaptively, down to intervals of that length.",
    "speed_rpm": "The same in revolutions per minute, in place of `speed`.",
    "speeds_rpm": "The same in revolutions per minute, in place of `speeds`.",
    "fidelity": "An accuracy level in place of the configuration's.",
    "results": 'Results to compute, in place of the scenes\' lists: `["stress", "wear"]`.',
    "config": "A config.yaml in place of the shipped one. It gives names, structure and levels.",
    "cores": "Number of jobs that run at once. The numbers do not depend on it.",
    "folder": "Folder of the run's files: new, empty, or of an earlier call, which continues. `snakemake` in that folder runs "
    "the same. By default the files are temporary: they are deleted with the returned object.",
    "file": "A blades.yaml or scenes.yaml in place of the configuration's.",
    "title": "Title in place of the names that the figure has by default.",
}

_FIGURE = "Returns:\n    A figure of Matplotlib, to be shown, changed or saved."

_ERRORS = """Raises:
    ConfigError: For bad input.
    ValueError: For an impossible shape, mesh, model or time step.
    BucklingError: For a blade that its load buckles."""

_SECTION = re.compile(r"\n\n(?=(?:Args|Returns|Raises|Examples):\n)")


def complete_docstring(call: Callable[..., object], arguments: Iterable[str], section: Any = None) -> str:
    """Docstring of a call, with descriptions of all its arguments in their order, and with the sections Returns and Raises.

    Where its own docstring leaves one out, these are the descriptions above or those of the keys of a `section` of
    config.yaml, a figure, and the usual errors.
    """
    if call.__doc__ is None:
        # python -OO
        return ""
    purpose, *sections = _SECTION.split(inspect.cleandoc(call.__doc__))
    own = {section.partition(":")[0]: section for section in sections}
    entries = re.split(r"\n(?=    \S)", own.get("Args", ""))[1:]
    described = {name: entry for entry in entries for name in re.findall(r"\w+", entry.partition(":")[0])}
    # keys of a section, with their declared descriptions and defaults, and the keys of sections in them
    keys = {} if section is None else {name: _key_description(field) for name, field in section.model_fields.items()}
    texts = {**keys, **_DESCRIPTIONS}
    own["Args"] = "\n".join(["Args:", *dict.fromkeys(described.get(name) or _entry(name, texts[name]) for name in arguments)])
    usual = {"Returns": _FIGURE, "Raises": _ERRORS}
    return "\n\n".join([purpose, *(own.get(title) or usual[title] for title in ("Args", "Returns", "Raises", "Examples"))])


def _key_description(field: Any) -> str:
    inside = _keys_inside(field.annotation)
    default = f" (default {field.default!r})" if isinstance(field.default, int | float | str) else ""
    return f"{field.description}{default}{'; keys: ' if inside else ''}{', '.join(inside)}."


def _keys_inside(kind: Any) -> list[str]:
    """Keys of the sections that a value of this type is or holds."""
    if hasattr(kind, "model_fields"):
        return [*kind.model_fields]
    return [key for part in get_args(kind) for key in _keys_inside(part)]


def _entry(name: str, description: str) -> str:
    text, indent = f"{name}: {description}", 4 * " "
    return textwrap.fill(text, 120, initial_indent=indent, subsequent_indent=2 * indent, break_long_words=False)
