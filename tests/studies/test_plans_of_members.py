"""Plans of members and run-ups."""

import json
import math

import pytest
from test_workflow_plans import L50, PLACES, REF, REFINED, of, refining, sweeps_of, with_scene  # noqa: F401

from r37core.config import command_line_document
from r37core.plans.extent import extent_of
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.product.targets import targets
from r37studies.run_ups.plan import RunUps
from r37studies.tolerances.members import Tolerances


def test_speeds_of_all_rounds_are_reduced_and_a_round_reads_what_the_one_before_asked_for(refining):
    """The estimate of their number is their share."""
    assert extent_of(refining.settings, {})["sweep"]["Ref", "abradable"].number == max(1.5 * 3, int(0.2 * 21))
    names = [file.rsplit("_", 1)[1] for file in refining.speed_files(REF)]
    assert names == ["900.npz", "925.npz", "950.npz", "1000.npz"]
    with pytest.raises(KeyError):
        refining.speed_files(L50)
    assert refining.round_inputs(of(blade="Ref", scene="abradable", round="0")) == {"campbell": "<results>/Ref/campbell.nc"}
    assert refining.round_inputs(of(blade="Ref", scene="abradable", round="2")) == {
        "before": "<results>/Ref/abradable/round_1.json",
        "speeds": ["<results>/Ref/abradable/speed_925.npz"],
    }


@pytest.fixture
def members(root):
    """Plan of two members: one has the shape of the reference blade and one another, both yield early; and the settings."""

    def plan(thicknesses=(100.0, 102.0)):
        tolerances = {"members": 2, "blades": ["Ref"], "largest_share": 0.4}
        tolerances["of_scenes"] = {"lining.thickness_m": {"uniform_percent": 5.0}}
        thickness = {"thickness_percent": {"values": list(thicknesses)}}
        tolerances["of_blades"] = {"material.yield_stress_pa": {"values": [1.0e9]}} | thickness
        settings = read_settings(root, command_line_document(REFINED | {"tolerances": tolerances}))
        return Tolerances(settings), settings

    return plan


def test_a_member_is_run_like_the_nominal_blade(members):
    """By the same plan: from the nominal models where its blade is the nominal one, with what its ranges are read off."""
    plan, settings = members()
    drawn, sweeps, about = plan.all["Ref", "abradable"], sweeps_of(plan), plan.about(REF)
    assert list(sweeps) == ["0", "1"] and {member.values[1] for member in drawn.values()} == {100.0, 102.0}
    task = json.loads(Sweep(settings).task(of(**vars(REF), speed="900")))
    for name, sweep in sweeps.items():
        is_nominal = drawn[name].values[1] == 100.0
        stages = {"contact_model", "stress_operator", "campbell_of_blade"}
        assert (set(sweep.existing), set(sweep.recipes)) == ((stages, set()) if is_nominal else (set(), stages))
        assert sweep.yield_stress == 1.0e9 != Sweep(settings).yield_stress(REF)
        own, made = json.loads(sweep.task), json.loads(about[name])
        assert own["results"] == ["spectrum", "stress"] and {"wear", "energy"} <= set(task["results"])
        assert own["scene"]["lining"]["thickness"] == drawn[name].values[2] != task["scene"]["lining"]["thickness"]
        assert own["kept"] == task["kept"] and sweep.history_speeds == ()
        assert made["member"] == name and json.loads(made["scene_parameters"]) == own["scene"]
    # messages name the member
    assert f"'name': 'Ref, member {next(name for name in drawn if sweeps[name].recipes)} of tolerances'" in str(sweeps)
    share = plan.speeds(REF)["choice"]["largest_share"]
    assert share == 0.4 != Sweep(settings).refinement_choice(REF)["largest_share"]
    assert len(plan.samples) == 2


def test_members_with_equal_blades_share_their_model(members):
    """Strengths are no part of it, and the nominal blade's is made in any case."""
    first, second = sweeps_of(members((102.0,))[0]).values()
    assert first.recipes == second.recipes and first.recipes["contact_model"].inputs["rom"].params["kept"] is False
    assert first.task != second.task


def test_run_ups_are_planned_like_speeds(root):
    """Of chosen blades, families among them, and scenes; from the Campbell diagram where they are about a crossing of it."""
    crossing = {"mode": "1B", "engine_order": 4, "first": -0.02, "last": 0.08}
    run_ups = {
        "climb": {"from_rpm": 9000, "to_rpm": 12000, "rate_rpm_s": 300, "blades": ["L50"]},
        "down": {"crossing": crossing, "revolutions": 40, "scenes": ["direct"], "revolutions_before": 30},
    }
    settings = read_settings(root, command_line_document({**PLACES, "run_ups": run_ups}))
    planned = RunUps(Sweep(settings))
    runs = ["Ref direct down", "L50 abradable climb", "L50 direct climb", "L50 direct down"]
    assert [" ".join(run) for run in planned.runs] == runs
    climb = of(blade="L50", scene="abradable", run_up="climb")
    down = of(blade="Ref", scene="direct", run_up="down")
    assert set(planned.inputs(climb)) == {"prepared", "model", "stress"}
    assert planned.inputs(down)["campbell"] == "<results>/Ref/campbell.nc"
    found = planned.choices["L50", "abradable"]["climb"].blade_run_up(496, None, "climb")
    assert (found.start, found.stop) == pytest.approx((300.0 * math.pi, 400.0 * math.pi))
    assert found.rate(496) == pytest.approx(10.0 * math.pi)
    assert found.before == planned.integration_choice("L50", "abradable", "climb").revolutions == 200
    # stress in every revolution, the first ones too
    choice = planned.integration_choice("Ref", "direct", "down")
    assert choice.revolutions == choice.snapshot_revolutions == 30
    wanted = targets(Sweep(settings))
    assert {"<results>/run_ups.nc", "<results>/figures/run_ups_Ref__direct.png"} <= set(filled(wanted))
    assert "<results>/figures/run_ups_Ref__abradable.png" not in filled(wanted)
