"""Peaks that validation/evidence/elastic_casing.py reads off responses with runs that diverge."""

import numpy as np
from evidence.elastic_casing import clear_peak


def test_peaks_beside_runs_that_diverge_are_no_peaks():
    speeds = np.arange(0.0, 80.0, 4.0)
    rms = 1.0 / (1.0 + ((speeds - 40.0) / 20.0) ** 2)
    assert clear_peak(speeds, rms) == 10

    def beside(*diverged):
        return np.where(np.isin(speeds, diverged), np.nan, rms)

    assert clear_peak(speeds, beside(0.0, 72.0)) == 10
    # on the flanks above half the power, on either side
    assert clear_peak(speeds, beside(52.0)) is None and clear_peak(speeds, beside(28.0)) is None
    # a single high run between two that diverge
    lone = np.where(speeds == 40.0, 9.0, 1e-3)
    assert clear_peak(speeds, lone) == 10
    assert clear_peak(speeds, np.where(speeds == 48.0, np.nan, lone)) is None
    assert clear_peak(speeds, np.full(20, np.nan)) is None
