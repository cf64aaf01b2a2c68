"""What a program is compiled for: constants of its functions, so that what a scene lacks is not in its program.

Only what changes a loop over modes or nodes is one of these; the rest of a scene is numbers of the record. The values here are
placeholders: each program has its own (r37core.program_constants).
"""

from __future__ import annotations

from typing import NamedTuple


class Kind(NamedTuple):
    """The time integration of a scene.

    `published`: the integrator is central_difference, whose forces correct the prediction; else they are those at t_n, see
    contact_steps. `lined`, `exact_gap`: see Scene. `coriolis`: modes are complex, see r37core.time_integration.gyroscopic.
    """

    published: bool
    lined: bool
    exact_gap: bool
    coriolis: bool

    @property
    def constants(self) -> dict[str, bool]:
        """By the names that the functions know them by."""
        return {name.upper(): value for name, value in self._asdict().items()}


PUBLISHED = LINED = EXACT_GAP = CORIOLIS = False
