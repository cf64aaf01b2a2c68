"""Remarks on lobes in runs with tolerances and other studies."""

import pytest
import yaml
from test_lining import SAID, SPREAD, SPREAD_COLD

from r37core.config import command_line_document
from r37core.product.extensions import read_settings
from r37core.product.remarks import remarks as remarks_of_run


@pytest.mark.parametrize(
    ("config", "scenes", "named"),
    [
        ({}, {}, None),
        ({"tolerances": {"members": 2, "of_scenes": SPREAD}}, {}, "abradable, direct"),
        ({"tolerances": {"members": 2, "of_scenes": {"friction.coefficient": {"uniform_percent": 5}}}}, {}, None),
        ({"tolerances": {"members": 2, "of_scenes": SPREAD_COLD}, "scenes": ["growing_direct"]}, {}, "growing_direct"),
        ({"tolerances": {"members": 2, "of_scenes": SPREAD}}, {"direct": {"lobes": 0}}, "abradable"),
        ({}, {"direct": {"clearance_m": 4e-4}}, "abradable, direct"),
        ({"scenes": ["direct"]}, {"direct": {"clearance_m": 4e-4}}, None),
    ],
)
def test_lobes_that_scale_are_remarked_on_once(config_copy, config, scenes, named):
    run = {"blades": ["Ref"], "scenes": ["abradable", "direct"], **config}
    for in_metres in (False, True):
        height = {"amplitude_m": 7.12e-4} if in_metres else {"amplitude_clearances": 2.0}
        file = config_copy / "config/scenes.yaml"
        entries = yaml.safe_load(file.read_text())
        for name, entry in entries.items():
            casing = entry.setdefault("casing", {})
            for key in ("amplitude_m", "amplitude_clearances"):
                casing.pop(key, None)
            casing |= height | (scenes.get(name, {}))
        file.write_text(yaml.safe_dump(entries))
        remarks = [one for one in remarks_of_run(read_settings(config_copy, command_line_document(run))) if "lobes" in one]
        expected = [] if in_metres or named is None else [f"scene {named}: {SAID}"]
        assert [one[: len(expected[0])] if expected else one for one in remarks] == expected


def test_shipped_runs_hold_the_height(root):
    for name in ("tolerances", "ranking", "clearance"):
        changes = yaml.safe_load((root / f"config/{name}.yaml").read_text())
        assert not [one for one in remarks_of_run(read_settings(root, command_line_document(changes))) if "lobes" in one]
