"""Coincidence: speeds at which a mode of the blade and a wave round an elastic casing have one frequency in the rotor's frame.

A mode of n nodal diameters, of frequency f_n on a casing that does not turn, is seen from the rotor with |f_n - n Omega/(2 pi)|
of its forward wave, which runs with the rotor, and f_n + n Omega/(2 pi) of its backward wave. Source: Schmiechen, Travelling
Wave Speed Coincidence, PhD thesis, Imperial College London, 1997; Legrand et al., J. Sound Vib. 319 (2009) 366-391.
"""

from collections.abc import Iterator, Mapping

import numpy as np
import scipy
from numpy import ndarray
from pandas import DataFrame
from xarray import DataArray, Dataset

from r37core.contact.elastic_casing import ElasticCasing
from r37core.contact.ring import RingMode
from r37core.rom.naming import NAMED_MODES

WAVES = {"forward": -1.0, "backward": 1.0}
"""Sense of a wave -> sign with which the rotation adds to its frequency."""

COLUMNS = ("scene", "blade", "mode", "nodal_diameter", "wave", "speed_rad_s", "frequency_hz", "simulated")


def seen_from_rotor(mode: RingMode, wave: str, speeds: ndarray) -> ndarray:
    """Frequency (Hz) of one of WAVES at `speeds` (rad/s), negative where the rotor overtakes the wave."""
    return (mode.frequency + WAVES[wave] * mode.nodal_diameter * speeds) / (2.0 * np.pi)


def waves_of(mode: RingMode) -> tuple[str, ...]:
    """The waves of a mode; without nodal diameters it runs nowhere."""
    return tuple(WAVES) if mode.nodal_diameter else ("forward",)


def modes_met(casing: ElasticCasing, campbell: Dataset) -> tuple[RingMode, ...]:
    """Modes of a casing that named modes of the blades can meet, in simulations or not: see ElasticCasing.modes_met."""
    highest = 2.0 * np.pi * float(campbell["frequency"].sel(mode=list(NAMED_MODES)).max())
    return casing.modes_met(float(campbell["speed"].max()), highest)


def coincidence_table(campbell: Dataset, casings: Mapping[str, ElasticCasing]) -> DataFrame:
    """All coincidences of the named modes of every blade with the casing of each scene: one row each, by ascending speed.

    `simulated`: yes, or no where the scene's simulations leave the mode of the casing out, and so do not show it.
    """
    rows = [
        (scene, str(blade), name, mode.nodal_diameter, wave, speed, frequency, "yes" if mode in casing.modes else "no")
        for scene, casing in casings.items()
        for blade in campbell["blade"].values
        for name in NAMED_MODES
        for mode in modes_met(casing, campbell)
        for wave in waves_of(mode)
        for speed, frequency in coincidences(campbell["frequency"].sel(blade=blade, mode=name), mode, wave)
    ]
    return DataFrame(rows, columns=COLUMNS).sort_values(["scene", "blade", "speed_rad_s"], kind="stable")


def coincidences(frequency: DataArray, mode: RingMode, wave: str) -> Iterator[tuple[float, float]]:
    """Speeds (rad/s) and frequencies (Hz) at which a blade's `frequency` (Hz) over speed is that of a wave.

    The blade's is interpolated by a cubic spline, the wave's is a straight line: the roots are exact of both.
    """
    speeds = frequency["speed"].values
    crossing_speeds = {
        float(speed)
        for sign in (1.0, -1.0)
        for speed in scipy.interpolate.CubicSpline(speeds, frequency.values - sign * seen_from_rotor(mode, wave, speeds)).roots(
            extrapolate=False
        )
        if speed > 0.0
    }
    for speed in sorted(crossing_speeds):
        yield speed, abs(float(seen_from_rotor(mode, wave, np.array(speed))))
