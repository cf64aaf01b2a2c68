"""Steps of the workflow (docs/architecture.md): runs at measured speeds, the comparison, and a calibration."""

import hashlib
import json
import math
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from r37core.base.dataset_file import write_dataset
from r37core.base.io import JOB_NEWS, Named, as_list, read_json, write_json, write_text
from r37core.base.origin import origin
from r37core.base.plain import from_plain, to_plain
from r37core.base.varied_number import KINDS
from r37core.contact.scene import Scene
from r37core.results.table_file import write_table
from r37core.sweep.forks import forked_results
from r37core.time_integration.integration_choice import IntegrationChoice

from .calibration import Calibration
from .calibration_plan import Calibrated
from .evaluation import observed_blade, simulate
from .measurement_plan import Measured
from .points import VALUES, Measurement
from .posterior import calibrated_scenes, calibration_dataset, is_range, number_table

_SLIGHTLY_MORE = 1.001
"""Factor of friction that shows by chance how much a value changes."""


def observe(input: Any, output: Any, params: Any) -> None:
    """Run a blade in a scene at the measured speeds, also with 0.1% more friction. Output: observed (json).

    Inputs: model, and rom, mesh and whole where they are needed. Params: scene, choice, measurements, tip_line.
    """
    measurements = from_plain(dict[str, Measurement], params.measurements)
    scene, choice = from_plain(Scene, params.scene), from_plain(IntegrationChoice, params.choice)
    blade = observed_blade(input, measurements, choice, params.tip_line, Path(output.observed).parent / "observed")
    others = blade.simulated(scene.scaled_friction(_SLIGHTLY_MORE) or scene)
    numbers = {}
    for (name, values, remark), (_, other, _) in zip(blade.simulated(scene), others, strict=True):
        with np.errstate(invalid="ignore"):
            known = {"values": values, "scatter": np.abs(other - values)}
        finite = {key: [each if math.isfinite(each) else None for each in part.tolist()] for key, part in known.items()}
        numbers[name] = finite | {"remark": remark}
    write_json(numbers, output.observed)


def compare(input: Any, output: Any, params: Any) -> None:
    """List all measured points beside the simulation. Inputs: observed, of each blade and scene. Output: table (csv).

    Params: measurements; errors, relative, of each of the pairs.
    """
    simulated = {name: numbers for file in as_list(input.observed) for name, numbers in read_json(file).items()}
    errors = dict(zip(map(tuple, params.pairs), params.errors, strict=True))
    write_table(compared(from_plain(dict[str, Measurement], params.measurements), simulated, errors), output.table, digits=6)


def compared(
    measurements: Mapping[str, Measurement], simulated: Mapping[str, Mapping[str, Any]], errors: Mapping[tuple[str, str], float]
) -> pd.DataFrame:
    """Table measured.csv: a row for each point of all measurements.

    `simulated`: of each measurement `values` at its points, None where a run diverged, `scatter` of these by a small change of
    friction, and a `remark`. `errors`: relative error by mesh and step of each blade and scene, NaN where it is not known.
    """
    rows = [_rows(name, each, simulated[name], errors[each.blade, each.scene]) for name, each in measurements.items()]
    return pd.concat(rows, ignore_index=True)


def _rows(name: str, measurement: Measurement, simulated: Mapping[str, Any], error: float) -> pd.DataFrame:
    points, known = measurement.points, np.array([value is not None for value in simulated["values"]])
    values, scatter = (np.nan_to_num(np.array(simulated[name], float)) for name in ("values", "scatter"))
    # the level's error is one of amplitudes, not of speeds
    share = np.nan_to_num(error) if measurement.speed_of == VALUES else 0.0
    uncertainty = np.where(known, np.hypot(share * values, scatter), 0.0)
    values = np.where(known, values, math.inf)
    both = np.hypot(points.deviations, uncertainty)
    return pd.DataFrame(
        {
            "measurement": name,
            "blade": measurement.blade,
            "scene": measurement.scene,
            "quantity": measurement.title,
            "file": measurement.file,
            "speed_rad_s": points.speeds,
            "angle_deg": np.degrees(points.angles) if points.angles else np.nan,
            "engine_order": [order or None for order in points.orders],
            "measured": points.values,
            "measured_uncertainty": points.deviations,
            "simulated": values,
            "simulated_uncertainty": uncertainty,
            "unit": measurement.unit,
            "difference_over_uncertainty": (values - np.array(points.values)) / both,
            "remark": simulated["remark"],
        }
    )


def calibrate(input: Any, output: Any, params: Any) -> None:
    """Fit numbers to measurements, round by round. Outputs: dataset (nc), table (csv), folder.

    Inputs: lists of files, of each blade and scene. Params: carried (the settings), cores.
    """
    settings, folder = params.carried.settings, Path(output.folder).parent
    calibrated, measured = settings.made(Calibrated), settings.made(Measured)
    run_all = partial(forked_results, params.cores)
    # inputs are lists of files, of each blade and scene
    columns = {name: as_list(files) for name, files in input.items() if name != "prepared"}
    blades = {}
    for pair, *files in zip(measured.pairs, *columns.values(), strict=True):
        choice, tip_line = settings.integration_choice(*pair), settings.scenes[pair[1]].tip_line
        named, own = Named(**dict(zip(columns, files, strict=True))), measured.pair_measurements(pair)
        blades[pair] = observed_blade(named, own, choice, tip_line, folder)
    every = {name: each for blade in blades.values() for name, each in blade.measurements.items()}
    calibration = Calibration(every, calibrated.spreads, calibrated.nominal, calibrated.section.seed, run_all)
    calibration.run(calibrated.budget, partial(simulate, settings, blades, folder, run_all), JOB_NEWS.info)
    designs = json.dumps(to_plain([calibration.cube, [part.tolist() for part in calibration.simulated]]))
    digest = hashlib.sha256(designs.encode()).hexdigest()[:32]
    dataset = calibration_dataset(calibration, calibrated.section.draws)
    made = {"fidelity": settings.fidelity_name, "input_hash": digest}
    write_dataset(dataset, output.dataset, made | origin("Numbers fitted to measurements"))
    write_table(number_table(dataset), output.table, digits=6)
    results = Path(output.folder)
    results.mkdir(parents=True)
    draws = pd.DataFrame(dataset["value"].values, columns=dataset["number"].values)
    # others are of the test and no keys
    kept = [number for number in calibrated.spreads if number.kind in KINDS and not is_range(dataset, number)]
    draws = draws[[number.name for number in kept]]
    write_table(draws, results / "members.csv", digits=9)
    write_text(calibrated_scenes(settings, dataset, [scene for _, scene in measured.pairs]), results / "calibrated_scenes.yaml")
