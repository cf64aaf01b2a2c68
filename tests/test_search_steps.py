"""The plan of a search, and its steps from files to files, as the workflow runs them."""

import math

import numpy as np
import pandas as pd
import pytest
import xarray as xr
import yaml
from overlays import overlay
from test_search import BLADES, SEARCH, START, choice, gave, searched, structure

from r37core.base.dataset_file import read_dataset, write_dataset
from r37core.base.io import Named, read_json, write_json
from r37core.base.plain import to_plain
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import beside
from r37core.product.reading import read_settings
from r37core.search import steps
from r37core.search.dataset import search_dataset
from r37core.search.plan import Search, designs_of, remarks
from r37core.search.quantity import Quantity
from r37core.search.rounds import SearchRound, first_round, read_round, write_round
from r37core.stress.operator import StressOperator


def test_a_round_is_made_of_the_one_before_it_and_what_its_designs_gave(tmp_path):
    def propose(number, count, **inputs):
        file = tmp_path / f"round_{number}.json"
        steps.propose_round(Named(**inputs), Named(round=file), Named(choice=to_plain(choice()), round=number, number=count))
        return read_round(file)

    first = propose(0, 3)
    assert first == first_round(3, choice())
    for name in first.new:
        write_json({"refused": "crossed" if name == "d0001" else None}, tmp_path / name / "shape.json")
    shapes = [tmp_path / name / "shape.json" for name in first.new]
    steps.built(Named(shapes=shapes), Named(built=tmp_path / "built.json"), Named())
    assert read_json(tmp_path / "built.json") == {"d0001": "crossed"}
    unknown = {"lined": (None, None), "mass": (2.0, 0.0)}
    for name, measures in (("start", START), ("d0000", gave(first.new["d0000"])), ("d0002", unknown)):
        write_json(measures, tmp_path / name / "measures.json")
    files = {"before": tmp_path / "round_0.json", "built": tmp_path / "built.json", "start": tmp_path / "start/measures.json"}
    second = propose(1, 2, **files, measures=[tmp_path / name / "measures.json" for name in ("d0000", "d0002")])
    assert second == searched(choice(), (3, 2))[-1]


def test_all_designs_are_joined_and_the_best_written(tmp_path, monkeypatch):
    last = searched(choice())[-1]
    write_round(last, tmp_path / "round_3.json")
    dataset, table, best = (tmp_path / name for name in ("search.nc", "search.csv", "best"))
    params = Named(choice=to_plain(choice()), fidelity="draft")
    steps.join(Named(round=tmp_path / "round_3.json"), Named(dataset=dataset, table=table), params)
    search = read_dataset(dataset)
    xr.testing.assert_equal(search, search_dataset(last, choice()))
    assert search.attrs["fidelity"] == "draft" and len(search.attrs["input_hash"]) > 8
    rows = pd.read_csv(table, index_col="design")
    assert list(rows.index) == ["start", *last.tried] and rows.loc["d0001", "refused"] == "crossed"
    first, second = rows[rows["order"] > 0].sort_values("order").index[:2]

    monkeypatch.setattr(steps, "read_geometry", lambda file: file)
    monkeypatch.setattr(steps, "write_step", lambda shape, file: file.write_text(shape))
    entries = {"Ref": {"density": 1.0}, "Free": {"base": "Ref", "sweep_lean": [{"sweep_cm": 0.0}, {"sweep_cm": 0.0}]}}
    shapes = [f"search/{name}/Free/geometry.nc" for name in last.tried]
    steps.best(Named(dataset=dataset, shapes=shapes), Named(folder=best), Named(entries=entries, scenes={}, number=2))
    assert {file.name for file in best.iterdir()} == {"blades.yaml", "Free_best1.step", "Free_best2.step"}
    for name, place in ((first, 1), (second, 2)):
        assert (best / f"Free_best{place}.step").read_text() == f"search/{name}/Free/geometry.nc"
    text = (best / "blades.yaml").read_text()
    assert "blades='[Free, Free_best1, Free_best2]'" in text
    written = yaml.safe_load(text)
    assert list(written) == ["Ref", "Free", "Free_best1", "Free_best2"]
    tip, sweep = last.tried[first].values
    rows = [{"sweep_cm": 0.0}, {"sweep_cm": sweep}]
    assert written["Free_best1"] == {"base": "Ref", "sweep_lean": rows, "stagger_deg": {"tip": tip}}
    assert f"# {first}: lined {last.tried[first].quantities['lined'][0]:.4g} rad s-1; the start: lined 40 rad s-1" in text


def test_a_design_is_measured_by_its_structure_and_by_all_its_runs(tmp_path, monkeypatch):
    """The stress by rotation alone grows with the square of the speed where nothing stiffens; `b` has a diverged run."""
    lengths = {"a": 3.0, "a/0": 4.0, "a/1": 8.0, "b": math.nan}
    files = {name: str(tmp_path / f"{name.replace('/', '_')}.nc") for name in ("geometry", "campbell", *lengths)}
    write_dataset(xr.Dataset({"volume": 2.0}), files["geometry"])
    write_dataset(structure().campbell, files["campbell"])
    for name, length in lengths.items():
        write_dataset(xr.Dataset({"length": length}), files[name])

    def robustness(response, chance_scatter=True, operating=None):
        scatter = {"length_certain_scatter_rad_s": 0.5} if chance_scatter else {}
        return {"length_certain_rad_s": float(response["length"]), **scatter}

    operator = np.zeros((6, 1, 2))
    operator[0, 0] = 7.0, 1.0
    monkeypatch.setattr(steps, "robustness", robustness)
    monkeypatch.setattr(steps, "read_contact_model", lambda file: Named(rotation_stiffening=np.zeros(1)))
    monkeypatch.setattr(steps, "read_stress_operator", lambda file: StressOperator(operator, 1, ""))
    quantities = {
        "nominal": Quantity("length_certain_rad_s", ("a",)),
        "high": Quantity("length_certain_rad_s", ("a",), quantile=1.0),
        "lost": Quantity("length_certain_rad_s", ("b",)),
        "mass": Quantity("mass_kg"),
        "still": Quantity("static_stress_pa"),
        "slow": Quantity("static_stress_pa", speed=500.0),
        "flap": Quantity("frequency_hz", mode="1B", speed=500.0),
    }
    inputs = {name: files[name] for name in ("geometry", "campbell")} | {"responses": [files[name] for name in lengths]}
    params = {
        "quantities": to_plain(quantities),
        "scenes": {"a": 3, "b": 1},
        "density": 8000.0,
        "highest_speed": 1000.0,
        "operating": None,
    }
    steps.measure(Named(**inputs, contact="", stress=""), Named(measures=tmp_path / "measures.json"), Named(**params))
    measured = read_json(tmp_path / "measures.json")
    assert measured.pop("high") == [8.0, pytest.approx(math.sqrt(3.0), abs=0.2)]
    assert measured == {
        "nominal": [3.0, 0.5], "lost": [None, 0.5], "mass": [16000.0, 0.0], "still": [1e6, 0.0], "slow": [2.5e5, 0.0],
        "flap": [120.0, 0.0],
    }  # fmt: skip


def test_the_plan_asks_for_what_the_designs_of_a_round_need(config_copy, monkeypatch):
    """The second design cannot be built, and the third is no blade."""
    monkeypatch.chdir(config_copy)
    overlay(config_copy, "blades.yaml", BLADES)
    overlay(config_copy, "config.yaml", SEARCH)
    overlay(config_copy, "config.yaml", "{ scenes: [direct, abradable], search: { designs: 7, first: 3 } }")
    settings = read_settings(config_copy)
    results = settings.results / "search"
    write_round(SearchRound({"d0000": (0.5, 1.0), "d0001": (0.0, 2.0), "d0002": (0.0, 89.0)}), results / "round_0.json")
    write_round(SearchRound({"d0003": (0.1, 1.0)}), results / "round_1.json")
    write_round(SearchRound({"d0004": (0.2, 1.0)}), results / "round_2.json")
    for number, refused in enumerate(({"d0001": "crossed", "d0002": "no blade"}, {"d0003": "crossed"}, {})):
        write_json(refused, results / f"built_{number}.json")
    file, sweep = f"{results}/{{}}_{{}}.json".format, Sweep(settings, beside=beside(settings))
    search = Search(sweep, lambda number: file("round", number), lambda number: file("built", number))

    assert [search.number_of_designs(Named(round=number)) for number in range(4)] == [3, 2, 2, 0]
    assert search.last_round(None) == "<results>/search/round_3.json"
    assert search.round_inputs(Named(round=0)) == {}
    measures = "<results>/search/{}/measures.json".format
    assert search.round_inputs(Named(round="1")) == {
        "before": file("round", 0), "built": file("built", 0), "start": measures("start"), "measures": [measures("d0000")],
    }  # fmt: skip
    assert search.shapes(Named(round="0")) == [f"<results>/search/d000{n}/shape.json" for n in range(3)]
    built = [f"<results>/search/{name}/Free/geometry.nc" for name in ("d0000", "d0004")]
    assert search.shapes_of_all(None) == built

    made = {name: search.shape(Named(design=name)) for name in ("start", "d0000", "d0002")}
    for name, values in (("start", None), ("d0000", (0.5, 1.0))):
        definition = designs_of(settings).blade(name, values).definition
        assert made[name] == {"definition": to_plain(definition), "refused": None}
    assert made["d0002"]["definition"] is None and "stagger_deg" in made["d0002"]["refused"]
    measured = search.measured(Named(design="d0000"))
    assert list(measured) == ["geometry", "campbell", "contact", "stress", "responses"]
    (response,) = measured["responses"]
    assert response == "<results>/search/d0000/Free/abradable/response.nc"
    assert search.responses_of_scenes(Named(design="d0000")) == {"abradable": 1}
    assert search.density(Named(design="d0000")) == settings.blades["Free"].material.density
    assert remarks(settings)[0].startswith("search: 7 designs of 'Free' in rounds of 2, at most 3 simulations of each")
    assert search.budget(None) == [7, 3, 2] and search.designs.entry.best == 3
