"""Code hashes: what a rule's script imports and nothing else, without comments and docstrings."""

import dis
import functools
import inspect
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from r37core.base.packages import PACKAGES
from r37core.machine_code import kept
from r37core.plans import code as code_module
from r37core.plans.code import CodeHashes
from r37core.plans.sweep_plan import Sweep
from r37core.product.extensions import read_settings
from r37core.product.targets import FIGURES, drawing

SCRIPT = "from job import run\nfrom r37core.a import f\n"


@pytest.fixture
def tree(tmp_path):
    """A script that imports a package in every way there is."""
    files = {
        "scripts/job.py": "import os\n",
        "scripts/one.py": SCRIPT,
        "scripts/step.py": "import job\n",
        "src/r37core/__init__.py": "__version__ = '1'\n",
        "src/r37core/a.py": "from .b.c import g\n\n\ndef f():\n    from r37core import late\n    return late, g\n",
        "src/r37core/late.py": "import r37core.b.d as d\n",
        "src/r37core/b/__init__.py": "",
        "src/r37core/b/c.py": "from ..e import h as g\n",
        "src/r37core/b/d.py": "x = 1\n\n\n@keep\ndef f(a, b=0, *, c=''):\n    return a + b if a < b else c\n",
        "src/r37core/e.py": "from r37core.b import c\nh = 1\n",
        "src/r37core/other.py": "y = 1\n",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def hashes(tree):
    for cached in (code_module._facts_of_files().of, code_module.module_files):
        cached.cache_clear()
    return CodeHashes(tree / "src", tree / "scripts")


def test_closure_follows_every_kind_of_import(tree):
    found = {str(file.relative_to(tree)) for file in hashes(tree).closure("one")}
    core = {"a.py", "late.py", "b/__init__.py", "b/c.py", "b/d.py", "e.py"}
    assert found == {"scripts/one.py", "scripts/job.py", *(f"src/r37core/{name}" for name in core)}


@pytest.mark.parametrize(
    ("file", "old", "new", "counts"),
    [
        ("scripts/one.py", SCRIPT, '"""What it does."""\n\n' + SCRIPT + "# the end\n", False),
        ("src/r37core/a.py", "    return late, g", '    """Docstring."""\n\n    return (late,\n        g)  # both', False),
        ("src/r37core/b/d.py", "x = 1", "x = 1\n'''What x is.'''", False),
        ("src/r37core/b/d.py", "x = 1", "x = 2", True),
        ("src/r37core/b/d.py", "x = 1", "y = 1", True),
        ("src/r37core/b/d.py", "a + b", "a - b", True),
        ("src/r37core/b/d.py", "a < b", "a <= b", True),
        ("src/r37core/b/d.py", "0", "None", True),
        ("src/r37core/b/d.py", "@keep\n", "", True),
        ("src/r37core/b/d.py", "b=0", "b=1", True),
        ("src/r37core/b/d.py", "b=0", "b", True),
        ("src/r37core/b/d.py", "c=''", "c", True),
        ("src/r37core/b/d.py", "a, b", "b, a", True),
        ("src/r37core/b/__init__.py", "", "z = 1\n", True),
        ("src/r37core/e.py", "h = 1", "h = 'text'", True),
        ("src/r37core/other.py", "y = 1", "y = 2", False),
        ("src/r37core/__init__.py", "'1'", "'2'", False),
    ],
)
def test_what_counts(tree, file, old, new, counts):
    before = hashes(tree)("one")
    text = (tree / file).read_text()
    assert old in text
    (tree / file).write_text(text.replace(old, new, 1))
    assert (hashes(tree)("one") != before) == counts


@pytest.mark.parametrize("damage", [lambda file: file.unlink(), lambda file: file.write_bytes(file.read_bytes()[:-7])])
def test_what_is_kept_of_files_may_be_lost_or_damaged(tree, tmp_path, monkeypatch, damage):
    monkeypatch.setattr(kept, "_folder", lambda: tmp_path)
    monkeypatch.setattr(code_module, "_facts_of_files", functools.cache(code_module._FactsOfFiles))
    before = hashes(tree)("one")
    code_module._facts_of_files.cache_clear()
    with monkeypatch.context() as patch:
        patch.setattr(code_module.ast, "parse", None)
        assert hashes(tree)("one") == before
    code_module._facts_of_files.cache_clear()
    damage(tmp_path / "code_hashes.json")
    assert hashes(tree)("one") == before


def test_what_is_kept_makes_no_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(kept, "_folder", lambda: tmp_path)
    put, seen = kept._put, []
    monkeypatch.setattr(kept, "_put", lambda made, file: (seen.extend(map(Path.is_file, tmp_path.iterdir())), put(made, file)))
    kept.keep(b"1", "one.json")
    assert seen and all(seen), "a walk through the package's files ends where a folder vanishes"
    assert kept.read_kept("one.json") == b"1"
    assert {path.name for path in tmp_path.iterdir()} == {"one.json", "one.json.sha256"}


STEPS = """
from r37core.a import f
from r37core.b import c, d
import r37core.other as others

LEVEL = 3


def first(input, output, params):
    return f(_level())


def second(input, output, params):
    return d.f(others.y)


def _level():
    return LEVEL
"""


@pytest.mark.parametrize(
    ("file", "old", "new", "first", "second"),
    [
        ("steps.py", "f(_level())", "f(_level() + 1)", True, False),
        ("steps.py", "LEVEL = 3", "LEVEL = 4", True, False),
        ("steps.py", "return LEVEL", "return LEVEL + 1", True, False),
        ("steps.py", "others.y", "others.z", False, True),
        ("steps.py", "LEVEL = 3", "LEVEL = 3\nUNUSED = 4", False, False),
        ("steps.py", "LEVEL = 3", "LEVEL = 3\nc.x = 4", True, True),
        ("a.py", "return late, g", "return g", True, False),
        ("late.py", "as d", "as e", True, False),
        ("other.py", "y = 1", "y = 2", False, True),
        ("b/d.py", "x = 1", "x = 2", True, True),
        ("b/__init__.py", "", "z = 1\n", True, True),
    ],
)
def test_of_a_step_only_what_it_uses_counts(tree, file, old, new, first, second):
    def both():
        return [hashes(tree).step(f"r37core.steps.{name}") for name in ("first", "second")]

    (tree / "src/r37core/steps.py").write_text(STEPS)
    before = both()
    assert [one["step"] for one in before] == ["r37core.steps.first", "r37core.steps.second"]
    edited = tree / "src/r37core" / file
    assert old in edited.read_text()
    edited.write_text(edited.read_text().replace(old, new, 1))
    assert [one != other for one, other in zip(before, both(), strict=True)] == [first, second]


def test_a_figure_s_parameters_have_the_code_of_its_module(root):
    code = CodeHashes(root / "src", root / "workflow/scripts")
    step = "r37core.figures.steps.draw"
    (wear,) = (figure for figure in FIGURES if figure.rule == "wear_figure")
    made = drawing(code, None, wear, Sweep(read_settings(root)))
    assert made["code"] == code("step", step, "r37core.figures.maps") != code("step", step)
    names = {file.name for file in code.closure("step", step, "r37core.figures.maps")}
    assert "maps.py" in names
    assert not {"comparison.py", "response_curves.py", "blade_shapes.py"} & names


def modules_used(function):
    """Modules of the package whose objects a function uses, directly or by others of its own module, from its bytecode."""
    waiting, found, seen = [function.__code__], set(), set()
    while waiting:
        code = waiting.pop()
        seen.add(code)
        waiting += [one for one in code.co_consts if inspect.iscode(one)]
        names = {one.argval for one in dis.get_instructions(code) if one.opname == "LOAD_GLOBAL"}
        for value in filter(None, map(function.__globals__.get, names)):
            module = getattr(value, "__name__" if inspect.ismodule(value) else "__module__", None) or ""
            if module == function.__module__ and inspect.isfunction(value):
                waiting += {value.__code__} - seen
            elif module.split(".")[0] in PACKAGES:
                found.add(module)
    return found


STEPS_LOADED = (
    "r37core.time_integration.speed_job.prepare",
    "r37core.results.steps.response",
    "r37core.fem.steps.mesh",
    "r37core.results.steps.summary",
    "r37core.time_integration.speed_job.simulate",
)


@pytest.mark.slow
def test_the_closure_has_all_that_python_loads(root, names=STEPS_LOADED):
    # as Python names the files: `src` is a link
    core = (root / "src/r37core").resolve()
    code = CodeHashes(core.parent, root / "workflow/scripts")
    for name in names:
        module, function = name.rsplit(".", 1)
        text = "".join(f"import {used}\n" for used in modules_used(getattr(import_module(module), function)))
        text += f"import sys\npackages = {PACKAGES}\n"
        text += "print(*(module.__file__ for name, module in sys.modules.items() if name.split('.')[0] in packages))"
        files = subprocess.run([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True, check=True).stdout.split()
        loaded = {*files} - {str(core / "__init__.py"), "None"}
        assert len(loaded) > 3
        assert loaded <= {str(file) for file in code.closure(name)}, name


def test_stages_do_not_share_more_than_they_need(root):
    """A new figure re-runs no simulation, a new time integration no mesh, and the models of the configuration neither."""
    code = CodeHashes(root / "src", root / "workflow/scripts")
    for name, others in {
        "r37core.fem.steps.mesh": "time_integration contact results figures trials config workflow",
        "r37core.time_integration.speed_job.simulate": "mesh fem blade results figures trials config workflow",
        "r37core.results.steps.response": "figures trials config workflow",
    }.items():
        assert not {*others.split()} & {file.parent.name for file in code.closure(name)}, name
