"""docs/capability.md: what stands there adds a capability, without a change anywhere else."""

import os
import re
import subprocess
import sys

import pandas as pd
import pytest
from workflow_runs import overlay, own_package, planned, snakemake

import r37

REGISTRY = "src/r37studies/registry.py"


def blocks_of(page):
    """File -> what the page writes into it, in the order of the page."""
    blocks, (files, _) = {}, page.split("## From Python", 1)
    for before, code in re.findall(r"(.*?)```(?:python|text)\n(.*?)```", files, re.DOTALL):
        blocks[re.findall(r"`((?:src|workflow)/[\w/]+\.(?:py|smk))`", before)[-1]] = code
    return blocks


CALLS = """
import r37
{page}
print(results.tables["largest_stress"].to_csv(index=False))
print(open("largest.csv").read())
try:
    r37.run("Ref", "direct", [1150], largest_stress={{"scenes": ["nowhere"]}}, config="config/config.yaml")
except r37.ConfigError as error:
    print(error)
"""


@pytest.mark.slow
def test_a_stranger_adds_a_capability_by_the_page_alone(root, sweep_copy):
    own_package(sweep_copy)
    page = (root / "docs/capability.md").read_text()
    blocks = blocks_of(page)
    line = blocks.pop(REGISTRY)
    assert sum(len(code.splitlines()) for code in blocks.values()) < 130
    for name, code in blocks.items():
        file = sweep_copy / name
        assert not file.exists()
        file.parent.mkdir(exist_ok=True)
        file.write_text(code)
    registry = sweep_copy / REGISTRY
    text = registry.read_text()
    registry.write_text(re.sub(r"(FOLDERS = \(\n)", rf"\g<1>{line}", text))
    assert len(registry.read_text().splitlines()) == len(text.splitlines()) + 1

    # it is part of all_blades; only the record of the configuration and the explorer, which links its figure, are made again
    own = {"largest_stress_table", "largest_stress_figure"}
    assert set(planned(sweep_copy)) == {*own, "configuration", "explorer", "all_blades"}
    said = snakemake(sweep_copy, "largest_stress", "--cores", "1")
    assert "largest_stress: 3 files made; look at results/figures/largest_stress.png\n" in said
    table = pd.read_csv(sweep_copy / "results/largest_stress.csv")
    stress = r37.open_results(sweep_copy / "results")["stress"]
    assert list(table["blade"]) == list(stress["blade"].values)
    for blade, largest in zip(table["blade"], table["largest_stress_pa"], strict=True):
        assert largest == pytest.approx(float(stress["max_von_mises_ever"].sel(blade=blade, region="airfoil").max()), rel=1e-5)

    # Python has it for nothing: the call of the page, and a step on results that are there
    _, text = page.split("## From Python", 1)
    first, second = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    code = CALLS.format(page=first.replace("[1150],", '[1150], config="config/config.yaml",') + second)
    environment = {**os.environ, "PYTHONPATH": str(sweep_copy / "src"), "R37_CACHE": str(sweep_copy / "cache")}
    command = [sys.executable, "-W", "ignore", "-c", code]
    printed = subprocess.run(command, cwd=sweep_copy, env=environment, capture_output=True, text=True, check=False)
    assert printed.returncode == 0, printed.stderr
    from_call, from_step, refused = printed.stdout.strip().split("\n\n")
    direct = float(stress["max_von_mises_ever"].sel(blade="Ref", scene="direct", speed=1150, region="airfoil"))
    assert from_call.splitlines()[0] == "blade,largest_stress_pa"
    assert float(from_call.splitlines()[1].removeprefix("Ref,")) == pytest.approx(direct, rel=1e-5)
    assert from_step == (sweep_copy / "results/largest_stress.csv").read_text().strip()
    assert "largest_stress.scenes: found 'nowhere'; allowed: abradable, direct" in refused

    # without stress there is nothing to make, which is said at once
    overlay(sweep_copy, "scenes.yaml", "{ abradable: { results: [wear] }, direct: { results: [spectrum] } }")
    text = snakemake(sweep_copy, "largest_stress", "--cores", "1", check=False)
    assert "largest_stress: found the target largest_stress and none of the blades and scenes that are run" in text
