"""Every rule runs again for the code of its step, and for no other."""

import inspect
import re
from importlib import import_module

import pytest
import test_code_hashes

from r37core.base.packages import PACKAGES
from r37core.plans import code as code_module
from r37core.plans.code import CodeHashes, fingerprint
from r37core.product.targets import FIGURES


@pytest.fixture(scope="module")
def rules(root):
    """Rule -> names of its code, from the rules' files: of a figure, the step that draws and the module of its function."""
    text = "".join(file.read_text() for file in sorted((root / "workflow/rules").rglob("*.smk")))
    found = {}
    for block in re.split(r"^(?=rule |checkpoint |use rule )", text, flags=re.MULTILINE)[1:]:
        rule = re.match(r"(?:rule|checkpoint|use rule \w+ as) (\w+)", block)[1]
        steps = re.findall(r'\*\*(?:step|stage|adding)\(\s*"([\w.]+)"', block)
        needed = re.match(r"use rule step as|(?:(?!\nfor )[\s\S])*SCRIPTS / .step\.py", block) is not None
        assert len(steps) == (needed and rule != "step"), rule
        if steps:
            found[rule] = ("step", steps[0])
    drawn = {figure.rule: figure.draw.rpartition(".")[0] for figure in FIGURES}
    return found | {rule: ("step", "r37core.figures.steps.draw", module) for rule, module in drawn.items()}


def test_every_rule_of_a_step_names_one_that_is_there(rules):
    assert len(rules) > 25
    for name in {names[1] for names in rules.values()}:
        module, function = name.rsplit(".", 1)
        assert list(inspect.signature(getattr(import_module(module), function)).parameters) == ["input", "output", "params"]


def test_every_rule_runs_again_for_the_modules_of_its_closure_and_no_other(root, rules, monkeypatch):
    code = CodeHashes(root / "src", root / "workflow/scripts")
    modules = [file for package in PACKAGES for file in (root / "src" / package).rglob("*.py")]
    modules += (root / "workflow/scripts").glob("*.py")
    modules.remove(root / "src/r37core/__init__.py")
    scripts = set(rules.values())
    before = {script: code(*script) for script in scripts}
    closures = {script: set(code.closure(*script)) for script in scripts}
    # none of the main job's rules runs again for another setting or plan
    plans = {root / f"src/r37core/{module}" for module in ("config/settings.py", "plans/sweep_plan.py")}
    having = {script[-1].split(".")[1] for script in scripts if plans & closures[script]}
    assert plans <= set(modules) and having <= {"measured", "search", "tolerances", "trials"}
    for edited in modules:

        def of_edited(file, function, edited=edited):
            return b"edited" if file == edited else fingerprint(file, function)

        monkeypatch.setattr(code_module, "fingerprint", of_edited)
        wrong = [script for script in scripts if (code(*script) != before[script]) != (edited in closures[script])]
        assert wrong == [], edited


@pytest.mark.slow
def test_steps_of_studies_have_the_code_that_they_load(root):
    names = ("r37studies.trials.steps.run", "r37studies.run_ups.steps.record", "r37studies.exports.steps.stress")
    test_code_hashes.test_the_closure_has_all_that_python_loads(root, names)


def test_cases_follow_from_no_setting(root):
    code = CodeHashes(root / "src", root / "workflow/scripts")
    assert not {"config", "workflow"} & {file.parent.name for file in code.closure("r37studies.trials.steps.run")}
