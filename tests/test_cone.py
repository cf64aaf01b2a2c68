"""Geometry on cones against closed forms."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from r37core.blade.cone import Cone, ConstantRatePath

angles = st.floats(-1.2, 1.2)
half_angles = st.one_of(st.just(0.0), st.floats(-0.9, 0.9))


@given(half_angles, angles, st.floats(1e-4, 0.05), st.floats(0.0, 0.04))
def test_offset_and_unroll_are_inverse(half_angle, direction, distance, m):
    cone = Cone(0.2, half_angle)
    along, across = cone.unroll(m, 0.3, *cone.offset(m, 0.3, direction, distance))
    assert along == pytest.approx(distance * np.cos(direction), abs=1e-14)
    assert across == pytest.approx(distance * np.sin(direction), abs=1e-14)


def test_unrolled_distance_is_distance_on_the_flat_sector():
    cone = Cone(0.2, 0.5)
    first, second = (0.01, 0.1), (0.03, 0.25)
    apex = [(cone.radius(m) / np.sin(0.5), theta * np.sin(0.5)) for m, theta in (first, second)]
    flat = [rho * np.exp(1j * phi) for rho, phi in apex]
    assert np.hypot(*cone.unroll(*first, *second)) == pytest.approx(abs(flat[1] - flat[0]), rel=1e-13)


def test_constant_angle_on_a_cylinder_is_a_helix():
    path = ConstantRatePath(Cone(0.2, 0.0), 0.0, 0.0, 0.7, 0.0)
    m, theta = path.point(0.05)
    assert m == pytest.approx(0.05 * np.cos(0.7), rel=1e-14)
    assert theta == pytest.approx(0.05 * np.sin(0.7) / 0.2, rel=1e-14)


def test_constant_rate_on_a_cylinder_is_a_circular_arc():
    rate = 12.0
    path = ConstantRatePath(Cone(0.2, 0.0), 0.0, 0.0, 0.4, rate)
    m, theta = path.point(np.linspace(0.0, 0.05, 7))
    centre = np.array([-np.sin(0.4), np.cos(0.4)]) / rate
    np.testing.assert_allclose(np.hypot(m - centre[0], 0.2 * theta - centre[1]), 1.0 / rate, rtol=1e-13)


@given(half_angles, angles, st.floats(-15.0, 15.0))
def test_path_obeys_its_differential_equations(half_angle, kappa, rate):
    cone = Cone(0.2, half_angle)
    path = ConstantRatePath(cone, 0.003, 0.1, kappa, rate)
    s, step = 0.012, 1e-6
    (m_before, theta_before), (m_after, theta_after) = path.point(s - step), path.point(s + step)
    angle = path.angle(s)
    assert (m_after - m_before) / (2 * step) == pytest.approx(np.cos(angle), abs=1e-7)
    slope = np.sin(angle) / cone.radius(path.meridional(s))
    assert (theta_after - theta_before) / (2 * step) == pytest.approx(slope, abs=1e-6)


def test_path_between_two_angles_ends_where_asked():
    path, length = ConstantRatePath.between(Cone(0.2, 0.3), 0.0, 0.0, 0.9, 0.02, 0.3)
    assert path.meridional(length) == pytest.approx(0.02, rel=1e-14)
    assert path.angle(length) == pytest.approx(0.3, rel=1e-14)
    assert path.length_to(0.02) == pytest.approx(length, rel=1e-12)
