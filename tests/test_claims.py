"""No committed table or picture is older than what makes it, unless its page says so."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest
from conftest import CHECKOUT
from PIL import Image
from r37core.published import REFERENCE

from r37core.text_file import part_of

REMEDY = "make claims ONLY='{}', or an entry with its reason in docs/older.json"


@pytest.fixture(scope="module", autouse=True)
def importable(root):
    """The package of the claims is that of the project as it was delivered."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(root / "benchmarks"))
        yield


@pytest.fixture(scope="module")
def outputs():
    """Place -> claim and output, those left out that another test makes anew and compares."""
    from claims.registry import OUTPUTS

    return {place: pair for place, pair in OUTPUTS.items() if not pair[0].checked_by}


@pytest.fixture(scope="module")
def older(root):
    from claims.older import read_older

    return read_older(root)


def test_every_table_and_picture_is_in_the_registry(root):
    from claims.registry import DRAWN, OUTPUTS

    pictures = {str(file.relative_to(root)) for file in (root / "docs").rglob("*.*") if file.suffix in (".png", ".svg")}
    pages = [root / "README.md", *(root / "docs").glob("*.md")]
    marker = re.compile(r"^<!-- (\w+)(?: made-with:\w+)? -->$", re.MULTILINE)
    parts = {f"{page.relative_to(root)}#{name}" for page in pages for name in marker.findall(page.read_text())}
    parts = {part for part in parts if not part.endswith(("#end", "#older"))}
    whole = {place for place in OUTPUTS if "#" not in place and not place.endswith(".png")}
    assert pictures | parts | whole == set(OUTPUTS) | DRAWN
    assert all((root / place).exists() for place in whole)


def test_every_picture_stands_on_a_page(root):
    pages = [root / "README.md", *(root / "docs").glob("*.md")]
    shown = {(page.parent / name).resolve() for page in pages for name in re.findall(r"!\[[^\]]*\]\((\S+)\)", page.read_text())}
    assert {file for file in (root / "docs").rglob("*.png") if "site" not in file.parts} == {
        file for file in shown if file.suffix == ".png"
    }


def test_nothing_is_older_than_what_makes_it_unless_it_is_listed(root, outputs, older):
    from claims.hashes import present_hash
    from claims.stamps import read_stamp

    assert set(older) <= set(outputs)
    for place, (claim, one) in outputs.items():
        stamp = read_stamp(one, root)
        assert stamp, f"{place} carries no hash: {REMEDY.format(place)}"
        current = stamp == present_hash(claim, one, root)
        assert current or place in older, f"{place} is older than what makes it: {REMEDY.format(place)}"
        assert not (current and place in older), f"{place} is up to date: take it out of docs/older.json"


def test_pages_say_what_is_older(root, older):
    """Beside each table and picture of the list, and nowhere else."""
    from claims.older import pages, with_notes

    said = 0
    for page in pages(root):
        text = page.read_text()
        assert with_notes(text, str(page.relative_to(root)), older) == text, f"{page.name}: make claims writes its sentences"
        said += text.count("<!-- older -->")
    # a picture may stand on several pages
    assert said >= len(older)
    assert all(len(why.split()) <= 24 and not why.endswith(".") for why in older.values())


@pytest.mark.slow
def test_fixed_runs_have_the_numbers_of_the_fingerprint(root):
    from claims.hashes import NUMBERS
    from claims.numbers import measured, moved

    changed = moved(json.loads((root / NUMBERS).read_text()), measured(root))
    assert not changed, f"{', '.join(changed)}: numbers of the engine moved; make fingerprint, then make claims LIST=yes"


def test_a_moved_number_is_told():
    from claims.numbers import moved

    known = {"lined": {"rms (m)": 1.0, "wear (m)": 2.0}, "direct": {"rms (m)": 3.0}}
    assert moved(known, known) == []
    assert moved(known, {**known, "lined": {"rms (m)": 1.0 + 1e-6, "wear (m)": 2.0}}) == []
    assert moved(known, {**known, "lined": {"rms (m)": 1.0 + 1e-4, "wear (m)": 2.0}}) == ["lined"]
    assert moved(known, {**known, "ring": {"rms (m)": 1.0}}) == ["ring"]
    assert moved(known, {"direct": {"rms (m)": np.nan}}) == ["direct", "lined"]


@pytest.fixture
def copy(root, tmp_path):
    """What hashes are of, to be changed."""
    for name in ("docs", "config", "benchmarks", "examples"):
        shutil.copytree(root / name, tmp_path / name)
    shutil.copytree(root / "src/r37core", tmp_path / "src/r37core", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(root / "README.md", tmp_path)
    return tmp_path


def stale_in(copy):
    """Places that are older now, but not those that were before."""
    from claims import hashes
    from claims.__main__ import stale
    from claims.older import read_older
    from claims.registry import CLAIMS

    hashes._loaded.cache_clear()
    found = {one.place for _, several in stale(CLAIMS, copy) for one in several}
    return found - set(read_older(copy))


def edited(file, before, after):
    text = file.read_text()
    assert before in text
    file.write_text(text.replace(before, after))


def forget_code():
    from r37core.plans import code

    code._facts.cache_clear()


@pytest.mark.parametrize(
    "file, before, after, expected",
    [
        ("src/r37core/figures/casing_map.py", '"""What an', '"""Here: what an', set()),
        ("benchmarks/run_ups.py", "RESULTS", "FOLDER", {"docs/run_ups.md#run_up_rates", "docs/accuracy.md#run_ups"}),
        ("benchmarks/mesh_step.py", "quiet_gmsh()", "quiet_gmsh( )", set()),
        ("config/run_ups.yaml", "rate_rad_s2: 10,", "rate_rad_s2: 11,", {"docs/run_up_rates.png"}),
        ("config/run_ups.yaml", "# Run-ups", "# All run-ups", set()),
        ("config/fidelity.yaml", "cpu_s_per_run: 0.03", "cpu_s_per_run: 0.04", set()),
        (
            "docs/fingerprint.json",
            '"sum of casing, forward (m)": 8.7',
            '"sum of casing, forward (m)": 8.8',
            {"docs/casing_Ref.png"},
        ),
    ],
)
def test_what_decides_makes_older(copy, file, before, after, expected):
    edited(copy / file, before, after)
    forget_code()
    found = stale_in(copy)
    assert expected <= found
    assert bool(found) == bool(expected)


def test_a_changed_drawing_makes_its_pictures_older_and_no_table(copy):
    edited(copy / "src/r37core/figures/casing_map.py", "draw_casing_map", "draw_another_map")
    forget_code()
    assert stale_in(copy) == {"docs/casing_Ref.png"}


def test_a_stamp_changes_nothing_else(copy):
    from claims.registry import OUTPUTS
    from claims.stamps import read_stamp, write_stamp

    for place in ("docs/casing_Ref.png", "docs/accuracy.md#growth", "docs/gallery.md", "docs/tutorial.ipynb"):
        _, one = OUTPUTS[place]
        file, old = copy / one.page, read_stamp(one, copy)
        before = file.read_bytes()
        pixels = np.asarray(Image.open(file)) if one.kind == "picture" else None
        write_stamp(one, "0123abcd", copy)
        assert read_stamp(one, copy) == "0123abcd"
        if pixels is not None:
            with Image.open(file) as image:
                np.testing.assert_array_equal(np.asarray(image), pixels)
                assert image.text["Description"].startswith("Waves round")
                assert round(image.info["dpi"][0]) == 200
        write_stamp(one, old, copy)
        assert file.read_bytes() == before, place


def test_a_claim_is_made_by_its_commands_and_is_no_longer_older(copy, capsys):
    """One whose command a plain one stands in for: the table is put between its markers, with its hash."""
    from dataclasses import replace

    from claims.__main__ import make, named
    from claims.older import read_older

    (claim,) = named("estimate")
    assert "docs/speed.md#estimate" in read_older(copy)
    made = "mkdir -p results/studies && printf 'new\\n' > results/studies/estimate.md"
    make(replace(claim, commands=(made,)), "1", copy)
    page = (copy / "docs/speed.md").read_text()
    assert part_of(page, "estimate") == "new\n"
    assert "docs/speed.md#estimate" not in read_older(copy)
    assert "This table is older than what makes it: costs are those of a former version." not in page
    assert stale_in(copy) == set()
    with pytest.raises(ValueError, match=r"estimate: its commands did not write results/studies/estimate.md"):
        (copy / "results/studies/estimate.md").unlink()
        make(replace(claim, commands=("true",)), "1", copy)
    with pytest.raises(subprocess.CalledProcessError):
        make(replace(claim, commands=("exit 3",)), "1", copy)


def test_a_result_that_a_script_did_not_renew_is_not_taken(copy):
    import os
    from dataclasses import replace

    from claims.__main__ import make, named

    (claim,) = named("resources")
    old = copy / "results/studies/resources.md"
    old.parent.mkdir(parents=True)
    old.write_text("old\n")
    os.utime(old, (0, 0))
    with pytest.raises(ValueError, match="did not write"):
        make(replace(claim, commands=("true",)), "1", copy)
    assert part_of((copy / "docs/cluster.md").read_text(), "resources") != "old\n"


def test_rearranged_code_renews_hashes_but_not_of_what_is_older(copy):
    from claims.__main__ import keep, named
    from claims.older import read_older

    before = read_older(copy)
    edited(copy / "benchmarks/coriolis.py", "FREQUENCIES", "SHOWN")
    forget_code()
    (claim,) = named("coriolis")
    assert len(stale_in(copy)) == 4
    keep(claim, copy)
    assert stale_in(copy) == set()
    assert read_older(copy) == before
    assert "docs/coriolis.md#cost" in before


def test_names_of_claims():
    from claims.__main__ import named

    for name in ("tradeoff", "growth.png", "docs/growth.png", "accuracy_tables.md#levels", "accuracy_tables.md#tradeoff"):
        assert [claim.name for claim in named(name)] == ["tradeoff"], name
    assert len(named("accuracy.md")) > 3
    with pytest.raises(ValueError, match="ONLY: found 'growht'; allowed: rules, "):
        named("growht")


def test_claims_name_what_is_there(root):
    """Code, configuration and fixed runs; commands or what to do; a test that compares."""
    from claims.hashes import NUMBERS
    from claims.registry import CLAIMS, OUTPUTS

    numbers = json.loads((root / NUMBERS).read_text())
    assert len(OUTPUTS) == sum(len(claim.outputs) for claim in CLAIMS)
    for claim in CLAIMS:
        assert bool(claim.commands) != bool(claim.by_hand), claim.name
        assert set(claim.numbers) <= set(numbers), claim.name
        assert not claim.checked_by or (CHECKOUT / claim.checked_by).exists(), claim.name
        for command in claim.commands:
            for script in re.findall(r"\{python\} (benchmarks/\w+\.py)", command):
                assert (root / script).exists(), script
                # what makes a table decides about it
                assert claim.checked_by or script in claim.code or claim.name == "contact_patches", claim.name
    assert set(numbers) == {name for claim in CLAIMS for name in claim.numbers}


def test_readme_has_the_count_and_the_largest_differences(root):
    from claims.texts import differences

    table = part_of((root / "docs/validation_tables.md").read_text(), "validation")
    assert part_of((root / "README.md").read_text(), "differences").strip() == differences(table)


def test_differences_are_the_largest_in_order():
    from claims.texts import differences

    table = """7 of 12 published numbers and statements agree.

| what | published | ours | error |
|---|---|---|---|
| a | yes | no (2) | **differs** |
| b | 4 mm | 5.0012 | **25%** |
| c | 2 | 4 | **100%** |
| d | 3 rad/s | 3.001 | 0.03% |
| e | 10 | 8 | **20%** |
| f | 10 | 9 | **10%** |
"""
    expected = ["At `paper` 7 of 12 published numbers and statements agree. Furthest off:", ""]
    assert differences(table).splitlines() == [
        *expected,
        "- c: 4, published 2",
        "- b: 5, published 4 mm",
        "- e: 8, published 10",
    ]
    with pytest.raises(ValueError, match="how many agree"):
        differences("nothing")


def test_there_is_one_count_of_agreement(root):
    """In README and on the page of the validation, of one table; the gallery has none of all its pictures."""
    pages = {file.name: file.read_text() for file in [root / "README.md", *(root / "docs").glob("*.md")]}
    found = {
        name: set(re.findall(r"(\d+ of \d+) published numbers and statements agree", text)) for name, text in pages.items()
    }
    counts = {name: several for name, several in found.items() if several}
    assert set(counts) == {"README.md", "validation.md", "validation_tables.md"}
    assert len(set.union(*counts.values())) == 1


def test_the_reference_blade_is_no_bound_for_seven(root):
    """docs/accuracy.md says so: in direct contact on points the worst is off several times as much."""
    page = (root / "docs/accuracy.md").read_text()
    assert "are of the reference blade alone" in page
    head, _, *rows = part_of(page, "patches_levels").strip().splitlines()
    (row,) = [row for row in rows if row.startswith("| `standard` | points | `direct` |")]
    cells = dict(zip(head.strip("|").split("|"), row.strip("|").split("|"), strict=True))
    means = {name.strip(): float(cell.split(",")[0]) for name, cell in cells.items() if "," in cell}
    assert max(means.values()) > 3.0 * means[REFERENCE]


def test_scripts_of_the_benchmarks_are_those_of_a_claim_or_say_why_not(root):
    """A script that makes a page's table is in the registry: no other writes into docs/."""
    from claims.claim import ROOT
    from claims.hashes import code_files
    from claims.registry import CLAIMS

    tools = {"prose.py", "mutants.py", "structure_accuracy.py", "contact_patches.py"}
    compared = {"integration_speed.py", "plain_integration.py"}
    named = {file.name for claim in CLAIMS for one in claim.outputs for file in code_files(claim, one, ROOT)}
    named |= {word for claim in CLAIMS for word in re.findall(r"benchmarks/(\w+\.py)", claim.by_hand)}
    scripts = {file.name for file in (root / "benchmarks").glob("*.py")}
    assert scripts - named <= tools | compared
    assert [name for name in scripts if "with_part" in (root / "benchmarks" / name).read_text()] == []
