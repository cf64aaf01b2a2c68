"""Numbers of pages and configuration are those of the generated pages."""

import re
import shlex

import pytest
from conftest import CHECKOUT
from workflow_runs import overlay
from yaml import safe_dump, safe_load

from r37core.base.yaml_file import load_yaml
from r37core.config import command_line_document
from r37core.product.extensions import read_settings


def section(page, name):
    """What stands between a page's markers."""
    return re.search(rf"<!-- {name} -->\n(.*?)<!-- end -->", page, re.DOTALL)[1]


@pytest.fixture(scope="module")
def readme(root):
    return (root / "README.md").read_text()


def test_the_page_has_the_steps_of_the_levels(root):
    levels = load_yaml(root / "config/fidelity.yaml")
    lines = section((root / "docs/accuracy.md").read_text(), "table accuracy_levels").splitlines()[2:]
    rows = {line.split("`")[1]: line.strip("|\n ").split(" | ") for line in lines if line.startswith("| `")}
    assert set(rows) == {"draft", "standard", "fine"}
    for name, (_, steps, *_) in rows.items():
        largest = levels[name]["time_integration"]["largest_time_step_s"]
        assert steps == f"{1e6 * largest['lined']:.1f} / {1e6 * largest['direct']:.1f}"


def test_the_first_run_is_one_that_can_be_made(root):
    """One blade in the shipped scenes about one crossing, in a folder of its own, which the page names."""
    page = (root / "docs/first_run.md").read_text()
    words = shlex.split(re.search(r"^snakemake all_blades .*--config (.*)$", page, re.MULTILINE)[1])
    given = {key: safe_load(value) for key, value in (word.split("=", 1) for word in words)}
    settings = read_settings(root, command_line_document(given))
    assert (settings.blade_names, settings.scene_names, settings.fidelity_name) == (["Ref"], ["abradable", "direct"], "draft")
    plan = settings.speed_plans["Ref", "abradable"]
    # the Campbell speed of 1B with engine order 4
    assert min(plan.certain) < 1672.0 < max(plan.certain)
    assert set(re.findall(r"results/runs/\w+", page)) == {str(settings.results)}


@pytest.mark.parametrize("page", ["README.md", *sorted(f"docs/{file.name}" for file in (CHECKOUT / "docs").glob("*.md"))])
def test_links_lead_to_pages_and_headings(page):
    file = CHECKOUT / page
    for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"^```.*?^```", "", file.read_text(), flags=re.DOTALL | re.MULTILINE)):
        name, _, heading = target.partition("#")
        linked = file.parent / name if name else file
        if re.match(r"https?:|../validation/", target):
            continue
        assert linked.exists(), target
        assert not heading or heading in headings(linked.read_text()), target


def headings(page):
    """The anchors of a page's headings."""
    lines = re.findall(r"^#+ (.*)$", page, re.MULTILINE)
    return {re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", line.lower()).strip()) for line in lines}


def test_blades_of_pages_are_accepted(root, readme, config_copy):
    """The mesh is that of the page on imports, without what a first attempt does not know."""
    mesh, variant, test = (safe_load(text) for text in re.findall(r"```yaml\n(.*?)```", readme, re.DOTALL))
    assert (
        test["measured"][0]
        in safe_load((root / "docs/measurement.md").read_text().split("```yaml\n")[1].split("```")[0])["measured"]
    )
    page = safe_load(re.search(r"```yaml\n(.*?)```", (root / "docs/your_blade.md").read_text(), re.DOTALL)[1])
    assert mesh == {"Fan": page["Fan"] | {"root": "?", "tip": "?"}}
    drawn = re.search(r"```yaml\n([^`]*Drawn:.*?)```", (root / "docs/blades.md").read_text(), re.DOTALL)[1]
    shipped = (config_copy / "config/blades.yaml").read_text()
    for text, blades in ((safe_dump(variant), "[Mine]"), (drawn, "[Mine, Stiffer, Drawn]")):
        (config_copy / "config/blades.yaml").write_text(shipped)
        overlay(config_copy, "blades.yaml", text)
        overlay(config_copy, "config.yaml", f"blades: {blades}")
        assert read_settings(config_copy).blade_names == safe_load(blades)


def test_the_image_runs_the_two_commands(root, readme):
    """It cannot be built here: what it calls is what README and Makefile have."""
    image, page = (root / "envs/Containerfile").read_text(), (root / "envs/README.md").read_text()
    commands = re.findall(r"^make (\w+)", readme, re.MULTILINE)
    assert len(commands) == 2 and all(f"make {command}" in page for command in commands)
    assert 'CMD ["make", "all_blades"]' in image and "RUN make setup" in image
    makefile = (root / "Makefile").read_text()
    assert all(re.search(rf"^(\w+ )*{target}( \w+)*:", makefile, re.MULTILINE) for target in ("setup", *commands))


def test_no_page_is_called_like_one_that_the_site_makes_itself(root):
    """Sphinx writes these over ours, without a word."""
    assert not {file.stem for file in (root / "docs").glob("*.md")} & {"search", "genindex", "py-modindex", "modindex"}


def test_readme_is_short(readme):
    assert len(readme.split()) <= 600


def test_commands_keep_the_copy_installed_as_it_is(root):
    """An installation that is not editable would replace the copy that `make setup` has installed by what it is now."""
    texts = [root / "README.md", *root.glob("docs/*.md"), *(root / "src").rglob("*.py")]
    commands = [command for text in texts for command in re.findall(r"pip install [^`\n]*\.[`'\[\n]", text.read_text())]
    assert len(commands) > 3 and all("-e" in command for command in commands), commands
