"""Signals over engine order and time: spectrograms, and the amplitude of single orders."""

import numpy as np
from scipy.signal import ShortTimeFFT
from scipy.signal.windows import boxcar, hann

SPECTROGRAM_REVOLUTIONS = 8
"""Length of the window of a spectrogram: engine orders a quarter apart are told apart."""

TRACK_REVOLUTIONS = 2
"""Length of the window of an order's track; over whole revolutions whole orders do not leak into each other."""


def spectrogram(signal: np.ndarray, turn: np.ndarray, per_revolution: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Engine orders, revolutions (middle of the windows) and amplitudes, shape (orders, revolutions), of a signal.

    `signal`, shape (samples,), at `turn` (revolutions), `per_revolution` samples in each; a Hann window of
    SPECTROGRAM_REVOLUTIONS every half revolution, those alone that lie within the signal's finite part. A steady oscillation
    of an order in the middle of a line has its amplitude there.
    """
    window = hann(SPECTROGRAM_REVOLUTIONS * per_revolution, sym=False)
    return _windows(signal, turn, per_revolution, window, per_revolution // 2)


def order_tracks(
    signal: np.ndarray, turn: np.ndarray, per_revolution: int, orders: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Revolutions and the amplitudes of whole engine `orders`, shape (orders, revolutions), of a signal.

    The Fourier coefficients over windows of TRACK_REVOLUTIONS, every revolution.
    """
    window = boxcar(TRACK_REVOLUTIONS * per_revolution, sym=False)
    _, revolutions, amplitudes = _windows(signal, turn, per_revolution, window, per_revolution)
    return revolutions, amplitudes[np.asarray(orders, dtype=int) * TRACK_REVOLUTIONS]


def strongest_orders(signal: np.ndarray, turn: np.ndarray, per_revolution: int, count: int, highest: int) -> np.ndarray:
    """The whole engine orders, from 1 to `highest`, with the largest amplitude anywhere in the signal, ascending.

    `count` of them at most; those below a hundredth of the strongest are left out.
    """
    orders = np.arange(1, min(highest, per_revolution // 2) + 1)
    _, amplitudes = order_tracks(signal, turn, per_revolution, orders)
    largest = amplitudes.max(axis=1) if amplitudes.shape[1] else np.zeros(len(orders))
    chosen = np.argsort(-largest, kind="stable")[:count]
    return np.sort(orders[chosen[largest[chosen] >= 0.01 * largest.max()]])


def _windows(
    signal: np.ndarray, turn: np.ndarray, per_revolution: int, window: np.ndarray, hop: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    known = np.isfinite(signal)
    signal, turn = signal[known].astype(float), turn[known]
    transform = ShortTimeFFT(window, hop, fs=per_revolution, scale_to="magnitude")
    if len(signal) < len(window):
        return transform.f, np.empty(0), np.empty((len(transform.f), 0))
    # slices that touch neither border
    first, last = transform.lower_border_end[1], transform.upper_border_begin(len(signal))[1]
    amplitudes = np.abs(transform.stft(signal, p0=first, p1=last))
    amplitudes[1:] *= 2.0
    middles = turn[0] + transform.t(len(signal), p0=first, p1=last)
    return transform.f, middles, amplitudes
