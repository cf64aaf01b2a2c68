"""Blades whose profiles have another stagger, camber, chord or thickness, against the tables that they change."""

from dataclasses import replace
from functools import partial
from operator import attrgetter

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from r37core.blade.profile import Profile
from r37core.blade.section_changes import SectionChange, SpanLaw, changed_profile


def changed(profiles, **change):
    """Profiles, each with the same change."""
    return [Profile(changed_profile(profile.parameters, SectionChange(**change))) for profile in profiles]


def of_each(profiles, number):
    return np.array([number(profile) for profile in profiles])


def stagger(profiles):
    """In degrees, by the profile's centre of area."""
    return np.degrees(of_each(profiles, lambda profile: profile.stagger))


def camber(profiles):
    """Turning of the centreline against the rulings, in degrees."""
    angles = of_each(profiles, lambda profile: (profile.parameters.inlet_angle, profile.parameters.outlet_angle))
    return np.degrees(angles[:, 0] - angles[:, 1])


def chord(profiles):
    """Distance of the centreline's ends on the unrolled cone."""

    def length(profile):
        line = profile.centreline
        return np.hypot(*profile.cone.unroll(0.0, 0.0, *line.rear.point(line.rear_length)))

    return of_each(profiles, length)


centreline = partial(of_each, number=attrgetter("centreline.length"))
area = partial(of_each, number=attrgetter("area"))
half_angle = partial(of_each, number=attrgetter("cone.half_angle"))
thickness = partial(of_each, number=attrgetter(*(f"parameters.{of}_thickness" for of in ("inlet", "maximum", "outlet"))))


@pytest.mark.parametrize("degrees", [2.0, -5.0])
def test_stagger_turns_the_profile_and_keeps_its_shape(profiles, degrees):
    turned = changed(profiles, stagger=np.radians(degrees))
    # Profile.stagger sees the ends from the centre of area, which moves a little beside the chord: measured 0.011 of 2 degrees
    np.testing.assert_allclose(stagger(turned) - stagger(profiles), degrees, rtol=0.0055)
    np.testing.assert_allclose(camber(turned), camber(profiles), atol=1e-10)
    np.testing.assert_allclose(chord(turned), chord(profiles), rtol=1e-9)
    np.testing.assert_allclose(half_angle(turned), half_angle(profiles), atol=1e-12)
    np.testing.assert_array_equal(thickness(turned), thickness(profiles))
    # measured: 1e-4 of the length and 2e-4 of the area for 2 degrees
    np.testing.assert_allclose(centreline(turned), centreline(profiles), rtol=5e-5 * abs(degrees))
    np.testing.assert_allclose(area(turned), area(profiles), rtol=1e-4 * abs(degrees))


def test_camber_turns_more_between_the_same_ends(profiles):
    bent = changed(profiles, camber=np.radians(3.0))
    np.testing.assert_allclose(camber(bent) - camber(profiles), 3.0, atol=1e-10)
    np.testing.assert_allclose(chord(bent), chord(profiles), rtol=1e-9)
    for before, after in zip(profiles, bent, strict=True):
        assert after.parameters.outlet_axial == pytest.approx(before.parameters.outlet_axial, rel=1e-9)
        assert after.parameters.outlet_radius == pytest.approx(before.parameters.outlet_radius, rel=1e-9)
    np.testing.assert_allclose(stagger(bent), stagger(profiles), atol=0.011)
    np.testing.assert_array_equal(thickness(bent), thickness(profiles))


def test_added_camber_is_spread_evenly_over_the_length(profiles):
    hub, bent = profiles[0], changed(profiles, camber=0.1)[0]
    for arc, length in (("front", "front_length"), ("rear", "rear_length")):
        after, before = (getattr(profile.centreline, arc).rate * centreline([profile]) for profile in (bent, hub))
        np.testing.assert_allclose(after - before, -0.1, rtol=1e-9)
        share = getattr(bent.centreline, length) / getattr(hub.centreline, length)
        np.testing.assert_allclose(share, centreline([bent]) / centreline([hub]), rtol=1e-9)


def test_the_place_of_the_maximum_thickness_keeps_its_share_of_the_length(profiles):
    def place(profile):
        line, p = profile.centreline, profile.parameters
        m = p.maximum_thickness_axial / np.cos(profile.cone.half_angle)
        in_front = p.maximum_thickness_axial < p.transition_axial
        return (line.front.length_to(m) if in_front else line.front_length + line.rear.length_to(m)) / line.length

    both = changed(profiles, stagger=-0.1, camber=0.2, chord=1.2)
    np.testing.assert_allclose(of_each(both, place), of_each(profiles, place), rtol=1e-9)


def test_thickness_scales_the_area(profiles):
    thick = changed(profiles, thickness=1.1)
    np.testing.assert_allclose(thickness(thick), 1.1 * thickness(profiles), rtol=1e-12)
    # round edges grow with the square
    np.testing.assert_allclose(area(thick), 1.1 * area(profiles), rtol=5e-4)
    for before, after in zip(profiles, thick, strict=True):
        kept = {name: getattr(before.parameters, name) for name in ("inlet_thickness", "maximum_thickness", "outlet_thickness")}
        assert replace(after.parameters, **kept) == before.parameters


def test_chord_lengthens_the_profile_on_its_cone(profiles):
    long = changed(profiles, chord=1.05)
    np.testing.assert_allclose(chord(long), 1.05 * chord(profiles), rtol=1e-9)
    np.testing.assert_allclose(half_angle(long), half_angle(profiles), atol=1e-12)
    np.testing.assert_allclose(camber(long), camber(profiles), atol=1e-10)
    np.testing.assert_allclose(stagger(long), stagger(profiles), atol=0.009)
    np.testing.assert_array_equal(thickness(long), thickness(profiles))
    for before, after in zip(profiles, long, strict=True):
        for name in ("maximum_thickness_axial", "transition_axial", "outlet_axial"):
            assert getattr(after.parameters, name) == pytest.approx(1.05 * getattr(before.parameters, name), rel=2e-3)


def test_a_change_and_its_opposite_give_the_profile_again(profiles):
    for profile in (each.parameters for each in profiles):
        there = changed_profile(profile, SectionChange(stagger=0.1, camber=-0.05, chord=1.25))
        back = changed_profile(there, SectionChange(stagger=-0.1, camber=0.05, chord=0.8))
        for name, value in vars(profile).items():
            assert getattr(back, name) == pytest.approx(value, rel=1e-8, abs=1e-10)


def test_laws_over_the_span():
    spans = np.array([0.0, 0.3, 0.5, 1.0])
    np.testing.assert_array_equal(SpanLaw.constant(0.7).evaluate(spans), 0.7)
    np.testing.assert_allclose(SpanLaw.linear(1.0, 3.0).evaluate(spans), 1.0 + 2.0 * spans)
    assert SpanLaw.linear(0.0, 2.0).evaluate([0.5]) == [1.0]
    cubic = SpanLaw((0.0, 0.3, 0.5, 1.0), tuple(spans**3))
    np.testing.assert_allclose(cubic.evaluate([0.7]), [0.7**3])
    stations, values = (0.0, 0.2, 0.5, 0.7, 1.0), (0.0, 1.0, 0.0, 1.0, 0.0)
    np.testing.assert_allclose(SpanLaw(stations, values).evaluate(spans), CubicSpline(stations, values)(spans), atol=1e-12)
    np.testing.assert_array_equal(SpanLaw((0.0, 0.3, 1.0), (1.1, 1.1, 1.1)).evaluate(spans), 1.1)


NEUTRAL = """
  stagger_deg: 0
  camber_deg: { hub: 0, tip: 0 }
  chord_percent: [{ span_percent: 0, value: 100 }, { span_percent: 40, value: 100 }, { span_percent: 100, value: 100 }]
  thickness_percent: {}
"""


def shapes(blade):
    return [Profile(parameters) for parameters in blade.definition.profiles]


def test_neutral_values_change_no_bit(with_blades):
    blades = with_blades(f"Same:\n  base: S100{NEUTRAL}").blades
    assert replace(blades["Same"].definition, name="S100") == blades["S100"].definition


def test_an_entry_gives_laws_in_three_forms(with_blades):
    blades = with_blades(
        "Mine:\n  base: S100\n  stagger_deg: { tip: 2 }\n  chord_percent: 105\n  camber_deg: [{ span_percent: 0, value: 0 }, "
        "{ span_percent: 50, value: 1 }, { span_percent: 100, value: 4 }]\n"
    ).blades
    mine, base = shapes(blades["Mine"]), shapes(blades["S100"])
    spans = of_each(base, lambda profile: profile.parameters.span)
    np.testing.assert_allclose(stagger(mine) - stagger(base), 2.0 * spans, atol=0.011)
    np.testing.assert_allclose(camber(mine) - camber(base), 4.0 * spans**2, atol=1e-10)
    np.testing.assert_allclose(chord(mine), 1.05 * chord(base), rtol=1e-9)
    assert blades["Mine"].definition.stacking == blades["S100"].definition.stacking


def test_laws_vary_in_families_and_tables(with_blades):
    table = "blade,stagger_deg.tip,thickness_percent.hub,chord_percent\nA,2,120,100\nB,0,100,90\n"
    blades = with_blades(
        "Turned: { base: Ref, vary: { stagger_deg: [-1, 2] } }\n"
        "Tip: { base: Ref, vary: { stagger_deg.tip: [3], thickness_percent.hub: [110] } }\n"
        "Rows:\n  base: Ref\n  camber_deg: [{ span_percent: 0, value: 0 }, { span_percent: 100, value: 0 }]\n"
        "  vary: { camber_deg.1.value: [2, 4] }\n"
        "Table: { base: Ref, designs: config/designs.csv }\n",
        table,
    ).blades
    base = shapes(blades["Ref"])
    assert stagger(shapes(blades["Turned_2"]))[0] - stagger(base)[0] == pytest.approx(2.0, abs=0.011)
    tip = shapes(blades["Tip_3_110"])
    assert stagger(tip)[-1] - stagger(base)[-1] == pytest.approx(3.0, abs=0.011)
    assert tip[0].parameters.maximum_thickness == pytest.approx(1.1 * base[0].parameters.maximum_thickness)
    assert tip[-1].parameters.maximum_thickness == base[-1].parameters.maximum_thickness
    assert camber(shapes(blades["Rows_4"]))[-1] - camber(base)[-1] == pytest.approx(4.0)
    assert blades["A"].definition.profiles[0].maximum_thickness == 1.2 * base[0].parameters.maximum_thickness
    assert chord(shapes(blades["B"])) == pytest.approx(0.9 * chord(base))
