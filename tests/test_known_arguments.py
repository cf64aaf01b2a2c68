"""What is known of an argument is used before anything is compiled that it rules out."""

from typing import NamedTuple

import numba
import pytest

from r37core.known_arguments import known
from r37core.lanes import OPTIONS, inlined


class Choice(NamedTuple):
    """Two truth values."""

    wide: bool
    deep: bool


known(Choice)


@inlined
def width(number, choice):
    """Whoever compiles the first branch finds out that a number has no such name."""
    if choice.wide and number > 0.0:
        number = number.of_no_such_name
    return number


@inlined
def doubled(number, twice):
    if twice:
        return 2.0 * number
    return number.of_no_such_name


@inlined
def measured(number, choice):
    if choice.deep:
        number += 100.0
    return width(number, choice)


def program(choice):
    @numba.njit(**OPTIONS)
    def of(number):
        return measured(number, choice) + doubled(number, True)

    return of


def test_what_is_ruled_out_is_not_compiled():
    assert program(Choice(False, False))(1.0) == 3.0
    assert program(Choice(False, True))(1.0) == 103.0
    with pytest.raises(numba.TypingError, match="of_no_such_name"):
        program(Choice(True, False))(1.0)


def test_kinds_share_what_does_not_tell_them_apart():
    """`width` does not use `deep`, `measured` does."""
    for deep in (False, True):
        program(Choice(False, deep))(1.0)
    assert len([one for one in width.signatures if "wide=False" in str(one[1])]) == 1
    assert len([one for one in measured.signatures if "wide=False" in str(one[1])]) == 2
