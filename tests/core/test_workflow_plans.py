"""What runs, with what, from which files: the plans behind the rules, without Snakemake."""

import json
from dataclasses import replace
from types import SimpleNamespace

import pytest

from r37core.adaptive.criterion import RefinementChoice
from r37core.base.plain import from_plain
from r37core.config import command_line_document
from r37core.config.settings import most_runs
from r37core.contact.scene import Scene
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.sweep.blade_sweep import BladeSweep

PLACES = {"blades": ["Ref", "L50"], "scenes": ["abradable", "direct"]}


@pytest.fixture(scope="module")
def chosen(root):
    """Two blades in two scenes, at two speeds of which one is of one blade only."""
    rule = {"blades": ["L50"], "scenes": ["direct"], "speeds": [1000.25]}
    return read_settings(root, command_line_document({**PLACES, "speeds": [900, 1234.5], "speeds_for": [rule]}))


def of(**wildcards):
    return SimpleNamespace(**wildcards)


REF, L50 = of(blade="Ref", scene="abradable"), of(blade="L50", scene="direct")


def test_speeds_and_their_files(chosen):
    sweep = Sweep(chosen)
    files = [f"<results>/Ref/abradable/speed_{speed}.npz" for speed in ("900", "1234.5")]
    assert sweep.speed_files(REF) == files
    assert sweep.speeds(REF, of(speeds=files)) == [900.0, 1234.5]
    assert sweep.speeds(L50, of(speeds="<results>/L50/direct/speed_1000.25.npz")) == [1000.25]
    # what stands there until the first round is done
    assert sweep.speeds(REF, of(speeds="<results>/Ref/abradable/round_0.json")) == []
    assert sweep.speed_files(L50) == ["<results>/L50/direct/speed_1000.25.npz"]


def test_of_many_designs_some_are_drawn_evenly_from_the_first_to_the_last():
    designs, rooms = [f"D{number}" for number in range(31)], [f"R{number}" for number in range(8)]
    families = {"designs": of(family_of=dict.fromkeys(designs, "D")), "scene_designs": of(family_of=dict.fromkeys(rooms, "R"))}
    drawn = Sweep(of(blades=["Ref", *designs], scenes=rooms, **families)).drawn
    assert drawn["blade"] == ["Ref", "D0", "D6", "D12", "D18", "D24", "D30"]
    assert drawn["scene"] == ["R0", "R1", "R3", "R4", "R6", "R7"]


REFINED = {**PLACES, "speeds": [{"start": 900, "stop": 1000, "step": 50, "refine_to": 5}]}


@pytest.fixture
def refining(root, tmp_path):
    """A plan with adaptive speeds, with two finished rounds of the reference blade and one of the other."""
    rounds = {("Ref", 0): [900, 950, 1000], ("Ref", 1): [925], ("Ref", 2): [], ("L50", 0): [900, 950, 1000]}

    def file_of_round(blade, scene, round):
        file = tmp_path / f"{blade}_{round}.json"
        file.write_text(json.dumps({"new": rounds[blade, round], "measured": []}))
        return file

    return Sweep(read_settings(root, command_line_document(REFINED)), file_of_round)


def sweeps_of(plan):
    return {name: from_plain(BladeSweep, sweep) for name, sweep in plan.sweeps(REF).items()}


def with_scene(settings, name, entry):
    """The settings with another entry of a scene."""
    designs = settings.scene_designs
    return replace(settings, scene_designs=replace(designs, entries=designs.entries | {name: entry}))


def test_what_a_round_is_told_is_what_it_takes(refining):
    """Plain values, of which a job makes the choice again."""
    choice = from_plain(RefinementChoice, json.loads(json.dumps(refining.refinement_choice(REF))))
    assert [window.mode for window in choice.windows] == ["1B", "1T"]
    assert choice.prominence == 0.1


def test_without_a_lining_a_round_has_a_share_of_its_own_and_no_windows(root):
    """The response scatters there; both can be asked for all the same."""
    run = {**REFINED, "blades": ["Ref"]}
    direct, lined = (of(blade="Ref", scene=scene) for scene in ("direct", "abradable"))
    settings = read_settings(root, command_line_document(run))
    rounds = Sweep(settings)
    assert (rounds.refinement_choice(direct)["windows"], rounds.refinement_choice(direct)["largest_share"]) == ([], 0.125)
    assert rounds.refinement_choice(direct)["change"] == rounds.refinement_choice(lined)["change"]
    assert most_runs(settings, "Ref", "direct") < most_runs(settings, "Ref", "abradable")
    window = {"mode": "1B", "highest_engine_order": 3, "first": 0.0, "last": 0.1, "step_rad_s": 5.0}
    chosen = {"refinement": {"direct": {"windows": [window], "largest_share": 0.9}}}
    rounds = Sweep(read_settings(root, command_line_document(run | chosen)))
    assert [one["highest_engine_order"] for one in rounds.refinement_choice(direct)["windows"]] == [3]
    assert rounds.refinement_choice(direct)["largest_share"] == 0.9
    assert rounds.refinement_choice(lined) == Sweep(settings).refinement_choice(lined)


def test_models_of_a_scene_and_without_stress_no_basis(chosen):
    sweep = Sweep(chosen)
    assert sweep.contact_model(REF) == "<results>/Ref/contact_pressure_edge.npz"
    assert sweep.models(L50)[1:] == ["<results>/L50/stress_pressure_edge.npz"]
    assert Sweep(chosen).boundary(of(blade="Ref", tip_line="camber"))["tip_line"] == "camber"
    plain = chosen.scene_designs.entries["direct"].model_copy(update={"results": ["spectrum"]})
    sweep = Sweep(with_scene(chosen, "direct", plain))
    assert sweep.models(L50)[1:] == []
    assert sweep.runs_with("stress") == [("Ref", "abradable"), ("L50", "abradable")]


def test_task_of_a_simulation(chosen):
    scenes = ("direct", "abradable")
    task, lined = (json.loads(Sweep(chosen).task(of(blade="Ref", scene=scene, speed="900"))) for scene in scenes)
    assert task["scene"]["lining"] is None
    level = chosen.fidelity.time_integration
    assert task["choice"]["time_step"] == level.largest_time_step_s.direct
    assert lined["choice"]["time_step"] == level.largest_time_step_s.lined
    assert task["choice"]["revolutions"] == level.revolutions
    assert task["kept"]["wear_angles"] == level.wear_angles


def test_datasets_join_the_runs_that_have_their_kind(chosen):
    sweep = Sweep(chosen)
    assert sweep.kinds == ["rms", "spectrum", "stress", "wear"]
    every = [("Ref", "abradable"), ("Ref", "direct"), ("L50", "abradable"), ("L50", "direct")]
    assert sweep.runs_with("rms") == every
    assert sweep.runs_with("wear") == [("Ref", "abradable"), ("L50", "abradable")]


def test_provenance(chosen):
    attributes = Sweep(chosen).provenance(of(blade="Ref", scene="direct"))
    assert attributes["blade"] == "Ref"
    assert attributes["fidelity"] == "standard"
    steps = chosen.fidelity.time_integration.largest_time_step_s
    assert attributes["largest_time_step"] == steps.direct
    assert (
        attributes["numerics"]
        == f"20000 nodes unless imported, exact_modal of {steps.lined:g} s with lining, {steps.direct:g} s without"
    )
    # what joins datasets of one level
    assert Sweep(chosen).provenance(REF)["numerics"] == attributes["numerics"]
    assert from_plain(Scene, json.loads(attributes["scene_parameters"])) == chosen.scenes["direct"].scene
    assert json.loads(Sweep(chosen).provenance(REF)["scene_parameters"])["lining"]


@pytest.mark.parametrize(
    ("name", "old", "new", "changes"),
    [
        ("config", "edges: round", "edges: blunt", {"shape", "structure"}),
        ("blades", "sweep_deg: 5", "sweep_deg: 6", {"shape", "structure"}),
        ("blades", "youngs_modulus_pa: 180", "youngs_modulus_pa: 181", {"structure"}),
        ("blades", "yield_stress_pa: 1.38", "yield_stress_pa: 1.39", set()),
        ("fidelity", "nodes: 20000, layers: 1", "nodes: 20000, layers: 2", {"structure"}),
        ("fidelity", "fixed_interface_modes: 10", "fixed_interface_modes: 11", {"structure"}),
        ("config", "spin_softening: false", "spin_softening: true", {"structure"}),
        ("config", "tip_line: pressure_edge", "tip_line: camber", {"structure"}),
        ("blades", "maximum_x_m: 0.197", "maximum_x_m: 0.196", {"structure"}),
        ("scenes", "coefficient: 0.15", "coefficient: 0.16", set()),
    ],
)
def test_the_input_hash_is_of_all_that_a_file_is_made_of(config_copy, name, old, new, changes):
    """Of the geometry, or of the structure; a simulation's scene stands beside it."""
    with open(config_copy / "config/blades.yaml", "a") as stream:
        stream.write("Mine: { base: Ref, chordwise_sweep_deg: 5 }\n")

    def hashes():
        plan, blade = Sweep(read_settings(config_copy)), of(blade="Mine", scene="direct")
        shape, structure = (made(blade)["input_hash"] for made in (plan.shape_provenance, plan.structure_provenance))
        assert plan.provenance(blade)["input_hash"] == structure
        return {"shape": shape, "structure": structure}

    before, file = hashes(), config_copy / f"config/{name}.yaml"
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, new))
    after = hashes()
    assert {kind for kind in before if before[kind] != after[kind]} == changes
