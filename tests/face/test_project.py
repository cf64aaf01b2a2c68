"""The project's own promises: pins, layers, README."""

import ast
import contextlib
import json
import os
import re
import subprocess
import tomllib
from collections import Counter
from functools import cache
from graphlib import TopologicalSorter
from importlib.metadata import PackageNotFoundError, version
from itertools import chain

import pytest
import yaml
from conftest import CHECKOUT, edited_configuration
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import r37
from r37core import __version__
from r37core.base.io import FILE_ATTRIBUTES
from r37studies.registry import FOLDERS

LAYERS = ["base", "machine_code", "blade", "mesh", "fem", "rom", "contact", "stress", "time_integration", "results", "adaptive"]
LAYERS += ["config", "plans", "sweep", "figures", "explorer", "product", "console"]
"""Packages of r37core: each may import those before it."""

MAY_IMPORT = {
    "r37core": (),
    "r37imports": ("r37core",),
    "r37studies": ("r37core",),
    "r37": ("r37core", "r37imports", "r37studies"),
}
"""Package of the distribution -> others that it may import."""


def test_the_lock_has_a_version_of_all_that_is_asked_for(root):
    """And every command that installs something takes it from there."""
    project = tomllib.loads((root / "pyproject.toml").read_text())["project"]
    pins = dict(line.split("==") for line in (root / "envs/lock.txt").read_text().splitlines() if not line.startswith("#"))
    locked = {canonicalize_name(name): version for name, version in pins.items()}
    for text in chain(project["dependencies"], *project["optional-dependencies"].values()):
        requirement = Requirement(text)
        assert requirement.specifier.contains(locked[canonicalize_name(requirement.name)]), text
    assert all("==" not in text for text in project["dependencies"])
    commands = (root / "Makefile").read_text().split("\nlock:")[0] + (root / "envs/r37.yaml").read_text()
    installing = [line for line in commands.splitlines() if "pip install" in line]
    assert len(installing) == 1 and "--constraint $(LOCK)" in installing[0]
    assert "--constraint lock.txt" in commands
    hooks = yaml.safe_load((root / ".pre-commit-config.yaml").read_text())["repos"]
    assert [hook["rev"] for hook in hooks if "ruff" in hook["repo"]] == [f"v{locked['ruff']}"]


def test_make_alone_lists_every_target(root):
    """And starts nothing."""
    targets = re.search(r"^\.PHONY: (.*)$", (root / "Makefile").read_text(), re.MULTILINE)[1].split()
    # what `make test` hands on to the make of this test
    own = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
    for command in (["make"], ["make", "help"]):
        lines = subprocess.run(command, cwd=root, env=own, capture_output=True, text=True, check=True).stdout.splitlines()
        listed = [re.fullmatch(r"make (\S+) +(\S.{5,120})", line)[1] for line in lines]
        assert sorted(listed) == sorted(targets)
    assert not (root / ".venv").exists()


def test_installed_is_what_is_locked(root):
    """In the environment that `make test` made; the reference of every number that a test compares."""
    wrong = {}
    for line in (root / "envs/lock.txt").read_text().splitlines():
        name, _, locked = line.partition("==")
        with contextlib.suppress(PackageNotFoundError):
            if locked and version(name) != locked:
                wrong[name] = version(name), locked
    assert wrong == {}, "make setup"


def test_one_version(root):
    """The package's, which is in every file, is what pip installs, what is cited and the newest one of the changes."""
    text = (root / "pyproject.toml").read_text()
    assert tomllib.loads(text)["tool"]["setuptools"]["dynamic"]["version"] == {"attr": "r37core.__version__"}
    assert "version" not in tomllib.loads(text)["project"]
    assert yaml.safe_load((root / "CITATION.cff").read_text())["version"] == __version__
    changes = re.findall(r"^## (.*)$", (root / "CHANGELOG.md").read_text(), re.MULTILINE)
    # what is not released yet stands above
    assert next(version for version in changes if version != "Unreleased") == __version__
    assert FILE_ATTRIBUTES["r37core_version"] == __version__
    # what archives and indexes of software read
    described, archived = (json.loads((root / name).read_text()) for name in ("codemeta.json", ".zenodo.json"))
    project = tomllib.loads(text)["project"]
    assert described["version"] == __version__
    assert described["keywords"] == archived["keywords"] == project["keywords"]
    assert described["license"].endswith(project["license"]) and archived["license"] == project["license"]


@pytest.mark.skipif(not os.environ.get("CI"), reason="CI=true, for what is submitted: users may edit config/")
def test_the_shipped_configuration_is_that_of_the_tests():
    assert edited_configuration() == []


@cache
def parsed(file):
    return ast.parse(file.read_text())


@cache
def imports_of(file):
    """Absolute names of what a file imports, functions' own imports included."""
    names = []
    for node in ast.walk(parsed(file)):
        names += [node.module or ""] if isinstance(node, ast.ImportFrom) and node.level == 0 else []
        names += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
    return names


def test_packages_of_the_core_import_only_those_above_them(root):
    """blade, mesh, fem, rom, ...: a package may use those above it, never one below it; Snakemake in the console."""
    core = root / "src/r37core"
    for file in core.rglob("*.py"):
        layer = file.relative_to(core).parts[0].removesuffix(".py")
        for name in imports_of(file):
            assert layer == "console" or not name.startswith(("snakemake", "workflow")), f"{file} imports {name}"
            if name.startswith("r37core.") and layer != "__init__":
                used = name.split(".")[1]
                assert LAYERS.index(used) <= LAYERS.index(layer), f"{file} imports {name}, which is below it"


@pytest.mark.parametrize("package", MAY_IMPORT)
def test_packages_import_the_core_and_not_each_other(root, package):
    """And no extension another one: what several studies share stands in the package itself."""
    folder = root / "src" / package
    for file in folder.rglob("*.py"):
        for name in imports_of(file):
            other = name.split(".")[0]
            assert other not in MAY_IMPORT or other in (package, *MAY_IMPORT[package]), f"{file} imports {name}"
            if name.startswith("r37studies.") and name.split(".")[1] in FOLDERS and package == "r37studies":
                assert name.split(".")[1] == file.relative_to(folder).parts[0], f"{file} imports {name}"


ROOMS = {"core": "r37core", "studies": "r37studies", "imports": "r37imports", "face": "r37"}
"""Folder of tests -> package that they are of; what stands next to the folders is for all of them."""


@pytest.mark.parametrize("room", [*ROOMS, ""])
def test_tests_import_what_their_package_may(room):
    """The core's tests run without the other packages; those of studies and imports without each other."""
    package = ROOMS.get(room, "r37core")
    known = {file.stem: file.parent.name for file in (CHECKOUT / "tests").rglob("*.py")}
    for file in (CHECKOUT / "tests" / room).glob("*.py"):
        for name in imports_of(file):
            other = name.split(".")[0]
            assert other not in MAY_IMPORT or other in (package, *MAY_IMPORT[package]), f"{file} imports {name}"
            of_room = ROOMS.get(known.get(name, ""), "r37core")
            assert of_room in (package, *MAY_IMPORT[package]), f"{file} imports {name}"


def test_classes_have_few_members(root):
    """Methods, properties and annotated fields: what is of one subject stands with that."""
    members = (ast.FunctionDef, ast.AsyncFunctionDef, ast.AnnAssign)
    for file in (root / "src").rglob("*.py"):
        for node in ast.walk(parsed(file)):
            if isinstance(node, ast.ClassDef):
                assert sum(isinstance(part, members) for part in node.body) <= 25, f"{file}: {node.name}"


def test_the_calls_from_python_stand_above_all_else(root):
    """r37 takes nothing of what runs or shows a whole workflow, and the workflow does not know it."""
    starts_snakemake = root / "src/r37/workflow_process.py"
    aside = ("r37core.console", "r37core.explorer", "snakemake", "workflow")
    for file in (root / "src/r37").rglob("*.py"):
        assert file == starts_snakemake or not [name for name in imports_of(file) if name.startswith(aside)], file
    for file in (root / "workflow").rglob("*.py"):
        assert not [name for name in imports_of(file) if name.split(".")[0] == "r37"], file


def test_public_names_are_those_of_the_page(root):
    """What `import r37` gives stands in docs/python.md, and is documented."""
    text = (root / "docs/python.md").read_text()
    calls = [name for name in r37.__all__ if callable(getattr(r37, name)) and not isinstance(getattr(r37, name), type)]
    assert len(calls) == 18
    assert [name for name in calls if f"`r37.{name}(" not in text or not getattr(r37, name).__doc__] == []


def test_scripts_are_thin_and_no_file_has_machine_paths(root):
    for script in (root / "workflow/scripts").glob("*.py"):
        assert len(script.read_text().splitlines()) <= 40, script
    for pattern in ("Snakefile", "Makefile", "*.md", "config/**/*.yaml", "workflow/**/*", "src/**/*.py", "docs/*"):
        for file in root.glob(pattern):
            if file.is_file() and file.suffix in {"", ".md", ".yaml", ".smk", ".py"}:
                assert not re.search(r"/(home|root|work|Users)/", file.read_text()), file


def _modules(root):
    """Dotted name -> file, of all modules of the package."""
    files = {file.relative_to(root / "src").with_suffix(""): file for file in (root / "src").rglob("*.py")}
    return {".".join(path.parts).removesuffix(".__init__"): file for path, file in files.items()}


def test_one_name_one_thing(root):
    """Public classes, modules and scripts have names of their own; where the folder is the name, files may repeat."""
    modules = _modules(root)
    classes = Counter(
        node.name
        for file in modules.values()
        for node in parsed(file).body
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    )
    files = [*modules.values(), *(root / "workflow/scripts").glob("*.py")]
    named_by_folder = [file for file in files if file.parent.name in FOLDERS]
    of_folders = ("__init__.py", "steps.py")
    stems = Counter(file.stem for file in files if file.name not in of_folders and file not in named_by_folder)
    for names, most in ((classes, 5), (stems, 10)):
        twice = {name for name, number in names.items() if number > 1}
        assert len(twice) < most, twice


def test_no_modules_import_each_other_in_a_circle(root):
    """When a module is loaded, none of those that it imports waits for it; imports for type checkers alone do not count."""
    modules = _modules(root)

    def imported(name):
        package = name if modules[name].name == "__init__.py" else name.rpartition(".")[0]
        for node in parsed(modules[name]).body:
            if isinstance(node, ast.Import):
                yield from (alias.name for alias in node.names)
            elif isinstance(node, ast.ImportFrom):
                above = package.rsplit(".", node.level - 1)[0] if node.level else ""
                module = ".".join(filter(None, (above, node.module)))
                names = [f"{module}.{alias.name}" for alias in node.names]
                yield from [name for name in names if name in modules] or [module]

    graph = {name: {one for one in imported(name) if one in modules and one != name} for name in modules}
    assert "r37core.contact.casing" in graph["r37core.contact.scene"]
    tuple(TopologicalSorter(graph).static_order())


def test_an_extension_is_one_place(root):
    """Its folder, its file of rules and its line in the registry: no other rule knows it."""
    rules = root / "workflow/rules"
    assert {f"{folder}.smk" for folder in FOLDERS} == {file.name for file in (rules / "studies").iterdir()}
    for file in [*rules.rglob("*.smk"), root / "Snakefile"]:
        names = re.findall(r"^from ([\w.]+) import", file.read_text(), re.M)
        studies = {name.split(".")[1] for name in names if name.startswith("r37studies.")} & {*FOLDERS}
        assert studies <= ({file.stem} if file.parent.name == "studies" else set()), file


VAGUE, MOST_VAGUE = ("found", "one", "given"), 1
"""Names that say nothing of a value, and how many of them the package had when they were last counted: not one more."""

TRANSLATED = {"pace", "paces", "march", "course", "stretch", "stretches", "climb", "bench"}
"""The field says constant-speed segment, time integration, schedule, segment, growth."""


def names_in(file):
    """What a file names: arguments, values, functions and classes."""
    for node in ast.walk(parsed(file)):
        if isinstance(node, ast.arg):
            yield node.arg
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name


def test_values_are_called_what_they_are(root):
    """A name is a word of the field: peaks, columns, scene in place of found, one, given."""
    names = {file: list(names_in(file)) for file in (root / "src").rglob("*.py")}
    assert sum(Counter(several)[name] for several in names.values() for name in VAGUE) <= MOST_VAGUE
    for file, several in names.items():
        words = {word.lower() for name in several for word in re.findall(r"[A-Z]?[a-z]+", name)}
        assert not words & TRANSLATED, file
