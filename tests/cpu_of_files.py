"""CPU time of every test file with that of its processes, in every log, and a line for a file that takes too much.

Of CPU and not of the clock, so that a busy machine says the same. With CI=true such a file fails the run; elsewhere a slow
processor is no failure. What files share, fixtures of a session and compiled programs, stands beside them under its own name.
Jobs of Snakemake's job server are not in it: nobody waits for them.
"""

import os
import resource
import sys
from collections import Counter

import pytest

_SHOWN = 30
_KEY = "cpu_s"

_spent = Counter()
"""CPU (s) by file or shared fixture, where the reports come together."""

_shared = Counter()
"""That of the shared fixtures that were made since the last report, in the process that makes them."""

_before = 0.0


def pytest_addoption(parser):
    parser.addini("cpu_of_a_file_s", "most CPU time that one test file may take (s)", default="60")


def too_long(spent, most):
    """One line for each file that has taken more than `most` (s)."""
    remedy = "share what it makes, make that smaller, or part the file"
    found = [(name, seconds) for name, seconds in sorted(spent.items()) if name.endswith(".py") and seconds > most]
    return [f"{name}: found {seconds:.2f} s of CPU; allowed: {most:g} s ({remedy})" for name, seconds in found]


def told_apart(name, make):
    """What `make()` gives, which the first of many makes for all: its CPU time stands under `name`."""
    before, shared = _now(), _shared.total()
    try:
        return make()
    finally:
        _shared[name] += _now() - before - (_shared.total() - shared)


def pytest_runtest_logstart():
    global _before
    _before = _now()


@pytest.hookimpl(wrapper=True)
def pytest_fixture_setup(fixturedef):
    before, shared = _now(), _shared.total()
    try:
        return (yield)
    finally:
        if fixturedef.scope == "session":
            _shared[f"fixture {fixturedef.argname}"] += _now() - before - (_shared.total() - shared)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item):
    global _before
    report, now = (yield), _now()
    taken = {**_shared, item.path.name: max(now - _before - _shared.total(), 0.0)}
    report.user_properties += [(_KEY, entry) for entry in taken.items()]
    _before = now
    _shared.clear()
    return report


def pytest_runtest_logreport(report):
    for name, seconds in (value for key, value in report.user_properties if key == _KEY):
        _spent[name] += seconds


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session):
    if os.environ.get("CI") and session.exitstatus == pytest.ExitCode.OK and too_long(_spent, _most(session.config)):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter, config):
    terminalreporter.section(f"CPU time of files and of what they share, {sum(_spent.values()):.0f} s")
    for name, seconds in _spent.most_common(_SHOWN):
        terminalreporter.write_line(f"{seconds:7.2f} s  {name}")
    for line in too_long(_spent, _most(config)):
        terminalreporter.write_line(line, red=True)


def _most(config):
    return float(config.getini("cpu_of_a_file_s"))


def _now():
    """CPU time (s) of this process, of those that it waited for, and of the commands of Snakemake."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    snakemake = sys.modules.get("warm_snakemake")
    return sum(one.ru_utime + one.ru_stime for one in used) + (snakemake.cpu_time() if snakemake else 0.0)
