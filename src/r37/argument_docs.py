"""Descriptions of arguments that several calls take: each is written here once, and stands in the docstring of each call."""

import inspect
import re
import textwrap
from collections.abc import Callable, Iterable

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


def complete_docstring(call: Callable[..., object], arguments: Iterable[str]) -> str:
    """Docstring of a call whose section `Args` describes all of its arguments, in their order; its own descriptions count."""
    sections = inspect.cleandoc(call.__doc__ or "").split("\n\n")
    place = next(number for number, section in enumerate(sections) if section.startswith(("Args:\n", "Returns:\n")))
    own = re.split(r"\n(?=    \S)", sections.pop(place))[1:] if sections[place].startswith("Args:") else []
    described = {name: entry for entry in own for name in re.findall(r"\w+", entry.partition(":")[0])}
    entries = dict.fromkeys(described.get(name) or _entry(name) for name in arguments)
    sections.insert(place, "\n".join(["Args:", *entries]))
    return "\n\n".join(sections)


def _entry(name: str) -> str:
    text, indent = f"{name}: {_DESCRIPTIONS[name]}", 4 * " "
    return textwrap.fill(text, 120, initial_indent=indent, subsequent_indent=2 * indent, break_long_words=False)
