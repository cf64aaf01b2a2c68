"""Fields of modes and stress on the whole mesh."""

from dataclasses import replace

import numpy as np
import pytest
from box_operator import box_operator
from test_clearance import KEPT, NARROW, SHORT, growing, static_displacement
from test_rotating_blade import SPEED

from r37core.fem.stress import recovered_stress
from r37core.rom.reduced_model import contact_model
from r37core.rom.rotation import rotation_amplitudes
from r37core.stress.operator import von_mises
from r37core.stress.recovery import stress_operators
from r37core.time_integration.speed_run import run_speed
from r37studies.fields import WorstInstant, displacement_of, stress_of


@pytest.mark.slow
def test_stress_is_that_of_both_displacements_together(whole, mesh, steel):
    """Of the sum of the displacements, from the elements themselves; not the sum of two von Mises stresses."""
    contact, speed = contact_model(whole, "pressure_edge"), 1500.0
    choice = replace(SHORT, time_step=3.2e-6, snapshots_per_revolution=31, snapshot_revolutions=1)
    kept = {
        name: run_speed(contact, speed, growing(NARROW), choice, results, **KEPT)
        for name, results in (("total", ["stress", "static_stress"]), ("vibration", ["stress"]))
    }
    recovery = box_operator(whole, steel)
    found = recovery.max_von_mises(kept["total"]["snapshots"])
    vibration = recovery.max_von_mises(kept["vibration"]["snapshots"])
    box, still = whole.stress_regions["box"], static_displacement(whole, speed)
    moving = box.nodes.basis @ kept["vibration"]["snapshots"].T
    tensors = recovered_stress(box.elements, box.nodes.points, still + moving, steel, False)
    np.testing.assert_allclose(found, von_mises(tensors).max(axis=0), rtol=1e-5)
    rotation = von_mises(recovered_stress(box.elements, box.nodes.points, still, steel, False)).max()
    assert rotation > 1e8
    assert np.all(found <= (rotation + vibration) * (1.0 + 1e-6))
    assert np.all(np.abs(found - rotation - vibration) > 1e-3 * rotation)
    # exports have the displacement of both, too
    everywhere = displacement_of(whole, kept["total"]["snapshots"]) - displacement_of(whole, kept["vibration"]["snapshots"])
    alone = whole.whole_blade.rotation_shapes @ rotation_amplitudes(whole.rotation_stiffening, speed)
    np.testing.assert_allclose(everywhere[0], alone, rtol=0, atol=1e-6 * np.abs(alone).max())


@pytest.mark.slow
@pytest.mark.parametrize("rotates", [False, True])
def test_stress_is_that_of_the_whole_displacement(displaced, mesh, steel, rotates):
    """With that of rotation, or less it.

    Of the operators, at nodes of the box whose elements all belong to it, as of the field on the whole blade.
    """
    box = stress_operators(displaced, steel)["box"].displaced(SPEED)
    modes = displaced.modes(SPEED, 3)[1]
    coordinates = modes @ [3e-4, -5e-5, 2e-5]
    if rotates:
        coordinates = np.append(coordinates, rotation_amplitudes(displaced.rotation_stiffening, SPEED))
    ours = box.von_mises(coordinates[None])[0]
    _, field = stress_of(mesh, displaced, steel, WorstInstant(0.0, coordinates[None], 0), SPEED)
    s = field[:, displaced.stress_regions["box"].nodes.nodes[displaced.stress_regions["box"].evaluated]]
    theirs = np.sqrt(0.5 * ((s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2) + 3.0 * np.sum(s[3:] ** 2, axis=0))
    region = displaced.stress_regions["box"].nodes.nodes
    outside = np.concatenate([nodes[~np.isin(nodes, region).all(axis=1)].ravel() for nodes in mesh.blocks.values()])
    inner = ~np.isin(region[displaced.stress_regions["box"].evaluated], outside)
    np.testing.assert_allclose(ours[inner], theirs[inner], rtol=0, atol=0.02 * theirs.max())
