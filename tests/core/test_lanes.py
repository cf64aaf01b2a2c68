"""Formulas on lanes, compiled: what is rounded once, and what the constants of a program rule out."""

from fractions import Fraction

import numba
import numpy as np
import pytest
from integration_cases import FUSED
from numba import types

from r37core.machine_code.alignment import LANES, aligned_record, aligned_zeros
from r37core.machine_code.lanes import OPTIONS, inlined, load, store
from r37core.machine_code.program_constants import specialised
from r37core.time_integration.compiled import program
from r37core.time_integration.compiled.layout import Kind, capacity_of

FORMULAS = {
    "product plus number": (lambda a, b, c, d: a * b + c, lambda a, b, c, d: once(a * b + c)),
    "number plus product": (lambda a, b, c, d: c + a * b, lambda a, b, c, d: once(a * b + c)),
    "product less number": (lambda a, b, c, d: a * b - c, lambda a, b, c, d: once(a * b - c)),
    "number less product": (lambda a, b, c, d: c - a * b, lambda a, b, c, d: once(c - a * b)),
    "of two products the first": (lambda a, b, c, d: a * b + c * d, lambda a, b, c, d: once(a * b + once(c * d))),
    "of their difference, too": (lambda a, b, c, d: a * b - c * d, lambda a, b, c, d: once(a * b - once(c * d))),
    "sum of numbers": (lambda a, b, c, d: a + c - d, lambda a, b, c, d: once(once(a + c) - d)),
    "negative": (lambda a, b, c, d: -a, lambda a, b, c, d: -a),
}


def once(value):
    """An exact value rounded to a double."""
    return Fraction(float(value))


@pytest.mark.skipif(not FUSED, reason="this processor rounds a product and a sum one after the other")
@pytest.mark.parametrize("name", FORMULAS)
def test_a_product_and_its_sum_are_rounded_once(name):
    """Against exact fractions."""
    formula, rounded = FORMULAS[name]
    compiled, kind = inlined(formula), aligned_record([("given", np.float64, (4, LANES)), ("answer", np.float64, (1, LANES))])

    @numba.njit(types.void(numba.from_dtype(kind)[::1]), **OPTIONS)
    def answer(records):
        m = records[0]
        a, b, c, d = load(m.given, (0, 0)), load(m.given, (1, 0)), load(m.given, (2, 0)), load(m.given, (3, 0))
        store(m.answer, (0, 0), compiled(a, b, c, d))

    records = aligned_zeros((1,), kind)
    records["given"] = np.random.default_rng(1).standard_normal((1, 4, LANES))
    # what is left of a difference is all rounding
    records["given"][0, 2, ::2] = records["given"][0, 0, ::2] * records["given"][0, 1, ::2]
    answer(records)
    exact = [[Fraction(float(number)) for number in row] for row in records[0]["given"].T]
    assert records[0]["answer"][0].tolist() == [float(rounded(*numbers)) for numbers in exact]


@pytest.mark.slow
def test_a_program_leaves_no_rounding_to_the_compiler(monkeypatch):
    """No sum of it may be reordered or contracted, no quotient be made a product."""
    monkeypatch.setattr(program, "object_code", lambda assembly, *_: assembly)
    plain = Kind(published=False, exact_gap=False)
    words = program.compile_integration(capacity_of(1, 1), plain).split()
    assert words.count("fadd") > 10 and any(word.startswith("@llvm.fmuladd.v8f64") for word in words)
    assert not {"fast", "reassoc", "contract", "arcp", "afn", "nnan", "ninf", "nsz"}.intersection(words)


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


def compiled_for(wide, deep):
    inner = specialised(measured, {"WIDE": wide, "DEEP": deep})

    @numba.njit(**OPTIONS)
    def of(number):
        return inner(number)

    return of


def test_what_is_ruled_out_is_not_compiled_and_the_module_keeps_its_own_values():
    assert compiled_for(False, False)(1.0) == 3.0
    assert compiled_for(False, True)(1.0) == 303.0
    # the error names file and line of the source
    with pytest.raises(numba.TypingError, match="of_no_such_name") as refused:
        compiled_for(True, False)(1.0)
    assert "test_lanes.py" in str(refused.value)
    assert "number = number.of_no_such_name" in str(refused.value)
    specialised(measured, {"WIDE": False, "DEEP": True})
    assert DEEP is False
    assert measured.py_func.__globals__["DEEP"] is False


def test_choices_share_what_does_not_tell_them_apart():
    """`width` does not use DEEP, `measured` does, `doubled` none of them."""
    shallow, deep = ({"WIDE": False, "DEEP": value} for value in (False, True))
    assert specialised(width, shallow) is specialised(width, deep)
    assert specialised(measured, shallow) is not specialised(measured, deep)
    assert specialised(measured, shallow) is specialised(measured, dict(shallow))
    assert specialised(doubled, deep) is doubled


def test_the_steps_know_every_constant_of_a_kind_by_its_name():
    """A constant that no function names would tell programs apart that are the same."""
    constants = Kind(published=True, exact_gap=True).constants
    for name in constants:
        other = constants | {name: not constants[name]}
        assert specialised(program._integrate, constants) is not specialised(program._integrate, other), name
