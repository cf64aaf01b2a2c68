"""Campbell diagrams: naming, following, crossings, dynamic clearance."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
import xarray as xr

from r37core.base.dataset_file import write_dataset
from r37core.results.campbell import (
    Campbell,
    campbell_dataset,
    campbell_diagram,
    dynamic_clearance,
    gather_blades,
    modal_assurance,
)
from r37core.rom.rotation import BucklingError

PUBLISHED = {7: 806.0, 6: 965.0, 5: 1213.0, 4: 1672.0}


@pytest.fixture(scope="module")
def diagram(model):
    return campbell_diagram(model, np.linspace(0.0, 2000.0, 41), 10)


def test_published_crossings(diagram):
    """On the coarse mesh of the tests already within 0.3% of section 7 of the benchmark."""
    crossings = diagram.crossing_speeds(np.array(list(PUBLISHED)))[0]
    np.testing.assert_allclose(crossings, list(PUBLISHED.values()), rtol=3e-3)


def test_crossings_against_the_exact_eigenproblem(model, diagram):
    """K0 + W^2 K1 = n^2 W^2 M is itself an eigenproblem in 1/W^2: a second formulation."""
    for order in (4, 5, 6, 7, 12):
        matrix = order**2 * model.mass - model.geometric_stiffness
        exact = 1.0 / np.sqrt(la.eigh(matrix, model.stiffness, eigvals_only=True)[::-1][:3])
        ours = diagram.crossing_speeds(np.array([order]))[:3, 0]
        within = exact < 2000.0
        np.testing.assert_allclose(ours[within], exact[within], rtol=1e-8)
        assert np.all(np.isnan(ours[~within]))


def test_modes_are_named_by_shape(model, diagram):
    assert diagram.mode_names[:4] == ("1B", "1T", "2B", "4")
    np.testing.assert_allclose(diagram.frequencies[:3, 0], [839.3, 2510.0, 3033.0], rtol=5e-3)
    assert np.all(diagram.continuity > 0.9)
    shapes = diagram.shapes[:4, 0].T
    np.testing.assert_allclose(modal_assurance(shapes, -3.0 * shapes, model.mass), np.eye(4), atol=1e-9)


def oscillators(model, geometric_stiffness):
    """Six oscillators, of which the rotation stiffens or couples the first two."""
    stiffening = np.zeros((6, 6))
    stiffening[:2, :2] = geometric_stiffness
    stiffness = np.diag([1.0, 4.0, 100.0, 121.0, 144.0, 169.0])
    shapes = {"shape_products": np.eye(3, 6), "shape_norms": np.ones(3)}
    return replace(model, stiffness=stiffness, geometric_stiffness=stiffening, mass=np.eye(6), **shapes)


def test_modes_are_followed_through_a_crossing_and_continuity_is_the_smallest_of_all_steps(model):
    """Two coupled oscillators turn by atan(2 g W^2 / 3) / 2, far in the first step; of two uncoupled ones names stay."""
    followed = campbell_diagram(oscillators(model, [[0.0, 1.0], [1.0, 0.0]]), np.array([0.0, 1.0, 1.1]), 4)
    np.testing.assert_allclose(followed.continuity[:2], np.cos(0.5 * np.arctan(2.0 / 3.0)) ** 2, rtol=1e-9)
    followed = campbell_diagram(oscillators(model, np.diag([5.0, 0.1])), np.linspace(0.0, 2.0, 21), 4)
    speeds = followed.speeds
    np.testing.assert_allclose(2 * np.pi * followed.frequencies[0], np.sqrt(1.0 + 5.0 * speeds**2))
    np.testing.assert_allclose(2 * np.pi * followed.frequencies[1], np.sqrt(4.0 + 0.1 * speeds**2))
    np.testing.assert_allclose(followed.crossing_speeds(np.array([3]))[:2, 0], [0.5, np.sqrt(4.0 / 8.9)], rtol=1e-9)


def test_the_first_of_several_crossings_counts():
    """Squared frequency minus squared speed is a cubic of the squared speed with zeros 2, 6 and 12: a spline's own kind."""
    speeds = np.linspace(0.0, 4.0, 81)
    squares = speeds**2 - 1e-3 * (speeds**2 - 2.0) * (speeds**2 - 6.0) * (speeds**2 - 12.0)
    diagram = Campbell(speeds, ("1B",), np.sqrt(squares)[None] / (2.0 * np.pi), np.zeros((1, 81, 1)), np.ones(1))
    assert diagram.crossing_speeds(np.array([1]))[0, 0] == pytest.approx(np.sqrt(2.0), rel=1e-9)


def test_dynamic_clearance(model, diagram):
    """At zero there is no change; the slope is minus normal over tangential part; far out the arc closes the gap."""
    displacement = np.array([-1e-2, -1e-6, 0.0, 1e-6, 1e-2])
    line = model.tip_lines["pressure_edge"]
    theta = np.arctan2(line.points[0, 1], line.points[0, 0])
    clearance = dynamic_clearance(model, diagram.shapes[:2, 0].T, "pressure_edge", displacement)
    np.testing.assert_array_equal(clearance[:, 2], 0.0)
    alpha = line.cone_angle
    for row, shape in zip(clearance, diagram.shapes[:2, 0], strict=True):
        x, y, z = line.basis[0] @ shape
        radial, tangential = np.cos(theta) * x + np.sin(theta) * y, np.cos(theta) * y - np.sin(theta) * x
        normal = np.cos(alpha) * radial - np.sin(alpha) * z
        assert (row[3] - row[1]) / 2e-6 == pytest.approx(-normal / tangential, rel=1e-5)
        radius = np.hypot(*line.points[0, :2])
        assert row[0] + row[4] == pytest.approx(-np.cos(alpha) * displacement[-1] ** 2 / radius, rel=0.02)


def dataset_of(model, modes=10):
    swing = {"largest_tangential_displacement": 0.01, "tip_line": "pressure_edge"}
    return campbell_dataset(model, speeds=np.linspace(0.0, 2000.0, 21), modes=modes, highest_engine_order=16, **swing)


def test_what_a_diagram_cannot_have_is_refused(model):
    assert dataset_of(model, model.size).sizes["mode"] == model.size
    with pytest.raises(ValueError, match=rf"found {model.size + 1}; allowed: up to {model.size}"):
        dataset_of(model, model.size + 1)
    # no stiffness is left at 1450 rad/s, and less at the speeds after it
    softened = replace(model, geometric_stiffness=-model.stiffness / 1450.0**2)
    with pytest.raises(BucklingError, match=r"no stable position at 1500 rad/s: its stiffness is not positive .* stiffer"):
        dataset_of(softened)


def test_dataset_and_gathering(model, tmp_path):
    dataset = dataset_of(model)
    for blade in ("Ref", "Other"):
        write_dataset(dataset, tmp_path / f"{blade}.nc", {"blade": blade, "fidelity": "draft"})
    together = gather_blades(["Ref", "Other"], [tmp_path / "Ref.nc", tmp_path / "Other.nc"])
    write_dataset(together, tmp_path / "campbell.nc", {"fidelity": "draft"})
    with xr.open_dataset(tmp_path / "campbell.nc") as again:
        assert again["frequency"].dims == ("blade", "mode", "speed")
        assert again["crossing_speed"].dims == ("blade", "mode", "engine_order")
        assert again["dynamic_clearance"].dims == ("blade", "mode", "tangential_displacement")
        assert again["frequency"].attrs["units"] == "Hz"
        assert again.attrs["fidelity"] == "draft"
        assert again["speed_rpm"].sel(speed=2000.0).item() == pytest.approx(2000.0 * 60.0 / (2.0 * np.pi))
        for variable in again.variables.values():
            assert variable.dtype.kind not in "fi" or {"units", "long_name"} <= set(variable.attrs)
        np.testing.assert_array_equal(again["frequency"].sel(blade="Other"), dataset["frequency"])
