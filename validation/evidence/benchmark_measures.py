"""Numbers of a response that only the evidence needs: see `r37core.results.measures` for the others."""

import numpy as np
import xarray as xr

from r37core.results.measures import leading_edge, motion


def steepest_fall(response: xr.Dataset) -> tuple[float, float]:
    """Speed (rad/s) before which the motion loses its largest share to the next speed, and that share."""
    level = motion(response)
    shares = 1.0 - np.divide(level[1:], level[:-1], out=np.ones(len(level) - 1), where=level[:-1] > 0.0)
    index = int(np.argmax(shares))
    return float(response["speed"][index]), float(shares[index])


def interactions_above(response: xr.Dataset, floor: float) -> int:
    """Separate ranges of speeds whose normal rms is above `floor` (m); a run that diverged is above."""
    above = np.concatenate([[0], leading_edge(response)["rms_normal"].fillna(np.inf).values > floor])
    return int(np.count_nonzero(np.diff(above.astype(int)) == 1))


def median_over_speed(response: xr.Dataset, name: str) -> float:
    """Value of a tip variable that half of the range of speeds lies below; each counts for its length of the range."""
    values = leading_edge(response)[name].values
    length = np.where(np.isfinite(values), np.gradient(response["speed"].values), 0.0)
    order = np.argsort(values)
    summed = np.cumsum(length[order])
    return float(values[order][np.searchsorted(summed, 0.5 * summed[-1])])


def strongest_lobes(peak: xr.Dataset) -> float:
    """Number of lobes (3 to 12) of the largest harmonic of the wear at one speed."""
    harmonics = peak["wear_harmonic"].sel(lobes=slice(3, 12)).fillna(0.0)
    return float(harmonics["lobes"][int(harmonics.argmax("lobes"))])


def first_contact(response: xr.Dataset) -> np.ndarray:
    """Number of the first revolution in which a tip point moves beyond its position at rest, shape (speeds,); NaN for none."""
    touched = response["revolution_maximum"].max("tip_point").transpose("speed", "revolution").values > 0.0
    return np.where(touched.any(axis=1), touched.argmax(axis=1) + 1.0, np.nan)


def history_of(response: xr.Dataset, speed: float) -> np.ndarray:
    """Largest stress (Pa) of every revolution at a speed (rad/s) whose history was kept, shape (revolutions,)."""
    return response["max_von_mises_history"].sel(history_speed=speed).values


def overtakes(ours: np.ndarray, theirs: np.ndarray) -> float:
    """First revolution from which `ours` stays above `theirs` for five revolutions; NaN if it never does."""
    above = np.lib.stride_tricks.sliding_window_view(ours > theirs, 5).all(axis=1)
    return float(np.argmax(above) + 1) if above.any() else np.nan


def slope_of_clearance(campbell: xr.Dataset, mode: str) -> float:
    """Change of the dynamic clearance per tangential displacement at rest, of one blade's Campbell diagram."""
    clearance = campbell["dynamic_clearance"].sel(mode=mode)
    slope = np.gradient(clearance.values, clearance["tangential_displacement"].values)
    return float(abs(slope[len(slope) // 2]))
