"""Progress of a call: a line for each stage, a bar for many simulations; and the check of its arguments and its docstring.

The lines go to the logger `r37` of the standard library. Where nobody listens to it and a person watches, on a terminal or in a
notebook, they are written there, and bars beside them. `logging.getLogger("r37").setLevel("WARNING")` silences both.
"""

from __future__ import annotations

import inspect
import logging
import re
import sys
import textwrap
import warnings
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar, get_args

from r37core.base.process_wide import ProcessWide

if TYPE_CHECKING:
    from r37core.config import Settings

LOGGER = logging.getLogger("r37")

T = TypeVar("T")


def _watched() -> bool:
    """True where a person sees what is written now, and has not asked for quiet."""
    if LOGGER.level > logging.INFO or sys.stderr is None:
        return False
    return sys.stderr.isatty() or type(sys.stderr).__module__.startswith("ipykernel")


@contextmanager
def _written() -> Iterator[None]:
    taken = LOGGER.isEnabledFor(logging.INFO) and LOGGER.hasHandlers()
    if taken or not _watched():
        yield
        return
    handler, level, propagate = logging.StreamHandler(sys.stderr), LOGGER.level, LOGGER.propagate
    LOGGER.addHandler(handler)
    LOGGER.setLevel(logging.INFO)
    # handlers that others gave the root would write the line once more
    LOGGER.propagate = False
    try:
        yield
    finally:
        LOGGER.removeHandler(handler)
        LOGGER.setLevel(level)
        LOGGER.propagate = propagate


stages = ProcessWide(_written)
"""While `stages()` lasts, lines of the logger are written where a person watches and nobody else takes them."""


def bar(items: Collection[T], what: str, unit: str) -> Iterable[T]:
    """The items one after another, with a bar that says how many are done and how long the others take, where it is watched."""
    return items if len(items) < 2 or not _watched() else _tqdm(items, desc=what, unit=unit)


def job_bar() -> Any:
    """A bar of the jobs of a workflow, of which more become known while it runs, shown where it is watched."""
    return _tqdm(desc="jobs", unit="job", disable=not _watched())


def _tqdm(items: Iterable[Any] | None = None, **more: Any) -> Any:
    with warnings.catch_warnings():
        # a notebook without ipywidgets has a bar of characters, which is as good
        warnings.simplefilter("ignore")
        from tqdm.auto import tqdm
    return tqdm(items, delay=0.5, leave=False, file=sys.stderr, **more)


def simulations_in_words(settings: Settings, blade: str, scene: str, number: str) -> str:
    """The line of a stage that simulates."""
    plural = "" if number == "1" else "s"
    return f"{blade} in {scene}: {number} simulation{plural}, level {settings.fidelity_name}"


Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


def arguments_of(call: Callable[..., object]) -> list[str] | None:
    """Names of what a call takes by name, those of its `**options: Unpack[...]` included; None where it takes any."""
    names: list[str] = []
    for name, parameter in inspect.signature(call).parameters.items():
        if parameter.kind is parameter.VAR_KEYWORD:
            options = get_args(eval(parameter.annotation, call.__globals__))
            if not options:
                return None
            names += options[0].__annotations__
        elif parameter.kind is not parameter.POSITIONAL_ONLY:
            names.append(name)
    return names


def checked_call_of(section: Any) -> Callable[[Callable[Arguments, Result]], Callable[Arguments, Result]]:
    """checked_call of a call that takes keys of a `section` of config.yaml, whose declarations describe them."""
    return lambda call: checked_call(call, section)


def checked_call(call: Callable[Arguments, Result], section: Any = None) -> Callable[Arguments, Result]:
    """The call, with its stages told, a complete docstring, and a TypeError for an unknown keyword argument that lists all."""
    named = arguments_of(call) or []

    @wraps(call)
    def checked(*arguments: Arguments.args, **keywords: Arguments.kwargs) -> Result:
        for name in keywords.keys() - set(named) if named else ():
            from r37core.config.messages import did_you_mean

            allowed = f"{', '.join(named)}{did_you_mean(name, named)}"
            raise TypeError(f"r37.{call.__name__}: found the argument {name}; allowed: {allowed}")
        with stages():
            return call(*arguments, **keywords)

    checked.__doc__ = complete_docstring(call, named or inspect.signature(call).parameters, section)
    return checked


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
