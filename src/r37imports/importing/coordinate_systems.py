"""Grid points of Nastran in the basic coordinate system, from those that their file defines."""

import re
from collections.abc import Sequence

import numpy as np

from r37imports.refusal import ImportRefused

from .bulk_data import bulk_number


class GridPoints:
    """Grid points of some cards: their `labels`, and their `positions`, shape (points, 3), in the basic coordinate system.

    Raises ImportRefused for numbers that cannot be read, and for coordinate systems without a definition or axes.
    """

    def __init__(self, cards: Sequence[list[str]]):
        default = next((card[2] for card in cards if card[0] == "GRDSET"), "")
        grids = [[*card[:2], card[2] or default, *card[3:]] for card in cards if card[0] == "GRID"]
        table = np.array([_numbers(card, 5) for card in grids])
        self.labels, systems = table[:, :2].T.astype(np.int64)
        self._places = dict(zip(self.labels.tolist(), zip(systems.tolist(), table[:, None, 2:], strict=True), strict=True))
        self._frames: dict[int, tuple[str, np.ndarray, np.ndarray]] = {}
        self._definitions: dict[int, tuple[str, np.ndarray]] = {}
        for card in cards:
            if re.fullmatch("CORD[12][RCS]", name := card[0]):
                # the first kind has two systems of four fields on a card
                for own in np.split(_numbers(card, 8), 2) if name[4] == "1" else (_numbers(card, 11),):
                    self._definitions[int(own[0])] = name, own[1:]
        self.positions = np.empty((len(table), 3))
        for system in np.unique(systems).tolist():
            self.positions[systems == system] = self._basic(system, table[systems == system, 2:])

    def _basic(self, system: int, points: np.ndarray) -> np.ndarray:
        """Positions in the basic system of `points`, shape (n, 3), of a `system`, angles in degrees."""
        if system == 0:
            return points
        if system not in self._frames:
            self._frames[system] = self._frame(system)
        kind, origin, axes = self._frames[system]
        first, second, third = points.T
        if kind == "S":
            first, second, third = first * np.sin(np.radians(second)), third, first * np.cos(np.radians(second))
        if kind != "R":
            first, second = first * np.cos(np.radians(second)), first * np.sin(np.radians(second))
        return origin + np.stack([first, second, third], axis=1) @ axes

    def _frame(self, system: int) -> tuple[str, np.ndarray, np.ndarray]:
        """Kind (R, C, S), origin and axes, rows of shape (3, 3), of a system."""
        # a system that needs itself no longer finds its definition
        name, numbers = self._definitions.pop(system, ("", np.empty(0)))
        if not name:
            raise ImportRefused(
                f"coordinate system {system} of GRID is not defined, or by itself; allowed: CORD1 or CORD2 of kind R, C, S"
            )
        if name[4] == "2":
            corners = self._basic(int(numbers[0]), numbers[1:].reshape(3, 3))
        else:
            corners = np.concatenate(
                [self._basic(*self._places.get(number, (0, np.full((1, 3), np.nan)))) for number in numbers]
            )
        z, aside = corners[1:] - corners[0]
        y = np.cross(z, aside)
        if not np.linalg.norm(y) > 1e-9 * np.linalg.norm(z) * np.linalg.norm(aside):
            raise ImportRefused(f"coordinate system {system}: {name} needs three points of the file, not on one line")
        axes = np.stack([np.cross(y, z), y, z])
        return name[-1], corners[0], axes / np.linalg.norm(axes, axis=1)[:, None]


def _numbers(card: list[str], count: int) -> np.ndarray:
    """The first numbers of a card, 0 of an empty field. Raises ImportRefused for other texts."""
    cells = [*card[1:], *[""] * count][:count]
    numbers = np.array([bulk_number(cell or "0") for cell in cells])
    if wrong := [f"'{cell}'" for cell, number in zip(cells, numbers, strict=True) if not np.isfinite(number)]:
        raise ImportRefused(f"{card[0]} {card[1]}: found {', '.join(wrong)}; allowed: numbers, each within its field's columns")
    return numbers
