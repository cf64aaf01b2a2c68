"""Numbers of each blade of a rotor, beside those of all its blades together."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy import ndarray
from numpy.fft import rfft

from r37core.contact.scene import Rotor

from .finished_run import FinishedRun
from .kept_numbers import KEPT

MOST_GROWTH = 200
"""Spans of revolutions whose largest motion and stress are kept of each blade: a dataset stays small with many blades."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RotorRun(FinishedRun):
    """A run of a `rotor` that is done, and where the samples of its blades lie in time.

    `late`, shape (blades,): time of a blade's samples after those of a blade at angle 0, in samples; `worn` (m3), shape
    (blades,): what each has worn off the lining.
    """

    rotor: Rotor
    late: ndarray
    worn: ndarray

    def leader(self, statistic: Sequence[ndarray]) -> int:
        """Place of the blade with the largest motion in the statistic; of a diverged run, of the one that diverged first."""
        return int(_rms(statistic).argmax()) if self.first_diverged is None else self.first_diverged

    def numbers_of_each(self, samples: Sequence[ndarray], history: ndarray | None) -> dict[str, Any]:
        """Numbers of each blade, shape (blades,) first, of the motion of its leading edge, normal and tangential (KEPT).

        `samples` (m): displacement of each blade, shape (samples, 2, 3). `history` (Pa): largest stress, shape (blades,
        revolutions), None where it is not known.

        `blade_number`, `blade_angle` (rad), `blade_frequency_factor`, `blade_longer` (m), `blade_rms` and `blade_peak` (m) over
        the last half, `blade_maximum` (m), shape (blades, spans), in spans of `span_revolutions` each, `blade_contact`, share
        of the time, and `blade_worn` (m3), of the lining. `leader`: number of the blade that leads. `nodal_diameter` and
        `nodal_diameter_share`: see nodal_diameters. `blade_revolution_von_mises` (Pa): the `history`.
        """
        rotor, choice = self.rotor, self.problem.choice
        totals = np.array([state.totals for state in self.states])
        half = [part[choice.revolutions // 2 * choice.samples_per_revolution :] for part in samples]
        motion = np.array([np.linalg.norm(part[:, 0, KEPT], axis=-1) for part in samples])
        maxima = motion.reshape(len(motion), choice.revolutions, -1).max(axis=2)
        growth, span = span_maxima(maxima)
        numbers = {
            "blade_number": rotor.numbers,
            "blade_angle": rotor.angles,
            "blade_frequency_factor": rotor.frequency_factors,
            "blade_longer": rotor.longer,
            "blade_rms": _rms(half),
            "blade_peak": maxima[:, choice.revolutions // 2 :].max(axis=1),
            "blade_maximum": growth,
            "blade_contact": totals["steps_in_contact"] / np.maximum(totals["steps"], 1.0),
            "blade_worn": self.worn,
            "span_revolutions": span,
            "leader": rotor.numbers[self.leader(half)],
            **nodal_diameters(np.array([part[:, 0, KEPT] for part in half]), self.late, rotor),
        }
        if history is not None:
            numbers["blade_revolution_von_mises"] = history
        return numbers


def _rms(samples: Sequence[ndarray]) -> ndarray:
    """Rms (m) of the leading edge's motion of each blade, normal and tangential together, shape (blades,)."""
    motion = np.array([part[:, 0, KEPT] for part in samples])
    return np.sqrt(np.mean(np.linalg.norm(motion, axis=-1) ** 2, axis=1))


def span_maxima(values: ndarray) -> tuple[ndarray, int]:
    """The largest of every span of revolutions along the last axis, in single precision, and how many revolutions a span has.

    There are at most MOST_GROWTH spans; the last one may be shorter.
    """
    revolutions = values.shape[-1]
    span = -(-revolutions // MOST_GROWTH)
    return np.maximum.reduceat(values, np.arange(0, revolutions, span), axis=-1).astype(np.float32), span


def nodal_diameters(displacement: ndarray, late: ndarray, rotor: Rotor) -> dict[str, ndarray]:
    """Waves of the blades' motion: how it is made of those that run round the rotor.

    `displacement` (m), shape (blades, samples, directions), of whole revolutions; `late`, shape (blades,): see BladesRecord. A
    wave of n nodal diameters at frequency w is x_b(t) = Re(X exp(i(w t - n theta_b))), positive n in the sense of growing
    theta. With the Fourier transform X_bd(w) of each blade's motion along the direction d the share of n is

        P_n = sum_d,w |sum_b X_bd(w) exp(i n theta_b)|^2 / (B sum_d,w,b |X_bd(w)|^2),

    over positive frequencies. For equal angles the shares add up to 1 (Parseval). `nodal_diameter`: from -(B-1)//2 to B//2.
    """
    blades, samples = displacement.shape[:2]
    diameters = np.arange(-((blades - 1) // 2), blades // 2 + 1)
    waves = rfft(displacement, axis=1)[:, 1:]
    waves = waves * np.exp(-2j * np.pi / samples * late[:, None] * np.arange(1, waves.shape[1] + 1))[..., None]
    with np.errstate(invalid="ignore"):  # blades that stand still have no share
        power = np.sum(np.abs(waves) ** 2)
        diameter_waves = np.exp(1j * np.outer(diameters, rotor.angles)) @ waves.reshape(blades, -1)
        share = np.sum(np.abs(diameter_waves) ** 2, axis=1) / (blades * power)
    return {"nodal_diameter": diameters, "nodal_diameter_share": share}
