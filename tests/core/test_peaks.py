"""Peaks and their widths are those of scipy.signal, plateaus, places without a number and both ends included."""

import numpy as np
import pytest
from scipy.signal import find_peaks, peak_widths

from r37core.base.peaks import half_width, prominent_peaks


@pytest.mark.filterwarnings("ignore:some peaks")
def test_peaks_are_those_of_scipy():
    generator, widths = np.random.default_rng(0), 0
    for number in range(800):
        count = generator.integers(0, 30)
        curve = generator.integers(0, 6, count).astype(float) if number % 2 else generator.random(count)
        prominence = generator.choice([0.0, 0.3, 1.0, 2.0])
        peaks, _ = find_peaks(curve, prominence=0.0)
        for peak in peaks.tolist():
            _, _, left, right = peak_widths(curve, [peak])
            assert half_width(curve, peak) == np.floor(right[0]) - np.ceil(left[0]) + 1
            widths += 1
        assert all(half_width(curve, index) == 0 for index in {*range(count)} - {*peaks.tolist()})
        curve[: count // 8] = np.nan
        assert prominent_peaks(curve, prominence).tolist() == find_peaks(curve, prominence=prominence)[0].tolist()
    assert widths > 800
