"""What both engines add up over a run."""

from __future__ import annotations

import numpy as np

TOTALS = np.dtype(
    [
        ("steps_in_contact", np.float64),  # steps with any contact force
        ("casing_hits", np.float64),  # onsets of direct contact
        ("largest_force", np.float64),  # normal, on a node (N)
        ("worst_complementarity", np.float64),  # largest relative violation
        ("work", np.float64),  # of the contact forces (J)
        ("loss", np.float64),  # of energy to damping (J)
        ("steps", np.float64),
        ("steps_jumped", np.float64),  # of them, part of a jump over free flight
    ]
)
"""What is added up over a run."""
