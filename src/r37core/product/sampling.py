"""Members of samples that the wings have run beside the sweep."""

from __future__ import annotations

from pathlib import Path

from r37core.config import Settings
from r37core.plans.samples import Beside, Sampling

from .wings import WINGS


def beside(settings: Settings, results: Path | None = None) -> Beside:
    """Samples of each wing that has some, by the folder of its results; `results`: in place of the workflow's."""
    return Beside(
        {wing.name: dict(wing.sampling.samples(settings)) for wing in WINGS if wing.sampling},
        later={wing.name: wing.later(settings, results or settings.results) for wing in WINGS if wing.later},
    )


def sampling_of(settings: Settings) -> Sampling | None:
    """That of the wing of which this run has members; none where it has none. Tables have ranges of one wing's members."""
    return next((wing.sampling for wing in WINGS if wing.sampling and wing.sampling.samples(settings)), None)
