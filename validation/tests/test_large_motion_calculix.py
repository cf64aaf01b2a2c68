"""Arithmetic of large motion against CalculiX, and a small blade in both where CalculiX is installed."""

import shutil

import numpy as np
import pytest
from box_mesh import box_mesh
from evidence.calculix import printed
from evidence.large_motion_calculix import Bent, CalculixBlade, cells, period_of, to_cylindrical

from r37core.base.io import InputFileError
from r37core.fem.material import Material

PRINTED = """
 displacements (vx,vy,vz) for set LEADING and time  0.1000000E+01

         7  0.000000E+00  2.000000E-03  1.000000E-03
"""


def test_printed_displacements_are_turned():
    """A node on the y axis moves outwards by 2 mm; the tangent there is -x."""
    turned = printed(PRINTED) @ to_cylindrical(np.array([0.0, 0.3, 0.1])).T
    np.testing.assert_allclose(turned, [[2e-3, 0.0, 1e-3]], atol=1e-18)


def test_the_larger_difference_of_both_senses_counts():
    pairs = [(Bent(-1.00e-3, 1.01e-2), Bent(-1.01e-3, 1.00e-2)), (Bent(-2.00e-3, 1e-2), Bent(-2.04e-3, 1e-2))]
    assert cells(pairs) == ["-1.000 / -1.010; -2.000 / -2.040", "0.040", "1.0%"]


def test_a_period_is_between_rising_zeros():
    times = np.linspace(0.0, 3.2, 321)
    assert period_of(times, np.sin(2.0 * np.pi * (times - 0.3))) == pytest.approx(1.0, rel=1e-6)


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (apt-get install calculix-ccx)")
def test_a_thin_beam_bends_as_the_linear_one_where_the_force_is_small():
    """By F L^3/(3 EI) along the tangent, and nearly not at all along the radius."""
    mesh = box_mesh(0.2, 0.002, 0.01, (16, 1, 1), origin=(0.3, -0.001, -0.005), element="hexahedron20")
    force, stiffness = 0.01, 3.0 * 200e9 * 0.01 * 0.002**3 / 12.0 / 0.2**3
    load, end = np.zeros_like(mesh.points), mesh.node_set("tip_pressure_edge")
    load[end, 1] = force / len(end)
    tip = CalculixBlade(mesh, Material(200e9, 8000.0, 0.0)).bent(load)
    assert tip.whole == pytest.approx(force / stiffness, rel=5e-3)
    assert abs(tip.radial) < 0.02 * tip.whole


def test_calculix_that_is_missing_is_reported_by_name(monkeypatch):
    monkeypatch.setattr(shutil, "which", lambda program: None)
    with pytest.raises(InputFileError, match="calculix-ccx"):
        CalculixBlade(box_mesh(0.2, 0.002, 0.01, (4, 1, 1)), Material(200e9, 8000.0, 0.0)).run([])
