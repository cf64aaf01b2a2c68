"""What every call of r37 has about it: stages are told, a misspelt argument is named. Light: the command imports it."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar, get_args

from .stages import stages

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


def checked_call(call: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """The call, with its stages told, and a TypeError for an unknown keyword argument that says which there are."""
    named = arguments_of(call) or []
    takes_any = not named

    @wraps(call)
    def checked(*arguments: Arguments.args, **keywords: Arguments.kwargs) -> Result:
        for name in () if takes_any else keywords.keys() - set(named):
            from r37core.config.messages import did_you_mean

            raise TypeError(
                f"r37.{call.__name__}: found the argument {name}; allowed: {', '.join(named)}{did_you_mean(name, named)}"
            )
        with stages():
            return call(*arguments, **keywords)

    return checked
