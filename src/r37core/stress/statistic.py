"""Statistic of the stress in a run's revolutions. Not imported by simulations, so a changed one runs none of them again."""

import numpy as np

HIGH = 0.9
"""Share of the revolutions that the high quantile is not exceeded in."""


def stress_statistic(of_revolutions: np.ndarray, yield_stress: float) -> dict[str, np.ndarray]:
    """Largest, median and HIGH quantile (Pa) of the largest stress of each revolution (Pa), and the share of them above yield.

    `of_revolutions`, shape (revolutions,): of the last half of a run; NaN where there is one among them: it diverged.
    """
    ended = bool(np.isfinite(of_revolutions).all())
    median, high, ever = np.quantile(of_revolutions, (0.5, HIGH, 1.0)) if ended else 3 * (np.nan,)
    return {
        "max_von_mises_ever": np.array(ever),
        "max_von_mises_median": np.array(median),
        "max_von_mises_high": np.array(high),
        "share_of_revolutions_above_yield": np.array(np.mean(of_revolutions > yield_stress) if ended else np.nan),
    }
