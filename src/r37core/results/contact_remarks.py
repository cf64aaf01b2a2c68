"""What a finished run says where nothing has touched. Light: Snakemake's start imports it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def remarks_on_contact(runs: Sequence[tuple[str, np.ndarray]]) -> list[str]:
    """A line on all runs without a contact force at any speed, whose zeros are no result.

    `runs`: blade and scene in words, and the largest normal force (N) at each speed, NaN for a speed that was not run.
    """
    apart = [of for of, force in runs if np.isfinite(force).any() and not np.any(force > 0.0)]
    if not apart:
        return []
    return [
        f"{', '.join(apart)}: the tip touched nothing at any speed, so all numbers are zero; casing.clearance_m, casing.lobes "
        "and casing.amplitude_clearances say where it can"
    ]
