"""Runs that more than one subject reads."""

from pathlib import Path

from evidence.configuration import settings_of
from evidence.plan import Run

BLADES = tuple(settings_of(Path()).blades)
SCENES = ("material_abradable", "direct")
"""Scenes to decide by: the lining on all of the tip, and the bare casing."""

MAIN = Run("")
"""The main job as shipped: `make all_blades` makes the same files."""

DECIDING = {
    "structure": {"kinematics": "quadratic", "boundary": {"contact": "patches"}},
    "scenes_file": "validation/deciding.yaml",
    "scenes": list(SCENES),
}
"""What a decision is made on: patches, large displacements, runs until they have settled, stress of rotation included."""

# the one set of runs: from rest every 2.5 rad/s; from rest, carried up and carried down every 5 rad/s, each as long
CARRIED = {"from_rad_s": 750, "to_rad_s": 2000, "step_rad_s": 5, "dwell": {"range_speeds": 0}}
ALL_SPEEDS = Run(
    "all_speeds", keys={**DECIDING, "speeds": [{"start": 750, "stop": 2000, "step": 2.5}], "second_motions": CARRIED}
)
