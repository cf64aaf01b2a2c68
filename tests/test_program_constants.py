"""What the constants of a program rule out is not compiled."""

import numba
import pytest

from r37core.machine_code.lanes import OPTIONS, inlined
from r37core.machine_code.program_constants import specialised
from r37core.time_integration.compiled import steps
from r37core.time_integration.compiled.layout import Kind

WIDE = DEEP = False


@inlined
def width(number):
    """Whoever compiles the first branch finds out that a number has no such name."""
    if WIDE and number > 0.0:
        number = number.of_no_such_name
    return number


@inlined
def doubled(number):
    return 2.0 * number


@inlined
def measured(number):
    if DEEP:
        number += 100.0
    return width(number) + doubled(number)


def program(wide, deep):
    inner = specialised(measured, {"WIDE": wide, "DEEP": deep})

    @numba.njit(**OPTIONS)
    def of(number):
        return inner(number)

    return of


def test_what_is_ruled_out_is_not_compiled():
    assert program(False, False)(1.0) == 3.0
    assert program(False, True)(1.0) == 303.0
    # the error names file and line of the source
    with pytest.raises(numba.TypingError, match="of_no_such_name") as refused:
        program(True, False)(1.0)
    assert "test_program_constants.py" in str(refused.value)
    assert "number = number.of_no_such_name" in str(refused.value)


def test_choices_share_what_does_not_tell_them_apart():
    """`width` does not use DEEP, `measured` does, `doubled` none of them."""
    shallow, deep = ({"WIDE": False, "DEEP": value} for value in (False, True))
    assert specialised(width, shallow) is specialised(width, deep)
    assert specialised(measured, shallow) is not specialised(measured, deep)
    assert specialised(measured, shallow) is specialised(measured, dict(shallow))
    assert specialised(doubled, deep) is doubled


def test_the_module_keeps_its_own_values():
    specialised(measured, {"WIDE": False, "DEEP": True})
    assert DEEP is False
    assert measured.py_func.__globals__["DEEP"] is False


def test_the_steps_know_every_constant_of_a_kind_by_its_name():
    """A constant that no function names would tell programs apart that are the same."""
    constants = Kind(True, True, True, False).constants
    for name in constants:
        other = constants | {name: not constants[name]}
        assert specialised(steps.meet, constants) is not specialised(steps.meet, other), name
