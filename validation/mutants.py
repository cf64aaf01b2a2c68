"""Whether the tests notice small changes of the code: a sample of mutations by cosmic-ray, and the score.

Run: make mutants [MUTANTS='--each 20 stress/revolutions.py results/']. A folder stands for each of its modules. A mutation
is an operator, number, comparison or the like changed at one place; it is killed when a test of its module fails. The sample is
drawn with a fixed seed, so that it can be repeated.
"""

from __future__ import annotations

import argparse
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

from cosmic_ray.work_db import WorkDB, use_db
from cosmic_ray.work_item import TestOutcome, WorkerOutcome, WorkItem, WorkResult

ROOT = Path(__file__).parents[1]

TESTS = {
    "blade/section_changes.py": "test_section_changes.py",
    "blade/stacking.py": "test_blade.py",
    "contact/casing.py": "test_contact.py",
    "contact/laws.py": "test_contact.py",
    "fem/matrices.py": "test_fem.py",
    "results/campbell.py": "test_campbell.py",
    "requirements/": "test_requirements.py test_looks.py test_study_refusals.py",
    "results/closing.py": "test_closing.py",
    "results/datasets.py": "test_results.py",
    "results/exceedance.py": "test_exceedance.py",
    "results/columns.py": "test_results.py",
    "results/interactions.py": "test_interactions.py test_results.py test_exceedance.py",
    "results/joining.py": "test_results.py test_reliability.py",
    "results/ranking.py": "test_exceedance.py",
    "results/response.py": "test_results.py",
    "rom/reduced_model.py": "test_rom.py test_time_integration.py",
    "rom/craig_bampton.py": "test_rom.py",
    "config/rotor_section.py": "test_rotor_section.py",
    "base/speeds.py": "test_refinement.py test_config.py",
    "trials/": "test_trials.py",
    "time_integration/integrators.py": "test_time_integration.py test_contact_steps.py test_initial_motion.py",
    "time_integration/rotor_numbers.py": "test_rotor_numbers.py test_rotor.py",
    "time_integration/problem.py": "test_run_statistics.py test_time_integration.py",
    "time_integration/speed_run.py": "test_run_statistics.py",
    "plans/sweep_plan.py": "test_workflow_plans.py",
    "results/": "test_results.py test_exceedance.py test_interactions.py test_measures.py test_campbell.py "
    "test_elastic_casing.py test_explorer.py test_tolerances.py",
    "rotors/": "test_rotor_numbers.py",
    "search/": "test_search.py test_search_steps.py test_search_calls.py test_study_refusals.py",
    "surrogate/gaussian_processes.py": "test_search_proposals.py",
    "surrogate/designs.py": "test_search_proposals.py",
    "surrogate/proposal.py": "test_search_proposals.py",
    "run_up_revolutions.py": "test_run_ups.py",
    "stress/": "test_results.py",
}
"""Module, or folder with the rest of its modules, -> the test files that are to notice."""

EQUIVALENT = "BitOr"
"""In this code mostly the bar between types, which nothing evaluates."""


def tests_of(module: str) -> str:
    """The test files of a module: its own, or those of its folder."""
    return TESTS.get(module) or TESTS[f"{Path(module).parent.as_posix()}/"]


def package_of(name: str) -> Path:
    """Folder of the package that has a module or a folder of this name; the core's where none has it."""
    packages = [ROOT / "src" / package for package in ("r37studies", "r37imports", "r37core")]
    return next((package for package in packages if (package / name).exists()), packages[-1])


def modules_of(name: str) -> list[str]:
    """The module, or those of a folder. Raises ValueError where there is none, and where no tests are known."""
    package = package_of(name)
    files = sorted((package / name).glob("*.py")) if (package / name).is_dir() else [package / name]
    modules = [file.relative_to(package).as_posix() for file in files if file.name != "__init__.py"]
    for module in modules:
        if not (package / module).is_file() or not ({module, f"{Path(module).parent.as_posix()}/"} & TESTS.keys()):
            raise ValueError(f"{name}: found no such module, or no tests of it; allowed: {', '.join(TESTS)}")
    return modules


def mutants_of(module: str, folder: Path, each: int, seconds: float) -> list[tuple[WorkItem, WorkResult]]:
    """Draw `each` mutations of a module in the copy `folder` of the project, and run its tests on every one."""
    session, settings = folder / "mutants.sqlite", folder / "mutants.toml"
    session.unlink(missing_ok=True)
    files = (next((ROOT / "tests").glob(f"*/{name}")) for name in tests_of(module).split())
    tests = " ".join(str(file.relative_to(ROOT)) for file in files)
    path = (package_of(module) / module).relative_to(ROOT)
    settings.write_text(
        f'[cosmic-ray]\nmodule-path = "{path}"\ntimeout = {seconds}\nexcluded-modules = []\n'
        f"test-command = \"{sys.executable} -m pytest -x -q --tb=no -p no:cacheprovider -m 'not slow' {tests}\"\n"
        '[cosmic-ray.distributor]\nname = "local"\n'
    )
    environment = os.environ | {"PYTHONPATH": str(folder / "src")}
    cosmic_ray = [str(Path(sys.executable).with_name("cosmic-ray"))]
    subprocess.run([*cosmic_ray, "init", settings, session], cwd=folder, env=environment, check=True)
    with use_db(session, WorkDB.Mode.open) as work:
        items = sorted((item for item in work.work_items if EQUIVALENT not in item.mutations[0].operator_name), key=_place)
        drawn = {item.job_id: item for item in random.Random(37).sample(items, min(each, len(items)))}
        for item in list(work.work_items):
            if item.job_id not in drawn:
                work.set_result(item.job_id, WorkResult(WorkerOutcome.SKIPPED))
    subprocess.run([*cosmic_ray, "exec", settings, session], cwd=folder, env=environment, check=True)
    with use_db(session, WorkDB.Mode.open) as work:
        results = dict(work.results)
    return [(drawn[job], results[job]) for job in sorted(drawn, key=lambda job: _place(drawn[job]))]


def _place(item: WorkItem) -> tuple[object, ...]:
    mutation = item.mutations[0]
    return mutation.start_pos, mutation.operator_name, mutation.occurrence


def survived(result: WorkResult) -> bool:
    """Whether no test failed."""
    return result.test_outcome == TestOutcome.SURVIVED


def score(results: dict[str, list[tuple[WorkItem, WorkResult]]]) -> str:
    """The score of every module, and the mutations that no test noticed."""
    number = sum(map(len, results.values()))
    killed = number - sum(survived(result) for several in results.values() for _, result in several)
    unnoticed = 100 * (number - killed) / max(number, 1)
    head = f"{killed} of {number} killed, {unnoticed:.1f}% unnoticed."
    lines = [head, "", "| module | mutations | killed |", "|---|---|---|"]
    for module, several in results.items():
        lines.append(f"| `{module}` | {len(several)} | {sum(not survived(result) for _, result in several)} |")
    lines += ["", "Survivors:", ""]
    for module, several in results.items():
        for item, result in several:
            if survived(result):
                removed, added = _lines_of(result.diff or "")
                lines.append(f"- `{module}` line {item.mutations[0].start_pos[0]}: `{removed}` as `{added}`")
    return "\n".join(lines)


def _lines_of(diff: str) -> tuple[str, str]:
    changed = [line for line in diff.splitlines() if line[:1] in "+-" and line[:3] not in ("+++", "---")]
    removed, added = (next((line[1:].strip() for line in changed if line[0] == sign), "") for sign in "-+")
    return removed, added


def main() -> None:
    """Run the sample and print the score."""
    parser = argparse.ArgumentParser(description="Whether the tests notice small changes of the code.")
    parser.add_argument("modules", nargs="*", default=list(TESTS), help="modules or folders of the packages")
    parser.add_argument("--each", type=int, default=6, help="mutations of each module")
    parser.add_argument("--seconds", type=float, default=300.0, help="longest time of one test run")
    chosen = parser.parse_args()
    try:
        modules = list(dict.fromkeys(module for name in chosen.modules for module in modules_of(name)))
    except ValueError as error:
        parser.error(str(error))
    results = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        # tracked files as they are now; a link stays one
        copy = "git ls-files -z | xargs -0 cp --parents --no-dereference --target-directory"
        subprocess.run(f"{copy} '{folder}'", shell=True, cwd=ROOT, check=True)
        for module in modules:
            results[module] = mutants_of(module, folder, chosen.each, chosen.seconds)
            print(
                f"{module}: {sum(not survived(result) for _, result in results[module])} of {len(results[module])} killed",
                flush=True,
            )
    print(score(results))


if __name__ == "__main__":
    main()
