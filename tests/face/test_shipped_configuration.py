"""The shipped configuration, with the sections of studies."""

import pytest

from r37core.config import command_line_document, read_document
from r37core.config.remarks import remarks_on_linear_variants
from r37core.plans.paths import filled
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.product.schemas import schemas
from r37core.product.targets import targets


@pytest.mark.parametrize(
    ("name", "contact"),
    [*((name, "patches") for name in ("decide", "ranking", "search", "search_best", "tolerances")), ("rotor", "points")],
)
def test_decisions_have_large_displacements(config_copy, name, contact):
    settings = read_settings(config_copy, read_document(config_copy, f"config/{name}.yaml"))
    assert {settings.reduction_choice(blade).kinematics for blade in settings.blades} == {"quadratic"}
    assert {settings.boundary_choice(blade).contact for blade in settings.blades} == {contact}
    assert not [*remarks_on_linear_variants(settings)]


def test_schemas_are_fresh(root):
    """`python -m r37core.product.schemas` renews them."""
    folder = root / "config/schemas"
    assert {file.name: file.read_text() for file in folder.iterdir()} == schemas()


def test_targets_are_what_the_configuration_asks_for(config_copy):
    few = {"blades": ["Ref"], "scenes": ["direct"], "speeds": [900]}
    scenes = config_copy / "config/scenes.yaml"
    scenes.write_text(scenes.read_text().replace("results: [spectrum, signal,", "results: [spectrum, signal, shapes,"))

    def asked(**sections):
        settings = read_settings(config_copy, command_line_document(few | sections))
        sweep = Sweep(settings)
        return {file.removeprefix("<results>/") for file in filled(targets(sweep))}

    without = asked()
    assert {"rms.nc", "stress.nc", "spectrum.nc", "figures/shapes_Ref__direct.png"} <= without
    assert {"figures/response_Ref.png", "figures/spectrum_Ref__direct.pdf", "figures/comparison_direct.pdf"} <= without
    assert not [file for file in without if "wear" in file or "design" in file or "signals" in file or "L50" in file]
    assert asked(signals={"speeds_rad_s": [900]}) - without == {"Ref/direct/signals.nc"}
