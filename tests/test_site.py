"""The tutorial and the documentation site. Both need the extra `docs`: make site."""

import re
import runpy
import shutil
import subprocess
import sys

import pytest
from browser import opened


def need(*packages):
    """Skip the test unless these packages of the extra `docs` are installed."""
    for name in packages:
        pytest.importorskip(name, reason="the packages of the site (make site)")


@pytest.fixture
def notebook(root):
    need("nbformat")
    import nbformat

    return nbformat.read(root / "docs/tutorial.ipynb", as_version=4)


def test_the_notebook_is_that_of_the_script(root, notebook):
    """`make tutorial` renews it."""
    need("jupytext")
    import jupytext

    script = jupytext.read(root / "docs/tutorial.py")
    assert [cell.source for cell in notebook.cells] == [cell.source for cell in script.cells]
    assert all(cell.execution_count for cell in notebook.cells if cell.cell_type == "code")


@pytest.mark.slow
def test_the_tutorial_runs_and_finds_what_it_shows(root, notebook):
    need("jupytext", "nbclient", "ipykernel")
    again = runpy.run_path(str(root / "benchmarks/tutorial.py"))["executed"]()

    def printed(one):
        return [output.text for cell in one.cells for output in cell.get("outputs", []) if output.output_type == "stream"]

    def worst(one):
        return re.search(r"the largest stress at (\d+) rad/s", "".join(printed(one)))[1]

    assert len(printed(again)) == len(printed(notebook))
    # a run so close to a drop is chaotic: the digits of stress may differ on another machine
    assert abs(float(worst(again)) - float(worst(notebook))) <= 4.0


def build(root, site):
    """The site, as make site builds it."""
    options = ["--quiet", "--fail-on-warning", "--keep-going", "--conf-dir", "docs/site"]
    command = [sys.executable, "-m", "sphinx", *options, "docs", str(site)]
    return subprocess.run(command, cwd=root, capture_output=True, text=True, timeout=900, check=False)


@pytest.mark.slow
def test_the_site_is_built_without_a_warning_and_opens_offline(root, tmp_path):
    need("sphinx", "myst_nb", "furo", "ziamath")
    site = tmp_path / "site"
    done = build(root, site)
    assert done.returncode == 0, done.stdout + done.stderr
    pages = {file.relative_to(site).as_posix() for file in site.rglob("*.html")}
    assert {"index.html", "tutorial.html", "gallery.html", "api.html", "api/r37.html", "api/r37core.contact.html"} <= pages
    with opened(site / "index.html", {"width": 1400, "height": 900}) as page:
        page.locator("input.sidebar-search").fill("abradable")
        page.locator("input.sidebar-search").press("Enter")
        page.locator("#search-results ul.search li").first.wait_for()
        for name in ("api/r37core.rom.html", "tutorial.html", "architecture.html"):
            page.goto((site / name).as_uri())
            assert page.locator("h1").count()
        page.goto((site / "simulation.html").as_uri())
        drawn = page.locator(".equation svg").evaluate_all("all => all.map(one => one.getBoundingClientRect().width)")
        assert len(drawn) >= 5
        assert min(drawn) > 50
        assert page.problems == []


@pytest.mark.slow
def test_a_broken_link_is_refused(root, tmp_path):
    """A link to a heading that is not there, in a site of one page."""
    need("sphinx", "myst_nb", "furo", "ziamath")
    (tmp_path / "docs").mkdir()
    shutil.copytree(root / "docs/site", tmp_path / "docs/site")
    shutil.copytree(root / "src/r37core/contact", tmp_path / "src/r37core/contact")
    (tmp_path / "docs/index.md").write_text("# One\n\n[two](index.md#three)\n")
    done = build(tmp_path, tmp_path / "site")
    assert done.returncode
    assert "three" in done.stderr


def formulas(page):
    """LaTeX of a page's equations, displayed and in a line."""
    text = re.sub(r"^ *```.*?^ *```|`[^`]*`", "", page, flags=re.DOTALL | re.MULTILINE)
    return [one for pair in re.findall(r"\$\$(.+?)\$\$|\$([^$]+)\$", text, re.DOTALL) for one in pair if one]


def test_every_equation_can_be_drawn(root):
    need("sphinx", "ziamath")
    drawing = runpy.run_path(str(root / "docs/site/equations.py"))["drawing"]
    found = {page.name: formulas(page.read_text()) for page in (root / "docs").glob("*.md")}
    assert sum(map(len, found.values())) > 20
    for name, equations in found.items():
        for latex in equations:
            assert "<path" in drawing(latex, inline=False), name


def test_an_unknown_command_of_latex_is_refused(root):
    need("sphinx", "ziamath")
    from sphinx.errors import SphinxError

    drawing = runpy.run_path(str(root / "docs/site/equations.py"))["drawing"]
    with pytest.raises(SphinxError, match="nosuchcommand"):
        drawing(r"a + \nosuchcommand{b}", inline=True)


def test_every_page_is_in_the_site(root):
    """Pages that nobody finds are lost."""
    index = (root / "docs/index.md").read_text()
    for page in (root / "docs").glob("*.md"):
        assert page.stem == "index" or re.search(rf"^{page.stem}$|<{page.stem}>$", index, re.MULTILINE), page.name


def test_pages_are_named_by_words_and_other_files_are_no_links(root):
    adapt = runpy.run_path(str(root / "docs/site/repository_links.py"))["adapt"]
    text = ["See [your_blade.md](your_blade.md#a). [speed.md](speed.md) and [`config.yaml`](../config/config.yaml)."]
    adapt(None, "page", text)
    assert text == ["See [your blade](your_blade.md#a). [Speed](speed.md) and `config.yaml`."]


def test_the_graph_of_rules_becomes_a_table(root):
    adapt = runpy.run_path(str(root / "docs/site/repository_links.py"))["adapt"]
    text = ["```mermaid\nflowchart LR\n    mesh --> model\n    mesh --> deck\n```"]
    adapt(None, "page", text)
    assert text == ["| rule | its results go to |\n|---|---|\n| `mesh` | `model`, `deck` |"]
