"""Whether the first frequency of matrices is one of a blade: a wrong unit makes it 32 times as high or as low."""

from __future__ import annotations

import warnings

import numpy as np

from r37core.exchange.refusal import ImportRefused, MeshWarning
from r37core.rom.reduced_model import ReducedModel

_USUAL = (2.0, 500.0)
"""First frequency times the chord of the tip (m/s).

A cantilever of length L and thickness h has about h c / 6 L**2 (c: speed of sound in a bar, 5000 m/s): from 2 m/s, of a thin
blade of fifteen chords, to 500 m/s, of a thick one of half a chord.
"""

_POSSIBLE = (0.02, 50e3)
"""A hundred times less and more."""


def in_words(model: ReducedModel) -> str:
    """The first frequency, for who imports matrices to see."""
    return f"the first frequency at rest is {_first_frequency(model):.4g} Hz"


def check_frequency(model: ReducedModel, chord: float) -> None:
    """Raise ImportRefused for a first frequency that no blade with this `chord` of its tip (m) has, warn of an unusual one.

    One contact node has no chord, and is not judged.
    """
    frequency = _first_frequency(model)
    if not chord > 0.0 or _USUAL[0] <= frequency * chord <= _USUAL[1]:
        return
    text = (
        f"{in_words(model)}, with a tip of {1e3 * chord:.3g} mm; blades of that size have {_USUAL[0] / chord:.2g} to "
        f"{_USUAL[1] / chord:.2g} Hz: look at mass_unit, stiffness_unit and length_unit"
    )
    if not _POSSIBLE[0] <= frequency * chord <= _POSSIBLE[1]:
        raise ImportRefused(text)
    warnings.warn(text, MeshWarning, stacklevel=2)


def _first_frequency(model: ReducedModel) -> float:
    """In Hz."""
    return float(model.modes(0.0, 1)[0][0]) / (2.0 * np.pi)
