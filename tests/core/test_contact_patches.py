"""Patches of the tip in place of mesh nodes: weights, closed forms, and models with all nodes of the edge kept."""

import re
from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg as la
import yaml
from box_mesh import box_mesh
from defaults import BoundaryChoice, IntegrationChoice
from integration_cases import ABRADABLE, DIRECT
from integration_runs import ENGINES
from refusal_tables import pattern_of, refusal_rows
from test_refusals import TABLE

from r37core.config import ConfigError, command_line_document
from r37core.config.remarks import (
    remarks_at_end,
    remarks_of_pipeline,
    remarks_on_linear_variants,
    remarks_on_points,
    remarks_on_unlike_contact,
)
from r37core.config.settings import location_of_contact
from r37core.fem.material import Material
from r37core.fem.matrices import assemble
from r37core.fem.traces import edge_traces
from r37core.product.extensions import read_settings
from r37core.rom.contact_weights import mean_fields, mean_positions, tip_contact
from r37core.rom.reduce import reduce_blade
from r37core.rom.reduced_model import contact_model
from r37core.rom.reduction_choice import BoundaryError, boundary_located
from r37core.rom.region_choice import RegionChoice
from r37core.time_integration.integrators import EXACT_MODAL

EVEN = {"spacing": "even"}
PATCHES = BoundaryChoice("pressure_edge", 4, True, "patches", "even")
STEEL = Material(2.1e11, 7800.0, 0.3, 1e9)


def bar(count=12, element="hexahedron20", height=0.012, across=2, along=8):
    """A bar whose tip is a rectangle: chord along y (30 mm), thickness along z."""
    return box_mesh(0.1, 0.03, height, (along, count, across), origin=(0.2, -0.015, -0.5 * height), element=element)


@pytest.fixture(scope="module")
def patched(reduced):
    """The reference blade on a coarse mesh, on five patches."""
    return reduced(replace(PATCHES, nodes=5))


@pytest.fixture(scope="module")
def every(mesh, reduced):
    """The same blade on all nodes of its edge."""
    count = len(mesh.node_set("tip_pressure_edge"))
    return reduced(BoundaryChoice("pressure_edge", count, True))


@pytest.mark.parametrize("tip_line", ["pressure_edge", "camber", "suction_edge"])
@pytest.mark.parametrize(("count", "corners"), [(1, True), (2, True), (5, True), (5, False)])
def test_weights_are_means(mesh, tip_line, count, corners):
    weights = tip_contact(mesh, BoundaryChoice(tip_line, count, corners, "patches", "even")).weights
    assert weights.shape == (count, len(mesh.points))
    np.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-14)
    chord, span, thickness = (weights @ mesh.parameters).T
    assert np.all(np.diff(chord) > 0.0)
    np.testing.assert_allclose(span, 1.0)
    np.testing.assert_allclose(thickness, {"pressure_edge": -1.0, "camber": 0.0, "suction_edge": 1.0}[tip_line], atol=1e-12)


@pytest.mark.parametrize("element", ["hexahedron20", "hexahedron", "wedge15", "wedge", "tetra10", "tetra"])
def test_hats_on_a_straight_tip(element):
    """Mean places are those of hats: inside at their positions, of the half ones at a third of their width."""
    mesh = bar(element=element)
    with_corners, without = (
        tip_contact(mesh, replace(PATCHES, corners=corners)).weights @ mesh.parameters[:, 0] for corners in (True, False)
    )
    np.testing.assert_allclose(with_corners, [1 / 9, 1 / 3, 2 / 3, 8 / 9], atol=1e-12)
    # at the ends half a hat and a piece of one height: (1/8 * 1/16 + 1/8 * (1/8 + 1/12)) / (1/4) of the chord
    np.testing.assert_allclose(without[:2], [(0.125 / 16 + 0.125 * 5 / 24) / 0.25, 0.375], atol=2e-4)


@pytest.mark.parametrize("element", ["hexahedron20", "wedge15", "tetra10"])
def test_loads_are_consistent(element):
    """A uniform load is shared as the elements' shape functions say: 1/6, 4/6, 1/6 of an edge's."""
    mesh = bar(4, element)
    members = np.zeros(len(mesh.points), dtype=bool)
    members[mesh.node_set("tip_pressure_edge")] = True
    (trace,) = edge_traces(mesh.points, mesh.blocks, members)
    assert len(trace.nodes) == 4
    np.testing.assert_allclose(trace.measures @ trace.values, np.tile(0.0075 * np.array([1.0, 1.0, 4.0]) / 6.0, (4, 1)))


def test_rigid_motion_and_moments(mesh):
    """A patch moves as the mean of its nodes does, and its force has the same resultant and no moment about that mean."""
    weights = tip_contact(mesh, PATCHES).weights
    shift, turn = np.array([1e-3, 2e-3, -3e-3]), np.array([0.4, -0.2, 0.3])
    moved = mean_fields(weights, (shift + np.cross(turn, mesh.points))[:, :, None])[:, :, 0]
    means = weights @ mesh.points
    np.testing.assert_allclose(moved, shift + np.cross(turn, means), atol=1e-15)
    # where the patch is said to be, on the cone of the tip, lies within the sagitta of its width
    assert np.linalg.norm(mean_positions(mesh.points, weights) - means, axis=1).max() < 1e-4
    force = np.array([10.0, -40.0, 25.0])
    forces = weights.toarray()[:, :, None] * force
    np.testing.assert_allclose(forces.sum(axis=1), np.tile(force, (4, 1)), rtol=1e-13)
    moments = np.cross(mesh.points[None] - means[:, None], forces).sum(axis=1)
    assert np.abs(moments).max() < 1e-14 * np.linalg.norm(force)


def test_places_lie_on_the_cone_of_the_tip_and_coordinates_are_the_means(patched):
    """The reduced model is as small as with nodes, and its first coordinates are the patches' displacements."""
    line = patched.tip_lines["pressure_edge"].points
    radius, axial = (np.hypot(*patched.contact_nodes.points[:, :2].T), patched.contact_nodes.points[:, 2])
    on_line = np.interp(axial, line[:, 2], np.hypot(*line[:, :2].T))
    np.testing.assert_allclose(radius, on_line, atol=1e-8)
    assert patched.contact == "patches"
    assert len(patched.singular_values) == 3 * (5 * 3 + 10)
    expected = np.eye(15, patched.size).reshape(5, 3, -1)
    np.testing.assert_allclose(patched.contact_nodes.basis, expected, atol=1e-10)


def test_static_response_to_patches_is_exact_and_reciprocal(mesh, matrices, patched):
    """Displacements of patches under forces on patches, against the full model; the matrix is symmetric."""
    weights = tip_contact(mesh, replace(PATCHES, nodes=5)).weights[:, matrices.free_nodes]
    spread = np.kron(weights.toarray(), np.eye(3))
    exact = spread @ matrices.solve_at_rest(np.ascontiguousarray(spread.T))
    reduced = la.inv(patched.stiffness)[:15, :15]
    np.testing.assert_allclose(exact, exact.T, atol=1e-12 * np.abs(exact).max())
    np.testing.assert_allclose(reduced, exact, atol=1e-9 * np.abs(exact).max())


def test_against_a_model_with_all_nodes_of_the_edge(mesh, patched, every):
    """The same means of a model that keeps every node: frequencies, static and dynamic flexibility of the patches."""
    line = mesh.node_set("tip_pressure_edge")
    np.testing.assert_array_equal(every.contact_nodes.nodes, line)
    weights = tip_contact(mesh, replace(PATCHES, nodes=5)).weights[:, line]
    rows = mean_fields(weights, every.contact_nodes.basis).reshape(15, -1)
    np.testing.assert_allclose(patched.modes(1500.0, 10)[0], every.modes(1500.0, 10)[0], rtol=3e-4)
    for speed, frequency in ((0.0, 0.0), (1500.0, 0.0), (1500.0, 2e4), (2000.0, 6e4)):
        dynamic = every.stiffness_at(speed) - frequency**2 * every.mass
        of_every = rows @ la.solve(dynamic, rows.T)
        of_patches = la.inv(patched.stiffness_at(speed) - frequency**2 * patched.mass)[:15, :15]
        np.testing.assert_allclose(of_patches, of_every, atol=2e-3 * np.abs(of_every).max())


def test_patches_depend_little_on_the_mesh_and_points_much(reduction):
    """Flexibility of a corner beyond that of the whole bar, on meshes twice and four times as fine along and across the tip."""
    own = {"points": [], "patches": []}
    for count, across in ((6, 1), (12, 2), (24, 4)):
        mesh = bar(count, height=0.012, across=across, along=6)
        matrices = assemble(mesh, STEEL)

        def flexibility(boundary, mesh=mesh, matrices=matrices):
            # static, and so that of any number of modes
            few = replace(reduction, speeds=(0.0,), fixed_interface_modes=1)
            return la.inv(reduce_blade(mesh, matrices, STEEL, boundary, few, {}).stiffness)[0, 0]

        whole = flexibility(BoundaryChoice("pressure_edge", 1, True, "patches"))
        for contact, values in own.items():
            values.append(flexibility(replace(PATCHES, contact=contact)) - whole)
    points, patches = (values[1:] / values[:-1] for values in map(np.array, own.values()))
    assert np.all(points > 1.15)
    # a load on a line: the displacement grows with the logarithm of the elements across it
    assert 1.07 > patches[0] > patches[1] > 1.0


@pytest.mark.parametrize("scene", [ABRADABLE, DIRECT], ids=["abradable", "direct"])
def test_no_energy_is_made(patched, scene):
    """Forces on patches, coupled through the mesh between them: the balance closes, in either engine, and both agree."""
    model, choice = contact_model(patched, "pressure_edge"), IntegrationChoice(3.2e-6, 3, 62, integrator=EXACT_MODAL)
    samples = []
    for simulation_class in ENGINES.values():
        simulation = simulation_class(model, 1600.0, scene, choice)
        state = simulation.start()
        samples.append(simulation.advance_samples(state, 3 * 62).samples)
        work, loss = simulation.work(state), state.totals["loss"]
        assert loss > 0.0
        assert abs(simulation.energy(state) - work + loss) <= 1e-9 * (np.abs(work) + loss)
    np.testing.assert_allclose(samples[0], samples[1], atol=1e-7 * np.abs(samples[1]).max())


def test_the_stress_region_leaves_out_every_element_that_contact_acts_on(mesh, reduced):
    everywhere = {"everywhere": RegionChoice(excluded_layers=1)}
    model = reduced(PATCHES, everywhere)
    assert not set(model.stress_regions["everywhere"].nodes.nodes) & set(mesh.node_set("tip_pressure_edge"))


SPEEDS = (0.0, 1000.0, 2000.0)


def test_patches_are_shorter_towards_the_edges_and_as_many_as_the_tip_has_room_for():
    """Unless chosen otherwise: twelve, or fewer on a coarse tip; points stay evenly spaced, eight anywhere."""
    patches, points = BoundaryChoice(contact="patches"), BoundaryChoice(contact="points")
    np.testing.assert_allclose(patches.chord_positions(5), [0.0, 0.5 - np.sqrt(0.125), 0.5, 0.5 + np.sqrt(0.125), 1.0])
    np.testing.assert_allclose(replace(patches, corners=False).chord_positions(2), 0.5 - np.sqrt(0.125) * np.array([1, -1]))
    for even in (points, replace(patches, spacing="even")):
        np.testing.assert_array_equal(even.chord_positions(5), np.linspace(0.0, 1.0, 5))
    np.testing.assert_array_equal(replace(points, spacing="cosine").chord_positions(7), patches.chord_positions(7))
    patches = BoundaryChoice(contact="patches")
    counts = [patches.on(np.linspace(0.0, 1.0, 2 * elements + 1)).nodes for elements in (56, 42, 21, 14, 4, 1)]
    assert counts == [12, 12, 11, 9, 5, 2]
    assert BoundaryChoice(contact="points").on(np.linspace(0.0, 1.0, 3)).nodes == 8
    assert replace(patches, nodes=20).on(np.linspace(0.0, 1.0, 3)).nodes == 20


@pytest.mark.parametrize("count", [16, 200])
def test_more_patches_than_the_edge_has_nodes_for(mesh, count):
    found = rf"found {count} contact patches on the 29 mesh nodes of the tip line 'pressure_edge'; allowed: at most 15 "
    with pytest.raises(BoundaryError, match=rf"{found}\(structure\.boundary\.nodes\), because .*; or contact: points, or a"):
        tip_contact(mesh, replace(PATCHES, nodes=count))


BLADES = """
Mine: { base: S100, contact: patches, chordwise_sweep_deg: 5 }
Kept: { base: Ref, contact: points, chordwise_sweep_deg: 5 }
Sweep: { base: Mine, vary: { chordwise_sweep_deg: [5, 10] } }
Like: { base: S100, sweep_percent: 80 }
Alone:
  profiles: config/profiles/rotor37.csv
  material: { youngs_modulus_pa: 1.8e+11, density_kg_m3: 8000, poissons_ratio: 0.3, yield_stress_pa: 1.38e+9 }
"""


@pytest.fixture
def settings_with(config_copy):
    """Settings of a project with those blades, and with changes by the command line."""
    with open(config_copy / "config/blades.yaml", "a") as stream:
        stream.write(BLADES)

    def read(boundary=None, **changes):
        return read_settings(config_copy, command_line_document({"structure": {"boundary": boundary or {}}} | changes))

    return read


def test_unlike_contact_is_told_before_the_run(settings_with):
    def told(*boundary, **changes):
        return [*remarks_on_unlike_contact(settings_with(*boundary, **changes))]

    (remark,) = told()
    assert remark.startswith(
        "contact differs (8 points, linear: Ref, L50, L100, ...; patches, linear: Mine, Sweep_5, Sweep_10; patches, quadratic: "
    )
    assert remark.endswith("; structure: { kinematics: quadratic, boundary: { contact: patches } } gives all blades one order")
    assert remark in remarks_of_pipeline(settings_with())
    (points,) = told(blades=["Ref", "Mine"])
    assert points.endswith("; structure: { boundary: { contact: patches } } gives all blades one order")
    assert told({"contact": "patches"}, blades=["Ref", "Mine"]) == told(blades=["Ref", "Like"]) == []


def test_direct_contact_on_points_is_told_at_the_end(settings_with):
    def told(*boundary, **changes):
        return [*remarks_on_points(settings_with(*boundary, **changes))]

    (remark,) = told(blades=["Ref", "S50", "Mine"])
    assert remark.startswith("direct: contact of 2 blades acts on points, as published, and changes with every finer mesh")
    assert "structure.boundary.contact: patches" in remark
    assert told(blades=["Ref"])[0].startswith("direct: contact of Ref acts")
    assert told(blades=["Ref"], scenes=["abradable"]) == told(blades=["Mine"]) == []
    assert told({"contact": "patches"}) == []


def test_a_variant_that_is_linear_by_its_base_is_told_before_the_run(settings_with, config_copy):
    (remark,) = remarks_on_linear_variants(settings_with(blades=["Ref", "Like", "Sweep", "Alone"]))
    assert remark.startswith("Like, Sweep_5, Sweep_10: linear, as the base is; ")
    assert "structure: { kinematics: quadratic }" in remark
    assert remark in remarks_of_pipeline(settings_with(blades=["Ref", "Like", "Sweep", "Alone"]))
    assert not [*remarks_on_linear_variants(settings_with(blades=["Ref", "Alone"]))]
    for kinematics in ("linear", "quadratic"):
        changes = {"structure": {"kinematics": kinematics, "boundary": {}}}
        assert not [*remarks_on_linear_variants(settings_with(blades=["Like"], **changes))]


def test_a_rigid_bare_casing_is_told_at_the_end(settings_with):
    def told(*scenes):
        return [*remarks_at_end(settings_with(blades=["Alone"], scenes=scenes))]

    (remark,) = told("abradable", "direct", "elastic_direct", "physical_direct")
    assert remark.startswith("direct, physical_direct: the bare casing is rigid; an elastic one took")
    assert told("abradable", "elastic_direct") == []
    assert len([*remarks_at_end(settings_with(blades=["Ref"], scenes=["direct"]))]) == 2


def test_the_place_that_chose_is_blamed(settings_with):
    own, given = settings_with(), settings_with({"contact": "patches"})
    for blade, blamed in {"Kept": "Kept", "Like": "Ref", "Sweep_5": "Mine"}.items():
        assert re.fullmatch(rf"config/blades\.yaml:\d+: {blamed}\.contact", location_of_contact(own, blade))
    assert location_of_contact(given, "Kept") == "--config: structure.boundary.contact"
    with (
        pytest.raises(BoundaryError, match=r"^--config: structure\.boundary\.contact: no room"),
        boundary_located(location_of_contact(given, "Kept")),
    ):
        raise BoundaryError("no room")


@pytest.mark.parametrize(("kind", "boundary", "message"), refusal_rows(TABLE, "patches"))
def test_what_is_refused_before_anything_is_made(settings_with, kind, boundary, message):
    boundary = yaml.safe_load(boundary)
    with pytest.raises(ConfigError, match=pattern_of(message)) as refusal:
        settings_with(boundary, blades=[boundary.pop("blade")])
    assert "\n" not in str(refusal.value)
    # as many as there is room for
    settings_with(EVEN | {"nodes": 43, "contact": "patches"})
