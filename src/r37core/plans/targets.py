"""What the rule all_blades makes where the configuration asks for it: one list, for the rule and for what is left over."""

from __future__ import annotations

from . import paths
from .paths import Wildcards, of, of_runs
from .run_up_plan import RunUps
from .signal_plan import Signals
from .sweep_plan import KINDS, MAPS, Sweep


def targets(sweep: Sweep, recorded: Signals) -> dict[str, Wildcards]:
    """Pattern of files -> wildcards of each that is asked for; none where a configuration does without."""
    settings = sweep.settings
    blades, scenes, families = of("blade", settings.blades), of("scene", settings.scenes), of("family", settings.families)
    shown, signals, spectra = (
        of_runs(runs) for runs in (sweep.runs_with("shapes"), recorded.runs, sweep.runs_with("spectrum"))
    )
    ranked: Wildcards = [{}] if "stress" in sweep.kinds else []
    climbing = RunUps(sweep)
    climbed = of_runs(climbing.pairs)
    of_shapes = of("blade", dict.fromkeys(run["blade"] for run in shown))
    growing = [name for name, chosen in settings.scenes.items() if chosen.scene.casing.changes_with_speed]
    pictures = {
        "campbell_{blade}": blades,
        "response_{blade}": blades,
        **{f"{kind}_{{blade}}__{{scene}}": of_runs(sweep.runs_with(kind)) for kind in MAPS},
        "waterfall_{blade}__{scene}": spectra,
        "comparison_{scene}": scenes,
        "ranking": ranked,
        "clearance_{scene}": of("scene", growing),
        "designs_{family}": families,
        "spectrogram_{blade}__{scene}": signals,
        "orders_{blade}__{scene}": signals,
        "shapes_{blade}": of_shapes,
        "shapes_{blade}__{scene}": shown,
        "run_ups_{blade}__{scene}": climbed,
        "tolerances_{blade}__{scene}": of_runs(settings.members.pairs),
        "run_up_rates_{scene}": of("scene", dict.fromkeys(run["scene"] for run in climbed)),
    }
    return {
        **{f"<results>/{kind}.nc": [{}] if kind in sweep.kinds else [] for kind in KINDS},
        "<results>/designs.csv": families and [{}],
        "<results>/ranking.csv": [{}],
        "<results>/coincidences.csv": [{}] if sweep.casings else [],
        "<results>/signals.nc": signals and [{}],
        **{f"<results>/{name}": climbed and [{}] for name in ("run_ups.nc", "run_ups.csv", "run_up_rates.csv")},
        **{f"<results>/{name}": [{}] if settings.members.pairs else [] for name in ("tolerances.nc", "tolerances.csv")},
        paths.RUN_UP: climbing.files,
        "<results>/{blade}/{scene}/signals.nc": signals,
        "<results>/shapes/{blade}.html": of_shapes,
        **{f"<results>/figures/{name}.{suffix}": found for name, found in pictures.items() for suffix in ("png", "pdf")},
    }
