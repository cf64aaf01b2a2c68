"""Profiles against the numbers printed in the benchmark."""

from dataclasses import replace

import numpy as np
import pytest

from r37core.blade.profile import PRESSURE, SUCTION, BladeShapeError, Profile

PRINTED_RATES = {  # 1/cm: suction inlet, suction outlet, pressure inlet, pressure outlet
    0: (-0.0844, -0.1996, -0.0021, -0.1012),
    50: (-0.0332, -0.1386, 0.0091, -0.0508),
    100: (-0.0093, -0.1682, 0.0114, -0.0761),
}
PRINTED_AREAS = {0: 1.8427, 30: 1.4094, 50: 1.1842, 70: 0.9806, 100: 0.7059}  # cm2


def at_span(profiles, percent):
    return next(p for p in profiles if round(100 * p.parameters.span) == percent)


@pytest.mark.parametrize("percent", PRINTED_RATES)
def test_surface_turning_rates(profiles, percent):
    surfaces = at_span(profiles, percent).surfaces
    rates = [path.rate / 100.0 for side in (SUCTION, PRESSURE) for path in (surfaces[side].front, surfaces[side].rear)]
    np.testing.assert_array_equal(np.round(rates, 4), PRINTED_RATES[percent])


@pytest.mark.parametrize("percent", PRINTED_AREAS)
def test_areas(profiles, percent):
    assert round(1e4 * at_span(profiles, percent).area, 4) == PRINTED_AREAS[percent]


@pytest.mark.parametrize("side", [PRESSURE, SUCTION])
def test_surfaces_are_tangent_to_the_edge_circles(profiles, side):
    for profile in profiles:
        for chord, edge in ((0.0, profile.leading_edge), (1.0, profile.trailing_edge)):
            on_surface = profile.surfaces[side].point(chord)
            on_circle = edge.point(float(side))
            np.testing.assert_allclose(on_surface, on_circle, atol=1e-11)
            along, across = profile.cone.unroll(edge.m, edge.theta, *on_surface)
            assert np.hypot(along, across) == pytest.approx(edge.radius, rel=1e-8)


def test_surfaces_are_smooth_at_the_junction(profiles):
    for profile in profiles:
        for surface in profile.surfaces.values():
            assert surface.front.angle(surface.front_length) == pytest.approx(surface.rear.kappa, abs=1e-12)


def test_thickness_is_the_maximum_thickness_where_printed(profiles):
    hub = profiles[0]
    p = hub.parameters
    m_thickest = p.maximum_thickness_axial / np.cos(hub.cone.half_angle)
    rear = hub.centreline.rear
    s = rear.length_to(m_thickest)
    m, theta = rear.point(s)
    for side in (PRESSURE, SUCTION):
        wall = hub.surfaces[side].point(np.linspace(0.0, 1.0, 20001))
        along, across = hub.cone.unroll(m, theta, *wall)
        assert np.min(np.hypot(along, across)) == pytest.approx(p.maximum_thickness / 2.0, rel=1e-4)


def test_edge_arcs_pass_the_nose(profiles):
    for profile in profiles:
        assert profile.leading_edge.point(0.0)[0] < 0.0
        end = profile.parameters.outlet_axial / np.cos(profile.cone.half_angle)
        assert profile.trailing_edge.point(0.0)[0] > end


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("maximum_thickness", -0.001, ".*maximum_thickness"),
        ("inlet_thickness", 0.0, ".*inlet_thickness"),
        ("inlet_angle", np.radians(95.0), ".*inlet_angle"),
        ("transition_axial", 0.06, ".*transition_axial"),
        ("outlet_radius", 0.0, ".*outlet_radius"),
        # surfaces that cannot close
        ("maximum_thickness", 0.04, ": (no|the) (suction|pressure)"),
        ("inlet_angle", np.radians(89.0), ": (no|the) (suction|pressure)"),
        ("outlet_angle", np.radians(-89.0), ": (no|the) (suction|pressure)"),
        ("maximum_thickness_axial", 0.0003, ": (no|the) (suction|pressure)"),
    ],
)
def test_impossible_profiles_are_refused_with_the_span(profiles, name, value, message):
    with pytest.raises(BladeShapeError, match=f"span 50%{message}"):
        Profile(replace(at_span(profiles, 50).parameters, **{name: value}))
