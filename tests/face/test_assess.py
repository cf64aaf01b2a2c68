"""The commands of docs/assess.md, from a mesh to a verdict and to what overturns it, at a small level and few speeds."""

import re
import shlex
import shutil

import pandas as pd
import pytest
from workflow_runs import copy_project, snakemake
from yaml import safe_load

from r37core.base.dataset_file import read_dataset
from r37core.base.yaml_file import load_yaml

SHORTER = {
    "1080": "1220",
    "1440": "1222.5",
    "step: 10, refine_to: 2.5": "step: 2.5",
    "members: 8": "members: 2",
    "revolutions: 400": "revolutions: 20",
    "damping_ratio: 0.0005": "damping_ratio: 0.02",
    "[3.0e-4, 3.4e-4, 3.8e-4]": "[3.4e-4]",
    "[5.0e-5, 5.0e-4, 1.0e-3]": "[5.0e-4]",
}
"""What the page has, and the test in its place: the range of speeds, the sample, the length of carried motions, the designs."""


def shortened(text):
    for shown, smaller in SHORTER.items():
        text = text.replace(shown, smaller)
    return text


@pytest.fixture(scope="module")
def page(root):
    return (root / "docs/assess.md").read_text()


@pytest.fixture(scope="module")
def project(root, tmp_path_factory):
    folder = tmp_path_factory.mktemp("assess")
    copy_project(root, folder)
    shutil.copytree(root / "examples", folder / "examples")
    for file in folder.glob("examples/fan/*.yaml"):
        file.write_text(shortened(file.read_text()))
    return folder


def test_the_page_shows_the_file(root, page):
    (shown,) = re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)
    assert safe_load(shown) == load_yaml(root / "examples/fan/assess.yaml")


@pytest.mark.slow
def test_commands_of_the_page_end_with_a_verdict(project, page):
    """The first one with its figures; each other one in a folder of its own, of which the verdict is made."""
    commands = [shlex.split(shortened(block)) for block in re.findall(r"```sh\n(snakemake .*?)```", page, re.DOTALL)]
    runs = []
    for _, *words in commands:
        runs.append(next((re.findall(r"name: (\w+)", word)[0] for word in words if word.startswith("run=")), "fan"))
        given = words if "--config" in words else [*words, "--config"]
        if len(runs) > 1:
            given[given.index("all_blades")] = f"results/runs/{runs[-1]}/verdict.csv"
        if runs[-1] in ("contact", "motions", "flexible"):
            # planned alone: what they end in is that of the others
            snakemake(project, *given, "fidelity=tiny", "--dry-run")
            continue
        snakemake(project, *given, "fidelity=tiny")
        verdict = pd.read_csv(project / "results/runs" / runs[-1] / "verdict.csv")
        assert set(verdict["verdict"]) <= {"meets", "fails", "cannot tell", "does not apply"}
        assert {"above_yield", "goodman_share", "used_lining"} == set(verdict["requirement"])
    assert len(runs) == 6 and len(set(runs)) == 6
    results = project / "results/runs"
    # each attack judges what the page says: stress of all members, the whole blade
    members = pd.read_csv(results / "spread/verdict.csv").set_index("requirement")["members"]
    assert (members[["above_yield", "goodman_share"]] == 2).all()
    assert "0 to 97% span" in str(read_dataset(results / "regions/stress.nc")["stress_region"].isel(region=0).values)
    designs = load_yaml(project / "examples/fan/scenes.yaml")["Room"]["vary"]
    first = pd.read_csv(project / "results/runs/fan/verdict.csv")
    assert first["scene"].nunique() == len(designs["casing.clearance_m"]) * len(designs["lining.thickness_m"])
    for figure in re.findall(r"`figures/(\w+\.png)`", page):
        assert (project / "results/runs/fan/figures" / figure).exists(), figure
