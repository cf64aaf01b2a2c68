"""Formulas on lanes, compiled: what is rounded once, and that no processor may round otherwise."""

from fractions import Fraction

import numba
import numpy as np
import pytest
from integration_cases import FUSED
from numba import types

from r37core.machine_code.alignment import LANES, aligned_record, aligned_zeros
from r37core.machine_code.lanes import OPTIONS, inlined, load, store
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
    direct = Kind(published=False, lined=False, exact_gap=False, coriolis=False)
    words = program.compile_integration(capacity_of(1, 1), direct).split()
    assert words.count("fadd") > 10 and any(word.startswith("@llvm.fmuladd.v8f64") for word in words)
    assert not {"fast", "reassoc", "contract", "arcp", "afn", "nnan", "ninf", "nsz"}.intersection(words)
