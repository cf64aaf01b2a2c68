"""Compiled functions for constants that are known when a program is made: numba drops the branches that they rule out.

A module names them in capitals, as any constant. A program takes copies of its functions whose globals have other values:
numba reads a global as a constant, and prunes a branch on one before anything in it is looked at. Without that it compiles
what no scene of a kind has, and LLVM throws it away afterwards.
"""

from collections.abc import Callable, Mapping
from dis import get_instructions
from types import FunctionType
from typing import Any

from .lanes import inlined

_copies = dict[tuple[Any, ...], Any]()


def specialised(function: Any, constants: Mapping[str, int]) -> Any:
    """A compiled function and all that it calls, with `constants` as the globals of these names.

    Choices of constants that agree in those that a function uses share its copy; a function that uses none stays what it is.
    """
    used = _used(function, constants)
    if not used:
        return function
    key = (function, *used.items())
    if key not in _copies:
        python = function.py_func
        called = {name: specialised(other, constants) for name, other in _called(function).items()}
        copy = FunctionType(python.__code__, python.__globals__ | called | used, python.__name__)
        _copies[key] = inlined(copy)
    return _copies[key]


def _used(function: Any, constants: Mapping[str, int]) -> dict[str, int]:
    """Constants that a function, or a function that it calls, names."""
    names = _globals_of(function.py_func)
    for other in _called(function).values():
        names = names | _used(other, constants).keys()
    return {name: value for name, value in constants.items() if name in names}


def _called(function: Any) -> dict[str, Any]:
    python = function.py_func
    named = {name: python.__globals__.get(name) for name in _globals_of(python)}
    return {name: other for name, other in named.items() if hasattr(other, "py_func")}


def _globals_of(python: Callable) -> set[str]:
    return {step.argval for step in get_instructions(python) if step.opname == "LOAD_GLOBAL"}
