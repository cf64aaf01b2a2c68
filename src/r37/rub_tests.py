"""The call for a measured lining: contact length and moduli from a rub test."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from r37core.config import ConfigError
from r37studies.measured.rub_tests.lining_fit import LiningFit, fit_lining
from r37studies.measured.rub_tests.rig_table import read_rub_test

from .arguments import number
from .call_configuration import read_configuration
from .call_settings import chosen
from .choices import SceneChoice
from .stages import stages


@stages()
def lining_from_rub_test(
    table: Path | str | Mapping[str, Any],
    *,
    width_m: float | None = None,
    thickness_m: float | None = None,
    contact_length_m: float | None = None,
    scene: SceneChoice | str = "material_abradable",
    config: Path | str | None = None,
) -> LiningFit:
    """Contact length and moduli of an abradable lining from the forces of a rub rig, without a simulation.

    Args:
        table: CSV file, or columns by name: depth_mm, force_n (or other units); optionally thickness_mm, width_mm, speed_m_s,
            uncertainty_n. Points of one `test` follow one another at one place; else each point is a first contact.
        width_m, thickness_m: Width of the tool across the rub, thickness of the lining, where all points have the same (m).
        contact_length_m: Where known, moduli are fitted in place of a contact length for those of the scene.
        scene: Scene with the moduli that the contact length goes with.
        config: A config.yaml in place of the shipped one. It gives names, structure and levels.

    Returns:
        Best values, ranges, and `scene`, keys for scenes.yaml.

    Raises:
        ConfigError: For bad input.

    Examples:
        >>> rig = {"depth_um": [20, 50, 100, 150], "force_n": [6.5, 15.4, 32.1, 47.8]}
        >>> fit = r37.lining_from_rub_test(rig, width_m=0.01, thickness_m=0.002)
        >>> f"{1e3 * fit.contact_length.best:.3f} mm"
        '0.016 mm'
    """
    arguments = {"width": width_m, "thickness": thickness_m, "contact_length": contact_length_m}
    lengths = {name: number(value, f"{name}_m", "m") for name, value in arguments.items() if value is not None}
    for name, value in lengths.items():
        if not 0.0 < value <= 1.0:
            raise ConfigError(f"{name}_m: found {value}; allowed: more than 0, at most 1")
    lining = chosen(SceneChoice, scene, read_configuration(config)).entry.scene().lining
    if lining is None or lining.published:
        raise ConfigError("scene: found one without a contact length of its lining; allowed: such as material_abradable")
    contact_length = lengths.pop("contact_length", None)
    return fit_lining(read_rub_test(table, lengths), lining, contact_length)
