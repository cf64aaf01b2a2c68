"""Waves that run round an elastic casing, of the samples of its modes."""

from __future__ import annotations

import numpy as np

from r37core.contact.ring import RingMotion


def casing_waves(
    samples: np.ndarray, ring: RingMotion, speed: float, revolutions: int, highest_order: int
) -> dict[str, np.ndarray]:
    """Spectrum, level and energy of each of the casing's modes in the frame that does not turn.

    `samples` (m) of q_c, then q_s, of all modes at their antinodes, in the rotor's frame, shape (samples, 2 modes), over whole
    `revolutions` at a `speed` (rad/s). A mode moves by Re(Z e^(i n theta)), Z = q_c - i q_s. The part A e^(i omega t) of Z is a
    wave that runs with the rotor, towards negative theta, where omega > 0, else against it. Returned, with the modes first:
    `casing_amplitude` (m), |A| over the signed `casing_order` omega/Omega; `casing_rms_forward` and `casing_rms_backward` (m),
    over time and circumference; `casing_energy` (J), kinetic and elastic, mean over the time:
    m/2 sum of (omega^2 + omega_n^2) |A|^2 of the modal mass m. A mode without nodal diameters runs nowhere: all of it counts as
    forward. Orders are kept up to the blade's `highest_order` and, as the casing sees these, the nodal diameters more. NaN
    among the samples stays NaN; so is a mode that is too fast for them.
    """
    count, modes = len(samples), len(ring.modes)
    nodal_diameters, own, size = ring.nodal_diameters, ring.frequencies[:modes], ring.size[:modes]
    turn = 2.0 * np.pi * revolutions * np.arange(1, count + 1) / count
    too_fast = own / speed + nodal_diameters > 0.5 * count / revolutions
    waves = (samples[:, :modes] - 1j * samples[:, modes:]).T * np.exp(1j * np.outer(nodal_diameters, turn))
    amplitudes = np.abs(np.fft.fft(np.where(too_fast[:, None], np.nan, waves))) / count
    orders = np.rint(np.fft.fftfreq(count, 1.0 / count)) / revolutions
    squares = amplitudes**2
    energy = 0.5 * np.sum(((orders * speed) ** 2 + own[:, None] ** 2) * squares, axis=1) / size**2
    forward, backward = (0.5 * squares[:, wave].sum(axis=1) for wave in (orders > 0.0, orders < 0.0))
    # Z of a mode without nodal diameters is real, or imaginary: both halves move together
    runs = nodal_diameters > 0
    forward, backward = np.where(runs, forward, 2.0 * (forward + backward)), runs * backward
    ascending = np.argsort(orders)
    shown = ascending[np.abs(orders[ascending]) <= highest_order + nodal_diameters.max()]
    return {
        "casing_nodal_diameter": nodal_diameters,
        "casing_frequency": own / 2.0 / np.pi,
        "casing_order": orders[shown],
        "casing_amplitude": amplitudes[:, shown].astype(np.float32),
        "casing_rms_forward": np.sqrt(forward),
        "casing_rms_backward": np.sqrt(backward),
        "casing_energy": energy,
    }
