"""Designs that one figure compares."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from r37core.base.varied_number import BLADE, SCENE

if TYPE_CHECKING:
    # the workflow imports it before it needs tables
    import pandas as pd

BOTH = "both"
"""Kind of designs of which blade and scene vary."""


@dataclass(frozen=True)
class Compared:
    """Designs that one figure compares: over `keys`, columns of designs.csv, of these `blades` in these `scenes`.

    `kind`: of the family, BLADE or SCENE, a column, too; BOTH where a family of blades meets one of scenes.
    """

    kind: str
    keys: tuple[str, ...]
    blades: tuple[str, ...]
    scenes: tuple[str, ...]

    def rows(self, table: "pd.DataFrame") -> "pd.DataFrame":
        """Rows of a table of these blades and scenes."""
        return table[table["blade"].isin(self.blades) & table["scene"].isin(self.scenes)]

    @property
    def other(self) -> str:
        """Kind that does not vary, a line or a panel each; empty where both do."""
        return {BLADE: SCENE, SCENE: BLADE}.get(self.kind, "")


def axis_of_key(key: str) -> tuple[str, float]:
    """Label of the axis of a key, in words, and what a unit there is in the key's, inverted: lengths in mm."""
    words = key.removeprefix("scene.").removesuffix("_m").replace(".", ", ").replace("_", " ")
    return (f"{words} (mm)", 1e3) if key.endswith("_m") else (words, 1.0)
