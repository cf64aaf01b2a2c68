"""The shipped configuration, with the sections of studies."""

import pytest

from r37core.config import read_document
from r37core.config.remarks import remarks_on_linear_variants
from r37core.product.extensions import read_settings
from r37core.product.schemas import schemas


@pytest.mark.parametrize(
    ("name", "contact"),
    [*((name, "patches") for name in ("decide", "ranking", "search", "search_best", "tolerances")), ("rotor", "points")],
)
def test_decisions_have_large_displacements(config_copy, name, contact):
    settings = read_settings(config_copy, read_document(config_copy, f"config/{name}.yaml"))
    assert {settings.reduction_choice(blade).kinematics for blade in settings.blades} == {"quadratic"}
    assert {settings.boundary_choice(blade).contact for blade in settings.blades} == {contact}
    assert remarks_on_linear_variants(settings) == []


def test_schemas_are_fresh(root):
    """`python -m r37core.product.schemas` renews them."""
    folder = root / "config/schemas"
    assert {file.name: file.read_text() for file in folder.iterdir()} == schemas()
