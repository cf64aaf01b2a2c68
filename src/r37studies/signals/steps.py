"""Steps of the workflow (docs/architecture.md): time signals of single runs."""

from typing import Any

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.plain import from_plain
from r37core.mesh.mesh_files import read_vtu
from r37core.results.interactions import InteractionChoice, find_interactions, titles
from r37core.results.regions import read_judged
from r37core.rom.rom_file import read_reduced_model
from r37core.stress.gauge import Gauge
from r37studies.blade_runs import BladeRuns
from r37studies.gauges import gauge_rows

from .dataset import signals_dataset
from .record import record_signals


def record(input: Any, output: Any, params: Any) -> None:
    """Record signals. Inputs: model, rom, and mesh, whole, campbell, response if needed. Output: signals (nc).

    Params: scene, choice, speeds, interactions, revolutions, gauges, probes, tip_line, provenance.
    """
    named: dict[float, str] = {}
    rows: Any = []
    positions: dict[str, Any] = {}
    if hasattr(input, "response"):
        wanted = from_plain(InteractionChoice, params.interactions)
        named = titles(find_interactions(read_judged(input.response), read_dataset(input.campbell), wanted))
    if params.gauges:
        mesh, gauges = read_vtu(input.mesh), from_plain(list[Gauge], list(params.gauges.values()))
        whole = read_reduced_model(input.whole).whole_blade
        assert whole is not None
        rows, places = gauge_rows(mesh, whole.basis, gauges)
        positions = dict(zip(params.gauges, places, strict=True))
    blade = BladeRuns.read(input, params)
    speeds = params.speeds or sorted(named)
    records = {speed: record_signals(blade, speed, rows, params.revolutions) for speed in speeds}
    tip = read_reduced_model(input.rom).tip_lines[params.tip_line]
    write_dataset(signals_dataset(records, named, positions, params.probes, tip), output.signals, params.provenance)
