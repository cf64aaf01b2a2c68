"""What no model of the section alone can check of rotors."""

from __future__ import annotations

from r37core.config import Settings

from .plan import rotor_scenes


def run_ups_have_single_blades(settings: Settings) -> None:
    """No run-up is wanted of a scene with a rotor."""
    rotors = rotor_scenes(settings)
    for name, entry in getattr(settings.config, "run_ups", {}).items():
        for scene in rotors if entry.scenes == "all" else [scene for scene in entry.scenes if scene in rotors]:
            raise settings.documents.config.refusal(
                ("run_ups", name, "scenes"),
                f"'{scene}', which has a rotor",
                "scenes of a single blade; the speed of a rotor does not change while it runs",
            )
