"""Time signals as an extension."""

from __future__ import annotations

from r37core.config import Settings
from r37core.config.cross_checks import slow_run_can_be_done
from r37core.config.speed_choice import length_of_run
from r37core.plans.extension import Extension

from .plan import simulated, targets
from .section import SECTION


def signals_have_runs(settings: Settings) -> None:
    """Signals are wanted of blades that are there and of some scene, and are no longer than its runs."""
    wanted, documents = settings.section(SECTION), settings.documents
    if wanted.blades != "all":
        documents.known(("signals", "blades"), wanted.blades, settings.designs.entries, documents.blades)
    speeds, key = wanted.speeds(), ("signals", wanted.key_of_speeds)
    if speeds is None:
        return
    if isinstance(speeds, list):
        for name in settings.scenes:
            slow_run_can_be_done(length_of_run(settings, name, speeds[0]), settings, key)
    signal_runs = {name: scene for name, scene in settings.scenes.items() if "signal" in scene.results}
    if not signal_runs:
        raise documents.config.refusal(
            key,
            "speeds, though no scene that is run has signal among its results",
            f"such a scene ({', '.join(settings.scenes)} of {documents.scenes.name} are run), or no speeds",
        )
    for name, scene in signal_runs.items():
        if wanted.revolutions is not None and wanted.revolutions > scene.revolutions:
            allowed = f"at most those of a run, {scene.revolutions} in '{name}'"
            raise documents.config.refusal(("signals", "revolutions"), f"{wanted.revolutions}", allowed)


_CAPTIONS = {
    "spectrogram": (
        "Blade {blade} in scene {scene}: engine orders of the leading edge's motion and of strain gauges over the revolutions "
        "since the start, at each speed; Hann windows of eight revolutions."
    ),
    "orders": (
        "Blade {blade} in scene {scene}: amplitude of the strongest whole engine orders over the revolutions since the "
        "start, at each speed. Beside them, where there are probes: the leading edge's displacement that tip timing tells."
    ),
}
"""Kind of figure -> what is seen in it."""

EXTENSION = Extension(
    name="signals",
    section=SECTION,
    checks=(signals_have_runs,),
    simulated=simulated,
    targets=targets,
    captions=_CAPTIONS,
    closing="signals.dataset.closing",
)
