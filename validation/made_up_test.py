"""The made-up test of examples/fan: a hidden scene's responses with noise, and the same on a casing that vibrates.

`python validation/made_up_test.py` writes examples/fan/tip_test.csv and examples/fan/tip_test_flexible.csv.
"""

from pathlib import Path

import numpy as np

import r37

FAN = Path("examples/fan")
SPEEDS_RPM = [*range(10400, 13800, 300)]
HIDDEN = {"lining": {"contact_length_m": 3.0e-4}, "friction": {"coefficient": 0.2}, "damping_ratio": 1.0e-3}
"""Not in any file that a user reads first: a calibration has to find it."""

NOISE = 0.05


def test_of(scene: str, seed: int) -> str:
    """Text of a file with tangential amplitude and worn depth over speed, each with noise."""
    hidden = r37.scene(scene, file=FAN / "scenes.yaml", name="hidden", **HIDDEN)
    blade = r37.blade("Fan", file=FAN / "blades.yaml")
    response = r37.sweep(blade, hidden, speeds_rpm=SPEEDS_RPM).sel(tip_point="leading_edge")
    noise = 1.0 + NOISE * np.random.default_rng(seed).standard_normal((2, len(SPEEDS_RPM)))
    columns = 1e6 * noise * [response["rms_tangential"].values, response["max_wear"].values]
    rows = zip(SPEEDS_RPM, *columns.round(1).tolist(), strict=True)
    header = (
        "# A made-up test: simulated with hidden values of the scene, and noise of 5%.\nspeed_rpm,amplitude (um),worn (um)\n"
    )
    return header + "".join(f"{speed},{amplitude},{worn}\n" for speed, amplitude, worn in rows)


def main() -> None:
    """Write both files."""
    for scene, file, seed in (("Tested", "tip_test.csv", 1), ("TestedFlexible", "tip_test_flexible.csv", 2)):
        (FAN / file).write_text(test_of(scene, seed), encoding="utf-8")


if __name__ == "__main__":
    main()
