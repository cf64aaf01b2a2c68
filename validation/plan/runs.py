"""Runs that more than one subject reads."""

from pathlib import Path

from evidence.configuration import settings_of
from evidence.plan import Run

BLADES = tuple(settings_of(Path()).blades)
SCENES = ("material_abradable", "direct")
"""Scenes to decide by: the lining on all of the tip, and the bare casing."""

MAIN = Run("")
"""The main job as shipped: `make all_blades` makes the same files."""

ALL_SPEEDS = Run("which_blade", ("which_blade",), {"second_motions": None}, priority=4)
"""The one set of runs: from rest every 2.5 rad/s. Motions carried from other speeds would cost as much again."""

DECIDING = {key: ALL_SPEEDS.content[key] for key in ("structure", "scenes_file", "scenes")}
"""What a decision is made on: patches, large displacements, runs until they have settled, stress of rotation included."""
