"""What a run says of its time signals when it ends."""

from __future__ import annotations

from pathlib import Path

from r37core.dataset_file import read_dataset
from r37core.results.closing import counted


def closing(results: Path) -> str:
    """How many signals there are, and of which speeds."""
    signals = read_dataset(results / "signals.nc")
    if not signals.sizes.get("run"):
        return "no signal, for no interaction was found"
    ends = dict.fromkeys(f"{speed:.6g}" for speed in (signals["speed"].values.min(), signals["speed"].values.max()))
    return f"{counted(signals.sizes['run'], 'signal')} at {' to '.join(ends)} rad/s"
