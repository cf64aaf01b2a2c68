"""Members run alone."""

from test_sweep_driver import response, run_speeds, sweep  # noqa: F401

from r37core.base.dataset_file import read_dataset
from r37core.base.io import Named
from r37core.config import command_line_document
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.sweep.recipe import structure_attributes
from r37studies.tolerances import steps
from r37studies.tolerances.members import Tolerances


def test_more_members_run_alone(root, tmp_path, sweep, run_speeds):
    """Members that start from the nominal models; groups of one file have what they gave."""
    response([]).assign_attrs(of="Ref").to_netcdf(tmp_path / "campbell.nc")
    files = Named(models=2 * [str(tmp_path / "contact.npz")], campbell=str(tmp_path / "campbell.nc"))
    where, output = Named(blade="Ref", scene="abradable"), Named(members=tmp_path / "tolerances/Ref/abradable/members.nc")

    def run_members(members):
        friction = {"friction.coefficient": {"uniform_percent": 5}}
        changes = {"blades": ["Ref"], "scenes": ["abradable"], "speeds": [900, 1000]}
        changes |= {"tolerances": {"members": members, "of_scenes": friction}}
        plan = Tolerances(settings := read_settings(root, command_line_document(changes)))
        params = {
            "sweeps": plan.sweeps(where),
            "speeds": plan.speeds(where),
            "structure": structure_attributes(settings, "Ref"),
        }
        params |= {"about": plan.about(where), "provenance": Sweep(settings).provenance(where), "cores": 1}
        output.members.parent.mkdir(parents=True, exist_ok=True)
        steps.run(files, output, Named(**params))

    run_members(2)
    assert run_speeds() == 2 * ["900", "1000"]
    run_members(4)
    assert run_speeds()[4:] == 2 * ["900", "1000"]
    assert read_dataset(output.members, group="3/response")["speed"].values.tolist() == [900.0, 1000.0]
    assert read_dataset(output.members, group="3/campbell").attrs["of"] == "Ref"
