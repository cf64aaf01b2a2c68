"""What many tests share: a clean project, the reference blade, a coarse mesh, its matrices and its reduced model."""

import contextlib
import filecmp
import io
import json
import os
import shutil
import signal
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import browser
import pytest
from guard import RUN, start_guard
from hypothesis import settings
from warm_snakemake import start_for_call
from workflow_runs import copy_finished, copy_project

# a busy machine is no error
settings.register_profile("no_deadline", deadline=None)
settings.load_profile("no_deadline")

for library in ("OPENBLAS", "OMP", "MKL"):
    os.environ[f"{library}_NUM_THREADS"] = "1"

# two runs have the same bytes when they have the same date
os.environ["SOURCE_DATE_EPOCH"] = "1000000000"

CHECKOUT = Path(__file__).parent.parent
CONFIGURATION = Path(__file__).parent / "config"
DELIVERED = ("docs", "envs", "examples", "profiles", "validation", "workflow", "pyproject.toml", "CITATION.cff")
DELIVERED += ("Makefile", "MANIFEST.in", "Snakefile", "CHANGELOG.md", "CONTRIBUTING.md", "README.md")
DELIVERED += ("codemeta.json", ".zenodo.json", "CODE_OF_CONDUCT.md", ".pre-commit-config.yaml")


def edited_configuration():
    """Files of `config/` that differ from those of the tests, are missing or are new.

    The schemas are generated; files of one's own (.gitignore) and README.md count for nothing.
    """
    folders = (CONFIGURATION, CHECKOUT / "config")
    files = {str(file.relative_to(folder)) for folder in folders for file in folder.rglob("*.*")}
    files = {file for file in files if not file.startswith(("schemas", "my", "own/", "README.md"))}
    return sorted(files.difference(filecmp.cmpfiles(*folders, files, shallow=False)[0]))


CACHE = "R37_CACHE"
"""Environment variable with the user's cache folder."""


class Terminal(io.StringIO):
    def isatty(self):
        return True


DURATIONS = Path(__file__).with_name("durations.json")
"""Seconds of every test file in a run of all tests, those of validation/tests, too: see `--record-durations`."""


def pytest_addoption(parser):
    parser.addoption("--record-durations", action="store_true", help=f"write {DURATIONS.name}, which the order follows")


def pytest_collection_modifyitems(items):
    """The longest files first, so that at the end no core waits for one of them; new ones first of all.

    A test of a page in the browser, or of the sweep by Snakemake, is slow.
    """
    for item in items:
        if {"page", "small_sweep"}.intersection(item.fixturenames):
            item.add_marker("slow")
    seconds = json.loads(DURATIONS.read_text())
    items.sort(key=lambda item: -seconds.get(item.path.name, float("inf")))


def pytest_configure(config):
    # processes of this run that start later have them from their environment: one browser, and one cache of structures
    if not hasattr(config, "workerinput"):
        config.guard = start_guard()
        os.environ[CACHE] = os.path.join(os.environ[RUN], "cache")


def pytest_unconfigure(config):
    if not hasattr(config, "workerinput"):
        browser.close()


def seconds_by_file(reports):
    """Seconds of the files' tests with their set-up and end, the longest first."""
    seconds = Counter()
    for report in (report for several in reports.values() for report in several if isinstance(report, pytest.TestReport)):
        seconds[Path(report.location[0]).name] += report.duration
    return {name: round(duration, 1) for name, duration in seconds.most_common()}


def pytest_terminal_summary(terminalreporter):
    """What the skipped tests need, where the time went, and whether the configuration in use is not the tests'."""
    reasons = Counter(report.longrepr[2].removeprefix("Skipped: ") for report in terminalreporter.stats.get("skipped", []))
    for reason, tests in sorted(reasons.items()):
        terminalreporter.write_line(f"not run: {tests} {'test needs' if tests == 1 else 'tests need'} {reason}")
    by_file = seconds_by_file(terminalreporter.stats)
    terminalreporter.section("slowest 25 files")
    for name, seconds in list(by_file.items())[:25]:
        terminalreporter.write_line(f"{seconds:8.1f} s {name}")
    if terminalreporter.config.getoption("--record-durations"):
        seconds = Counter(json.loads(DURATIONS.read_text()) | by_file)
        DURATIONS.write_text(json.dumps(dict(seconds.most_common()), indent=1) + "\n")
    if edited := edited_configuration():
        terminalreporter.write_line(f"config/ is edited ({', '.join(edited)}): the tests use tests/config/ instead")


@pytest.fixture(scope="session")
def root(tmp_path_factory):
    """The project as it was delivered: no results, and the tests' own configuration, whatever lies in the checkout.

    `src` is a link: the package there is the imported one.
    """
    folder = tmp_path_factory.mktemp("project")
    for name in DELIVERED:
        (shutil.copytree if (CHECKOUT / name).is_dir() else shutil.copy)(CHECKOUT / name, folder / name)
    shutil.copytree(CONFIGURATION, folder / "config")
    shutil.copytree(CHECKOUT / "config/schemas", folder / "config/schemas")
    (folder / "src").symlink_to(CHECKOUT / "src")
    return folder


@pytest.fixture(scope="session", autouse=True)
def elsewhere(tmp_path_factory):
    """A working directory without results: no test sees those of the checkout."""
    with contextlib.chdir(tmp_path_factory.mktemp("elsewhere")):
        yield


@pytest.fixture(autouse=True)
def process_as_before():
    """Figures are closed, and a broken pipe raises again: gmsh.initialize of a page lets it end the process."""
    yield
    if pyplot := sys.modules.get("matplotlib.pyplot"):
        pyplot.close("all")
    signal.signal(signal.SIGPIPE, signal.SIG_IGN)


@pytest.fixture(scope="session")
def settings(root):
    from r37core.product.extensions import read_settings

    return read_settings(root)


@pytest.fixture(scope="session")
def steel(settings):
    return settings.blades["Ref"].material


@pytest.fixture(scope="session")
def profiles(settings):
    """Profiles of the reference blade, from hub to tip."""
    from r37core.blade.profile import Profile

    return [Profile(parameters) for parameters in settings.blades["Ref"].definition.profiles]


@pytest.fixture(scope="session")
def blade(settings):
    return settings.blades["Ref"].definition.build(round_edges=True)


@pytest.fixture(scope="session")
def mesh(blade):
    from r37core.mesh.generate import generate_mesh

    return generate_mesh(blade, nodes=2500, layers=1, tip_elements=14)


@pytest.fixture(scope="session")
def matrices(mesh, steel):
    from r37core.fem.matrices import assemble

    return assemble(mesh, steel)


@pytest.fixture(scope="session")
def boundary(settings):
    return settings.boundary_choice("Ref")


@pytest.fixture(scope="session")
def reduction(settings):
    return settings.reduction_choice("Ref")


@pytest.fixture(scope="session")
def reduced(mesh, matrices, steel, settings, boundary, reduction):
    """Reduced models of the mesh, with stress at nodes; `others`: numbers of another reduction."""
    from r37core.rom.reduce import reduce_blade

    def model(boundary=boundary, regions=None, **others):
        shipped = settings.stress_regions("Ref").items()
        regions = regions or {name: replace(region, integration_points=False) for name, region in shipped}
        return reduce_blade(mesh, matrices, steel, boundary, replace(reduction, **others), regions)

    return model


@pytest.fixture(scope="session")
def model(reduced):
    return reduced()


@pytest.fixture(scope="session")
def whole(reduced):
    """The reduced model that gives the displacement of every node."""
    return reduced(recover_whole_blade=True)


@pytest.fixture(scope="session")
def displaced(reduced):
    """The reduced model with displacements of second order, of every node."""
    return reduced(kinematics="quadratic", recover_whole_blade=True)


@pytest.fixture(scope="session")
def contact(model):
    from r37core.rom.reduced_model import contact_model

    return contact_model(model, "pressure_edge")


@pytest.fixture(scope="session")
def small_sweep(root, tmp_path_factory):
    """The project after the one real sweep of this test run, to be read: see `sweep_copy` and `structure_copy`."""
    from shared_sweep import made_once, make_sweep

    return made_once(tmp_path_factory, "small_sweep", lambda folder: make_sweep(root, folder))


@pytest.fixture(scope="session")
def config(root, tmp_path_factory):
    """The config.yaml of a project with the small sweep of which nothing is made, to be read."""
    folder = tmp_path_factory.mktemp("small")
    copy_project(root, folder)
    return folder / "config/config.yaml"


@pytest.fixture(scope="session")
def warm_calls():
    """Calls of r37 that run the workflow fork Snakemake: see tests/warm_snakemake.py."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("r37.workflow_process.start", start_for_call)
        yield


@pytest.fixture
def sweep_copy(small_sweep, tmp_path):
    return copy_finished(small_sweep, tmp_path / "sweep")


@pytest.fixture
def structure_copy(small_sweep, tmp_path):
    from shared_sweep import copy_structure

    return copy_structure(small_sweep, tmp_path / "structure")


@pytest.fixture
def config_copy(root, tmp_path):
    shutil.copytree(root / "config", tmp_path / "config")
    return tmp_path


@pytest.fixture
def with_blades(config_copy):
    """Settings of a copy, with some text added to blades.yaml and, if given, a table of designs and other changes."""
    from r37core.config import command_line_document
    from r37core.product.extensions import read_settings

    def read(text, table="", **changes):
        with open(config_copy / "config/blades.yaml", "a") as stream:
            stream.write(f"\n{text}\n")
        (config_copy / "config/designs.csv").write_text(table)
        return read_settings(config_copy, command_line_document(changes))

    return read


@pytest.fixture
def project(root, tmp_path):
    copy_project(root, tmp_path)
    return tmp_path
