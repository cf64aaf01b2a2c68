"""The tutorial and the documentation site. Both need the extra `docs`: make site."""

import inspect
import re
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from browser import opened

import r37


def need(*packages):
    """Skip the test unless these packages of the extra `docs` are installed."""
    for name in packages:
        pytest.importorskip(name, reason="the packages of the site (make site)")


def test_the_notebook_is_that_of_the_script(root):
    """`make validation` renews it."""
    need("nbformat", "jupytext")
    import jupytext
    import nbformat

    notebook = nbformat.read(root / "docs/tutorial.ipynb", as_version=4)
    script = jupytext.read(root / "docs/tutorial.py")
    assert [cell.source for cell in notebook.cells] == [cell.source for cell in script.cells]
    assert all(cell.execution_count for cell in notebook.cells if cell.cell_type == "code")


BUILD = """
import gc, os, sys
from importlib import import_module
for name in ("sphinx.builders.html", "sphinx.cmd.build", "sphinx.ext.autodoc", "myst_nb", "furo", "ziamath"):
    import_module(name)
# a build ends before its garbage matters
gc.disable()
for number, folder in enumerate(sys.argv[1::2], 1):
    if os.fork() == 0:
        os.chdir(folder)
        os.dup2(os.open(sys.argv[2 * number] + ".txt", os.O_CREAT | os.O_WRONLY), 2)
        options = ["--quiet", "--fail-on-warning", "--keep-going", "--conf-dir", "docs/site"]
        status = sys.modules["sphinx.cmd.build"].main([*options, "docs", sys.argv[2 * number]])
        sys.stderr.flush()
        os._exit(status)
    print(os.waitstatus_to_exitcode(os.wait()[1]))
"""
"""Sites of several folders, as make site builds them, by one import of Sphinx: folder, site, folder, ..."""


@pytest.fixture(scope="module")
def built(root, tmp_path_factory):
    """Site, exit status and errors: of the project, and of one page that links to a heading that is not there."""
    need("sphinx", "myst_nb", "furo", "ziamath")
    made = tmp_path_factory.mktemp("made")
    broken = made / "broken"
    shutil.copytree(root / "docs/site", broken / "docs/site")
    shutil.copytree(root / "src/r37core/contact", broken / "src/r37core/contact")
    shutil.copytree(root / "validation/evidence", broken / "validation/evidence")
    (broken / "docs/index.md").write_text("# One\n\n[two](index.md#three)\n")
    sites = {root: made / "site", broken: made / "site_of_broken"}
    command = [sys.executable, "-c", BUILD, *(str(path) for pair in sites.items() for path in pair)]
    statuses = subprocess.run(command, stdout=subprocess.PIPE, text=True, timeout=900, check=True).stdout.split()
    return [(site, int(status), Path(f"{site}.txt").read_text()) for site, status in zip(sites.values(), statuses, strict=True)]


@pytest.mark.slow
def test_the_site_is_built_without_a_warning_and_opens_offline(built):
    site, status, errors = built[0]
    assert status == 0, errors
    pages = {file.relative_to(site).as_posix() for file in site.rglob("*.html")}
    assert {"index.html", "tutorial.html", "gallery.html", "api.html", "api/r37.html", "api/r37core.contact.html"} <= pages
    calls = {f"api/r37.{name}.html" for name in r37.__all__ if callable(getattr(r37, name))}
    assert {name for name in pages if name.startswith("api/r37.")} == {"api/r37.html", *calls}
    with opened(site / "index.html", {"width": 1400, "height": 900}) as page:
        page.locator("input.sidebar-search").fill("abradable")
        page.locator("input.sidebar-search").press("Enter")
        page.locator("#search-results ul.search li").first.wait_for()
        for name in ("api/r37core.rom.html", "tutorial.html", "architecture.html"):
            page.goto((site / name).as_uri())
            assert page.locator("h1").count()
        page.goto((site / "changelog.html").as_uri())
        assert page.title() == f"Changelog - r37 {r37.__version__}"
        # below what is not released yet
        assert any(title.startswith(r37.__version__) for title in page.locator("h2").all_inner_texts()[:2])
        page.goto((site / "api/r37.sweep.html").as_uri())
        signature = page.locator("dt.sig").inner_text()
        assert "speeds_rpm" in signature and "cores: int" in signature and "options" not in signature
        assert page.locator("dd a[href='r37.simulate.html#r37.simulate']").count()
        page.locator(".viewcode-link").first.click()
        line = page.url.rpartition("#")[2]
        assert "def sweep(" in page.locator("pre").inner_text().split("\n")[int(line) :][0]
        page.goto((site / "simulation.html").as_uri())
        drawn = page.locator(".equation svg").evaluate_all("all => all.map(one => one.getBoundingClientRect().width)")
        assert len(drawn) >= 5
        assert min(drawn) > 50
        page.goto((site / "index.html").as_uri())
        page.locator("article a", has_text="the explorer").click()
        page.wait_for_selector("html[data-ready]")
        assert "seven" in page.locator("h1").inner_text()
        page.goto((site / "tables/index.html").as_uri())
        page.locator("article td a").first.click()
        assert page.locator("h1").inner_text().startswith("Table: ")
        assert page.locator("article tbody tr").count()
        command = "snakemake -s validation/Snakefile --cores 2 --resources mem_mb=4600 results/evidence/stamps/"
        assert command in page.locator("article").inner_text()
        assert page.problems == []


@pytest.mark.slow
def test_words_of_a_page_lead_to_it_in_the_search(built, root):
    site = built[0][0]
    words = runpy.run_path(str(root / "docs/site/search_words.py"))["WORDS"]
    with opened(site / "search.html", {"width": 1400, "height": 900}) as page:
        for name in words.keys() & {file.stem for file in site.glob("*.html")}:
            for query in words[name].split(", "):
                page.goto(f"{(site / 'search.html').as_uri()}?q={query}")
                first = page.locator("#search-results ul.search li a").first
                assert first.get_attribute("href") == f"{name}.html", query


SMALL = """() => [...document.querySelectorAll(".picture:not(a *) img")]
    .filter(image => image.clientWidth < parseFloat(image.style.minWidth)).map(image => image.src)"""
"""Pictures whose letters are smaller than docs/site/pictures.py lets them be."""

SIDEWAYS = """() => Math.max(
    ...[...document.querySelectorAll("html, body, .content")].map(box => box.scrollWidth - box.clientWidth))"""
"""How far a page scrolls sideways (px), in the theme's box, too."""


@pytest.mark.slow
def test_pages_on_a_phone_have_legible_pictures_and_do_not_scroll_sideways(built):
    site = built[0][0]
    pages = [*site.glob("*.html"), *site.glob("api/*.html")]
    with opened(site / "index.html", {"width": 390, "height": 800}, color_scheme="dark") as page:
        for file in pages:
            page.goto(file.as_uri())
            assert page.evaluate(SIDEWAYS) == 0, file
            assert page.evaluate(SMALL) == [], file
        page.goto((site / "gallery.html").as_uri())
        for kind, change in {"drawing": "invert", "rendering": "brightness"}.items():
            assert page.locator(f".{kind} img").first.evaluate("image => getComputedStyle(image).filter").startswith(change)


@pytest.mark.parametrize(("colours", "drawing"), [([0] * 8, True), (range(0, 256, 4), False)])
def test_only_pictures_of_few_colours_are_inverted_on_a_dark_page(root, colours, drawing):
    image = pytest.importorskip("PIL.Image")
    is_drawing = runpy.run_path(str(root / "docs/site/pictures.py"))["is_drawing"]
    picture = image.new("RGBA", (400, 100), "white")
    for column, grey in enumerate(colours):
        picture.paste((grey, grey, grey), (2 * column, 0, 2 * column + 2, 100))
    assert is_drawing(picture) == drawing


@pytest.mark.slow
def test_a_broken_link_is_refused(built):
    _, status, errors = built[1]
    assert status
    assert "three" in errors


def formulas(page):
    """LaTeX of a page's equations, displayed and in a line."""
    text = re.sub(r"^ *```.*?^ *```|`[^`]*`", "", page, flags=re.DOTALL | re.MULTILINE)
    return [one for pair in re.findall(r"\$\$(.+?)\$\$|\$([^$]+)\$", text, re.DOTALL) for one in pair if one]


@pytest.fixture
def drawing(root):
    need("sphinx", "ziamath")
    return runpy.run_path(str(root / "docs/site/equations.py"))["drawing"]


def test_every_equation_can_be_drawn(root, drawing):
    found = {page.name: formulas(page.read_text()) for page in (root / "docs").glob("*.md")}
    assert sum(map(len, found.values())) > 20
    for name, equations in found.items():
        for latex in equations:
            assert "<path" in drawing(latex, inline=False), name


def test_an_unknown_command_of_latex_is_refused(drawing):
    from sphinx.errors import SphinxError

    with pytest.raises(SphinxError, match="nosuchcommand"):
        drawing(r"a + \nosuchcommand{b}", inline=True)


def test_every_page_is_in_the_site(root):
    index = (root / "docs/index.md").read_text()
    for page in (root / "docs").glob("*.md"):
        assert page.stem == "index" or f"]({page.name})" in index.partition("## All pages")[2], page.name


@pytest.mark.parametrize("name", [name for name in r37.__all__ if callable(getattr(r37, name))])
def test_docstrings_have_purpose_results_and_errors(name):
    value = getattr(r37, name)
    text = inspect.getdoc(value)
    assert text.split("\n\n")[0].endswith(".")
    if not isinstance(value, type):
        assert all(f"\n\n{section}:\n" in text for section in ("Args", "Returns", "Raises", "Examples"))


def test_links_lead_to_pages_of_the_site(root):
    """By words; tables and numbers to tables, the explorer to itself. Other files are no links."""
    adapt = runpy.run_path(str(root / "docs/site/repository_links.py"))["adapt"]
    pages = {
        "See [your_blade.md](your_blade.md#a). [speed.md](speed.md) and [`config.yaml`](../config/config.yaml).": (
            "See [your blade](your_blade.md#a). [Speed](speed.md) and `config.yaml`."
        ),
        "[All](../validation/tables/a.csv), [more](../validation/tables).": "[All](tables/a.md), [more](tables/index.md).",
        "0.5<!--a:Ref:b:1-->% of [7<!--a:S50:b-->](c.md)": "[0.5](tables/a.md){.number}% of [7<!--a:S50:b-->](c.md)",
        "[it](results.md#the-explorer)": "[it](site:explorer.html)",
        "![It](explorer.png)": "[![It](explorer.png)](site:explorer.html)",
        "## All pages\n\n- **Start**: [one](one.md), [two](two.ipynb)\n": (
            "```{toctree}\n:hidden:\n:caption: Start\none\ntwo\n```\n\n"
        ),
    }
    for text, adapted in pages.items():
        source = [text]
        adapt(None, "page", source)
        assert source == [adapted]


def test_a_table_has_the_sentences_that_rest_on_it(root):
    statements = runpy.run_path(str(root / "docs/site/table_pages.py"))["statements"]
    page = """**Peaks move by 3<!--peaks:Ref:change-->%.** Nothing else does ([all](../validation/tables/others.csv)).

- At `draft` they [move more](../validation/tables/peaks.csv).
"""
    assert list(statements(page, "peaks")) == ["Peaks move by 3%.", "At draft they move more."]
    assert list(statements(page, "others")) == ["Nothing else does (all)."]
