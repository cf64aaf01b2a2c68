"""docs/capability.md: what stands there adds a capability, without a change anywhere else."""

import re

import pandas as pd
import pytest
from overlays import overlay
from plans_of_snakemake import planned
from workflow_runs import own_package, snakemake

import r37

REGISTRY = "src/r37core/product/extensions.py"


def blocks_of(page):
    """File -> what the page writes into it, in the order of the page."""
    blocks = {}
    for before, code in re.findall(r"(.*?)```(?:python|text)\n(.*?)```", page, re.DOTALL):
        blocks[re.findall(r"`((?:src|workflow)/[\w/]+\.(?:py|smk))`", before)[-1]] = code
    return blocks


@pytest.mark.slow
def test_a_stranger_adds_a_capability_by_the_page_alone(root, sweep_copy):
    own_package(sweep_copy)
    page = (root / "docs/capability.md").read_text()
    blocks = blocks_of(page)
    line = blocks.pop(REGISTRY)
    assert sum(len(code.splitlines()) for code in blocks.values()) < 50
    for name, code in blocks.items():
        file = sweep_copy / name
        assert not file.exists()
        file.parent.mkdir(exist_ok=True)
        file.write_text(code)
    registry = sweep_copy / REGISTRY
    text = registry.read_text()
    registry.write_text(re.sub(r"(_FOLDERS = \(\n)", rf"\g<1>{line}", text))
    assert len(registry.read_text().splitlines()) == len(text.splitlines()) + 1

    # it is part of all_blades, and nothing that was made before is made again
    assert set(planned(sweep_copy)) == {"largest_stress_table", "all_blades"}
    said = snakemake(sweep_copy, "largest_stress", "--cores", "1")
    assert "largest_stress: 1 file made; look at results/largest_stress.csv\n" in said
    table = pd.read_csv(sweep_copy / "results/largest_stress.csv")
    stress = r37.open_results(sweep_copy / "results")["stress"]
    assert list(table["blade"]) == list(stress["blade"].values)
    for blade, largest in zip(table["blade"], table["max_von_mises_pa"], strict=True):
        assert largest == pytest.approx(float(stress["max_von_mises_ever"].sel(blade=blade).max()), rel=1e-5)

    # without stress there is nothing to make, which is said at once
    overlay(sweep_copy, "scenes.yaml", "{ abradable: { results: [wear] }, direct: { results: [spectrum] } }")
    text = snakemake(sweep_copy, "largest_stress", "--cores", "1", check=False)
    assert "largest_stress: found the target largest_stress and none of the blades and scenes that are run" in text
