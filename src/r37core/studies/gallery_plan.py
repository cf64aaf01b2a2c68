"""The plan of the gallery: a few runs beside the sweep, and docs/gallery.md of all."""

from __future__ import annotations

from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from r37core.config import ConfigError
from r37core.plans import paths
from r37core.plans.sweep_plan import Sweep
from r37core.published import BLADES, REFERENCE

from .gallery import COARSE, ITEMS

PAGE = "docs/gallery.md"
FOLDER = "docs/gallery"
_DATASETS = ("campbell", "rms", "spectrum", "stress", "wear")


class Gallery:
    """Plan of the gallery. Methods with `wildcards` are inputs and parameters of rules."""

    def __init__(self, sweep: Sweep):
        self._sweep, self._settings = sweep, sweep.settings
        section = self._settings.studies.readings
        self.scenes = {"lined": section.lined_scene, "direct": section.direct_scene}
        self.pictures = [f"{FOLDER}/{item.name}.png" for item in ITEMS]

    @property
    def runs(self) -> list[tuple[str, str]]:
        """Blade and kind of scene of every run beside the sweep."""
        return [(blade, "lined") for blade in BLADES] + [(REFERENCE, "direct")]

    def inputs(self, wildcards: Any) -> dict[str, Any]:
        """What the page is made of; ConfigError for a sweep without the benchmark's blades and scenes."""
        self._check()
        histories = [paths.fill(paths.GALLERY_RUN, blade=blade, scene=self.scenes[kind]) for blade, kind in self.runs]
        return {
            **{kind: f"<results>/{kind}.nc" for kind in _DATASETS},
            "geometry": paths.fill(paths.GEOMETRY, blade=REFERENCE),
            "meshes": [paths.fill(paths.MESH, blade=blade) for blade in BLADES],
            "modes": paths.fill(paths.EXPORTED_MODES, blade=REFERENCE),
            "histories": histories,
        }

    def choice(self, wildcards: Any) -> dict[str, Any]:
        """Numbers of the time integration: the sweep's, with as many instants a revolution as the paper takes."""
        highest = self._settings.structure.maximum_speed_rad_s
        chosen = self._settings.integration_choice(wildcards.blade, wildcards.scene, highest)
        return asdict(replace(chosen, snapshots_per_revolution=COARSE, snapshot_revolutions=1))

    def lined(self, wildcards: Any) -> bool:
        """Whether a run is one with lining."""
        return wildcards.scene == self.scenes["lined"]

    def submesh(self, wildcards: Any) -> Any:
        """Where stress is recovered on the reference blade."""
        self._check()
        return self._settings.reduction_choice(blade=REFERENCE).stress_submesh

    def yield_stress(self, wildcards: Any) -> float:
        """Of the reference blade (Pa)."""
        self._check()
        material = self._settings.blades[REFERENCE].material
        assert material is not None
        return float(material.yield_stress)

    def _check(self) -> None:
        lacking = [blade for blade in BLADES if blade not in self._settings.blades]
        lacking += [scene for scene in self.scenes.values() if scene not in self._settings.scenes]
        if lacking:
            raise ConfigError(
                f"config.yaml: blades, scenes: the gallery needs {', '.join(lacking)}, which this run leaves out; "
                f"allowed: at least {', '.join(BLADES)} in {' and '.join(self.scenes.values())}"
            )
        for name, scene in self.scenes.items():
            wanted = {"spectrum", "stress", *(["wear"] if name == "lined" else [])}
            if missing := wanted - set(self._settings.scenes[scene].results):
                raise ConfigError(f"scenes.yaml: {scene}.results: the gallery needs {', '.join(sorted(missing))}, too")


def modes_file(folder: Path | str) -> Path:
    """The modes at rest in a folder of exported modes."""
    return Path(folder) / "modes_0.vtu"
