"""Shapes to look at: modes, and the worst instant of interactions, as .vtu files and as .glb files that move."""

from collections.abc import Mapping
from pathlib import Path
from typing import Final

import numpy as np
from matplotlib import colormaps

from r37core.base.io import write_json
from r37core.base.speeds import exact_text
from r37core.base.units import RPM
from r37core.exchange.fields import Target, WorstInstant, displacement_of, mode_shapes, stress_of, write_modes, write_stress
from r37core.fem.material import Material
from r37core.fem.surface import outer_faces
from r37core.mesh.blade_mesh import BladeMesh
from r37core.rom.reduced_model import ReducedModel
from r37core.stress.operator import von_mises

from . import INDEX
from .gltf import MovingSurface, write_glb

COLOUR_MAP: Final = "viridis"
LARGEST_SHOWN = 0.1
"""Largest displacement as it is shown, as a share of the blade's height."""

_MODE_SECONDS, _REVOLUTION_SECONDS, _MODE_STEPS = 2.0, 6.0, 32
_MOST_TARGETS = 8  # what every viewer can morph at once
_LEFT_OUT = 0.01  # of the motion
SHOWN = 0.99  # of the nodes: the few at contact and clamping have stresses that grow with every finer mesh


def write_mode_shapes(mesh: BladeMesh, model: ReducedModel, material: Material, count: int, folder: Path) -> None:
    """Write the `count` lowest modes at rest: modes_0.vtu with modes.pvd, and mode_<name>.glb, which swings.

    Colours are the displacement as a share of its largest; modes_0.vtu has the stress of each mode, too. The model must
    recover the whole blade.
    """
    write_modes(mesh, model, [0.0], count, Target(folder), material)
    (nodes, triangles), modes = _skin(mesh), mode_shapes(model, 0.0, count)
    times = np.linspace(0.0, _MODE_SECONDS, _MODE_STEPS + 1)
    swing = np.sin(2.0 * np.pi * times / _MODE_SECONDS)[:, None]
    entries = []
    for name, frequency, displacement in zip(*modes, strict=True):
        size = np.linalg.norm(displacement, axis=1)
        target = displacement[nodes] * (LARGEST_SHOWN * _height(mesh) / size.max())
        about = {
            "shape": f"mode_{name}",
            "title": f"mode {name}, {frequency:.6g} Hz at rest",
            "quantity": "displacement as a share of its largest",
            "unit": "1",
            "largest_shown": 1.0,
        }
        values = size[nodes] / size.max()
        colours = _colours(values, 1.0)
        surface = MovingSurface(mesh.points[nodes], triangles, values, colours, target[None], times, swing, np.ones(1), about)
        write_glb(surface, f"mode_{name}", folder / f"mode_{name}.glb")
        entries.append(about)
    write_json(entries, folder / INDEX)


def write_worst_shapes(
    mesh: BladeMesh,
    model: ReducedModel,
    material: Material,
    instants: Mapping[float, WorstInstant],
    titles: Mapping[float, str],
    folder: Path,
) -> None:
    """Write the worst instant at each speed (rad/s): stress_<speed>.vtu with stress.pvd, and stress_<speed>.glb.

    The .glb moves as the blade did in its last revolution; its colours are the von Mises stress (Pa) of the worst instant, up
    to the largest one of the region, or to what SHOWN of the nodes stay below if that is more. `titles` of the interactions
    at the speeds. The model must recover the whole blade.
    """
    write_stress(mesh, model, material, instants, Target(folder))
    (nodes, triangles), entries = _skin(mesh), []
    for speed, instant in instants.items():
        stress = von_mises(stress_of(mesh, model, material, instant, speed)[1])
        motion = displacement_of(model, instant.revolution)[:, nodes]
        magnified = _round_down(LARGEST_SHOWN * _height(mesh) / np.linalg.norm(motion, axis=2).max())
        targets, weights = _few_targets(magnified * motion)
        # the last revolution begins anew where it ends
        weights = np.concatenate([weights, weights[:1]])
        times = np.linspace(0.0, _REVOLUTION_SECONDS, len(weights))
        name = f"stress_{exact_text(speed)}"
        outside = ", above yield: outside the linear model" if instant.largest > material.yield_stress else ""
        largest = max(instant.largest, float(np.quantile(stress, SHOWN)))
        about = {
            "shape": name,
            "title": f"{titles[speed]} at {speed:g} rad/s ({RPM * speed:.0f} rpm): largest von Mises stress of the region "
            f"{1e-6 * instant.largest:.0f} MPa{outside}; displacement {magnified:g} times as large",
            "quantity": "von Mises stress",
            "unit": "Pa",
            "largest_shown": largest,
            "speed_rad_s": speed,
            "magnification": magnified,
            "worst_s": float(times[instant.number]),
        }
        values, still = stress[nodes], weights[instant.number]
        colours = _colours(values, largest)
        surface = MovingSurface(mesh.points[nodes], triangles, values, colours, targets, times, weights, still, about)
        write_glb(surface, name, folder / f"{name}.glb")
        entries.append(about)
    write_json(entries, folder / INDEX)


def _few_targets(motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The motion, shape (instants, points, 3), as few targets and their weights, shape (instants, targets).

    The left singular vectors of the motion: with all but _LEFT_OUT of its size, as long as they are not too many.
    """
    weights, size, shapes = np.linalg.svd(motion.reshape(len(motion), -1), full_matrices=False)
    left = np.sqrt(np.cumsum(size[::-1] ** 2)[::-1] / max(np.sum(size**2), 1e-300))
    count = int(np.clip(np.count_nonzero(left > _LEFT_OUT), 1, _MOST_TARGETS))
    weights = weights[:, :count] * size[:count]
    # weights up to 1, as viewers with sliders expect
    scale = np.maximum(np.abs(weights).max(axis=0), 1e-300)
    return (shapes[:count] * scale[:, None]).reshape(count, *motion.shape[1:]), weights / scale


def _colours(values: np.ndarray, largest: float) -> np.ndarray:
    return colormaps[COLOUR_MAP](np.clip(values / max(largest, 1e-300), 0.0, 1.0))[:, :3]


def _skin(mesh: BladeMesh) -> tuple[np.ndarray, np.ndarray]:
    """The outer surface between corner nodes: nodes of the mesh, shape (points,), and the triangles that number them."""
    corners = [part.nodes[:, : part.corners] for part in outer_faces(mesh.blocks)]
    triangles = [face[:, split] for face in corners for split in ([0, 1, 2], [0, 2, 3])[: face.shape[1] - 2]]
    nodes, numbers = np.unique(np.concatenate(triangles), return_inverse=True)
    return nodes, numbers.reshape(-1, 3)


def _height(mesh: BladeMesh) -> float:
    """Height of the blade (m): from the lowest to the highest radius."""
    return float(np.ptp(np.hypot(mesh.points[:, 0], mesh.points[:, 1])))


def _round_down(number: float) -> float:
    """A number with one digit, not larger: a magnification that can be said."""
    power = 10.0 ** np.floor(np.log10(number))
    return float(f"{np.floor(number / power) * power:.0e}")
