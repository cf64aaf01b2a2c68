"""The tutorial and the documentation site. Both need the extra `docs`: make site."""

import os
import re
import runpy
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


@pytest.mark.slow
def test_the_site_is_built_without_a_warning_and_opens_offline(root, tmp_path):
    need("mkdocs", "material", "mkdocstrings")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(tmp_path / "site")]
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    done = subprocess.run(command, cwd=root, env=environment, capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "WARNING" not in done.stderr
    pages = {file.relative_to(tmp_path / "site").as_posix() for file in (tmp_path / "site").rglob("*.html")}
    assert {"index.html", "tutorial.html", "gallery.html", "api/index.html", "api/contact.html"} <= pages
    with opened(tmp_path / "site/index.html", {"width": 1400, "height": 900}) as page:
        for _ in range(20):  # what is typed before the page listens is lost
            page.locator("input.md-search__input").fill("")
            page.locator("input.md-search__input").press_sequentially("abradable")
            page.wait_for_timeout(2000)
            if page.locator(".md-search-result__item").count():
                break
        assert page.locator(".md-search-result__item").first.is_visible()
        for name in ("api/rom.html", "tutorial.html", "architecture.html"):
            page.goto((tmp_path / "site" / name).as_uri())
            assert page.locator("h1").count()
        assert page.problems == []


def test_every_page_is_in_the_site(root):
    """Pages that nobody finds are lost."""
    configured = (root / "mkdocs.yml").read_text()
    for page in (root / "docs").glob("*.md"):
        assert re.search(rf"- {re.escape(page.name)}$", configured, re.MULTILINE), page.name
