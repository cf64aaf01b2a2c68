"""What a user sees when something goes wrong: one clear line, and a way on."""

import dataclasses
import errno
import logging
import os
import re
import resource
import shutil
import sys
import tempfile
import time
from functools import partial
from types import SimpleNamespace

import netCDF4
import numpy as np
import pytest
import xarray as xr
from box_mesh import box_mesh
from defaults import Casing, IntegrationChoice, Scene
from snakemake.exceptions import InputFunctionException, WorkflowError, format_exception_to_string
from stubbed_runs import copy_stubbed
from workflow_runs import copy_project, kill_snakemake, snakemake

from r37core.base.dataset_file import SPEED, read_dataset, write_dataset
from r37core.base.io import InputFileError, OutputFileError, atomic_write, function_named, scratch_folder, write_json
from r37core.base.speeds import plan_speeds
from r37core.base.variable import about
from r37core.config import ConfigError, command_line_document
from r37core.config.settings import merged_settings
from r37core.console import failures, lock, snakemake_run
from r37core.fem.write_mesh import write_mesh
from r37core.machine_code import kept
from r37core.mesh.mesh_files import save_grid, vtk_grid
from r37core.plans.sweep_plan import speeds_of_round
from r37core.product.extensions import read_settings
from r37core.product.remarks import replaced_level, source_folder
from r37core.results.joining import add_variable, create_axis
from r37core.rom.rotation import BucklingError
from r37core.sweep import recipe
from r37core.time_integration.simulate import Simulation
from r37core.time_integration.speed_file import read_speed


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / ".snakemake").mkdir()
    monkeypatch.chdir(tmp_path)
    for variable in ("R37_FAILURES", "R37_SIMULATIONS"):
        monkeypatch.setenv(variable, "")  # so that it is as before afterwards
    failures.begin("test")
    return tmp_path


@pytest.fixture
def disk(monkeypatch):
    """Sets how many bytes are free."""

    def has(free):
        monkeypatch.setattr(shutil, "disk_usage", lambda place: shutil._ntuple_diskusage(10**10, 10**10 - free, free))

    return has


def fail(error, about=""):
    with pytest.raises(SystemExit), failures.reported("mesh", "a.log", about):
        print("working")
        raise error


def test_a_failure_is_one_line_and_its_traceback_is_in_the_log(folder, capsys):
    fail(ValueError("too thin;\nmake it thicker"), "blade Ref, ")
    assert capsys.readouterr().err == "rule mesh: too thin;\nmake it thicker (blade Ref, details in a.log)\n"
    log = (folder / "a.log").read_text()
    assert log.startswith("working\nTraceback")
    assert failures.taken() == ["rule mesh: too thin; make it thicker (blade Ref, details in a.log)"]
    assert failures.taken() == []
    fail(ValueError("no tip; write:\n  tip: crown\nthen run again"))
    # lines to be copied stay lines
    assert failures.taken() == ["rule mesh: no tip; write:\n  tip: crown\nthen run again (details in a.log)"]


FULL_DISK = OSError(errno.ENOSPC, "No space left on device", "x.nc")


@pytest.mark.parametrize(
    ("error", "free", "said"),
    [
        (ZeroDivisionError(), 10**9, "ZeroDivisionError ("),
        (MemoryError(), 10**9, "not enough memory (MemoryError); run fewer jobs at once"),
        (FULL_DISK, 10**9, "the disk is full"),
        # netCDF says something else
        (RuntimeError("HDF error"), 10, "the disk is full (HDF error); free some space and give the same command again"),
        # which says it itself
        (OutputFileError("a.nc: the disk is full"), 10, "a.nc: the disk is full (details in a.log)\n"),
    ],
)
def test_an_error_is_said_as_what_it_is(folder, capsys, disk, error, free, said):
    disk(free)
    fail(error)
    assert capsys.readouterr().err.startswith(f"rule mesh: {said}")


def test_runs_side_by_side_keep_their_failures_apart_and_many_are_not_all_repeated(folder):
    failures.note("rule mesh: of this run")
    failures.begin("another")
    failures.note("rule mesh: of another run")
    assert failures.taken() == ["rule mesh: of another run"]
    os.environ["R37_FAILURES"] = ".snakemake/r37_failures_test.txt"
    assert failures.taken() == ["rule mesh: of this run"]
    for number in range(9):
        failures.note(f"rule {number % 7}")
    assert failures.taken(3) == ["rule 0", "rule 1", "rule 2", "... and 4 more, see the logs"]


MESH = box_mesh(0.075, 0.01, 0.05, (40, 3, 10), origin=(0.2, 0.0, 0.0), element="hexahedron20")


def save_mesh(file):
    with atomic_write(file) as partial:
        save_grid(vtk_grid(MESH), partial)


DATASET = xr.Dataset({"a": (("x",), np.arange(20_000.0), about("m", "a"))}, {"x": ("x", np.arange(20_000.0))})


@pytest.mark.parametrize(
    "write",
    [
        lambda file: write_dataset(DATASET, file),
        lambda file: write_json([1.0] * 20_000, file),
        save_mesh,
        lambda file: write_mesh(MESH, file.with_suffix(".msh")),
    ],
)
def test_a_file_that_may_not_be_as_large_is_one_line(tmp_path, write):
    """Whatever netCDF calls it."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, hard))
    try:
        with pytest.raises(
            OutputFileError, match=r"a\.(nc|msh): cannot be written: files may not be as large here; raise the limit"
        ):
            write(tmp_path / "a.nc")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_a_full_disk_has_cut_is_none(tmp_path, disk):
    """As gmsh leaves it, without an error."""
    disk(0)
    with (
        pytest.raises(OutputFileError, match=r"a\.msh: cannot be written: the disk is full"),
        atomic_write(tmp_path / "a.msh") as file,
    ):
        file.write_text("half of it")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("error", "free", "outcome"),
    [
        (FULL_DISK, 10**9, OutputFileError),
        (OSError(errno.EDQUOT, "Disk quota exceeded"), 10**9, OutputFileError),
        (RuntimeError("NetCDF: HDF error"), 10, OutputFileError),
        (OSError(-101, "NetCDF: HDF error"), 10, OutputFileError),
        (RuntimeError("NetCDF: HDF error"), 10**9, RuntimeError),
        (PermissionError(errno.EACCES, "Permission denied"), 10, PermissionError),
        (InputFileError("b.nc: no"), 10, InputFileError),
    ],
)
def test_a_full_disk_is_one_line_in_python(tmp_path, monkeypatch, disk, error, free, outcome):
    """From every writer, and where r37 keeps structures; other errors are as they were."""
    disk(free)

    def fails(*_):
        raise error

    def written():
        with atomic_write(tmp_path / "a.nc"):
            fails()

    monkeypatch.setattr(recipe, "kept_file", fails)
    structure = recipe.Recipe("Ref", "r37core.rom.steps.reduced_model", "reduced model", "a.nc")
    for write in (written, partial(structure.file, tmp_path, {})):
        with pytest.raises(outcome) as raised:
            write()
        told = r"a\S*\.nc: cannot be written: the disk is full; free some space \(" if outcome is OutputFileError else ""
        assert type(raised.value) is outcome and re.search(told, str(raised.value))


def test_without_room_what_cannot_be_kept_is_there_and_no_temporary_folder_is_one_line(tmp_path, monkeypatch):
    """Compiled code, which a full disk has no room for."""
    monkeypatch.setattr(kept, "_folder", lambda: tmp_path)
    monkeypatch.setattr(kept, "keep", lambda *_: (tmp_path / "none/a").write_text(""))
    assert kept.kept_bytes("a.o", "", lambda: b"code", lambda: True) == b"code"
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "none"))
    with pytest.raises(OutputFileError, match=r"no temporary folder can be made: .*set TMPDIR"), scratch_folder():
        pass


def test_an_import_that_fails_inside_of_a_step_keeps_its_own_error(tmp_path, monkeypatch):
    """As of gmsh without libGL; names of modules and functions that are not there stay errors of those."""
    (tmp_path / "steps_without_library.py").write_text("raise ImportError('libGL.so.1: cannot open shared object file')")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ImportError, match=r"libGL\.so\.1: cannot open"):
        function_named("steps_without_library.mesh")
    monkeypatch.setitem(sys.modules, "gmsh", None)
    monkeypatch.delitem(sys.modules, "r37core.fem.steps", raising=False)
    monkeypatch.delitem(sys.modules, "r37core.mesh.generate", raising=False)
    with pytest.raises(ImportError, match="gmsh"):
        recipe.run_step("r37core.fem.steps.mesh", {}, {}, {})
    assert function_named("r37core.base.io.as_list")("a") == ["a"]


def test_the_lock_of_a_killed_run_is_lifted(folder):
    locks, records = folder / ".snakemake/locks", folder / ".snakemake/r37_running"
    locks.mkdir()
    (locks / "0.input.lock").write_text("x")
    assert lock.enter() == []  # nobody said whose it is
    (mine,) = records.iterdir()
    pid, _, host = mine.name.split("_", 2)
    assert lock.enter() == []  # this process, alive
    for other in (f"{os.getppid()}", f"{pid}_1_elsewhere", "x", "_1_" + host):
        (records / other).touch()
        assert lock.enter() == []  # another machine, which cannot be asked, or none of ours
        (records / other).unlink()
    living = lock._identity(os.getppid())
    (records / living).touch()
    (records / f"{pid}_1_{host}").touch()
    assert lock.enter() == []  # one that lives
    assert locks.exists()
    (records / living).unlink()
    assert "was killed" in lock.enter()[0]
    assert not locks.exists()
    assert [*records.iterdir()] == [mine]
    lock.release()
    assert not any(records.iterdir())


def test_another_trees_package_is_refused(root, tmp_path):
    assert source_folder(root) == (root / "src").resolve()
    with pytest.raises(ConfigError, match=r"r37core: found the package in .*; allowed: the one beside the Snakefile"):
        source_folder(tmp_path)


def test_a_blade_that_buckles_is_refused_with_the_speed(contact):
    weak = dataclasses.replace(contact, stiffness_per_square=-np.diag(contact.squared_frequencies))
    with pytest.raises(BucklingError, match="no stable position at 900 rad/s"):
        Simulation(weak, 900.0, Scene(Casing(3.5e-4)), IntegrationChoice(2e-7, 2, 496))


def test_a_filter_below_the_first_mode_is_refused(contact):
    choice = IntegrationChoice(2e-7, 2, 496, highest_frequency=100.0)
    message = r"^time_integration\.highest_frequency_hz of the fidelity level: found 100; .* the first mode's, [89]\d\d\.\d+ Hz"
    with pytest.raises(ValueError, match=message):
        Simulation(contact, 900.0, Scene(Casing(3.5e-4)), choice)


def test_a_flipped_bit_is_found(tmp_path):
    """In a dataset, and in variable and axis of a joined one."""
    joined, response = tmp_path / "joined.nc", tmp_path / "response.nc"
    # any bits: nothing to compress, so that the files have them as they are, of a response byte by byte of all numbers
    values = np.frombuffer(np.random.default_rng(1).bytes(2400))
    write_dataset(xr.Dataset({"a": ("speed", values, about("m", "a"))}, {"speed": np.arange(300.0)}), joined)
    np.testing.assert_array_equal(read_dataset(joined)["a"], values)
    with netCDF4.Dataset(response, "w") as dataset:
        create_axis(dataset, "speed", np.arange(300.0), SPEED.attributes)
        add_variable(dataset, "a", ("speed",), "f8", about("m", "a"))[:] = values
    by_bytes, axis = values.view(np.uint8).reshape(-1, 8).T.tobytes(), np.arange(300.0).tobytes()
    for file, stored in ((joined, values.tobytes()), (response, by_bytes), (response, axis)):
        sound = file.read_bytes()
        damaged = bytearray(sound)
        damaged[sound.index(stored[1000:1040])] ^= 1
        file.write_bytes(damaged)
        with pytest.raises(InputFileError, match=rf"{file.name}: cannot be read .* delete it and run again"):
            read_dataset(file)
        file.write_bytes(sound)


@pytest.mark.parametrize("content", [b"", b"x", b"PK half of a file", b"\x80\x04]\x94."])
def test_nobody_is_advised_to_load_what_may_run_something(tmp_path, content):
    file = tmp_path / "speed_1.npz"
    file.write_bytes(content)
    with pytest.raises(InputFileError, match=r"speed_1\.npz: cannot be read \(.* delete it and run again") as refused:
        read_speed(file)
    assert "pickle" not in str(refused.value)


def test_a_refusal_names_no_files_of_ours():
    """Snakemake lists what it finds in the traceback."""
    refused = snakemake_run.without_files(WorkflowError)
    with pytest.raises(WorkflowError) as shown, snakemake_run._refused(refused):
        raise ConfigError("config.yaml:3: speeds: found none")
    lines = {__file__: dict.fromkeys(range(2000), 1)}
    assert format_exception_to_string(shown.value, lines) == "ConfigError:\nconfig.yaml:3: speeds: found none"
    # as it would without
    with pytest.raises(WorkflowError) as shown:
        raise WorkflowError("x")
    assert __file__ in format_exception_to_string(shown.value, lines)


def test_a_file_that_cannot_be_planned_with_is_told_in_one_line(tmp_path, settings):
    """A damaged round, which Snakemake meets when it plans; other errors are as they were."""
    rule = SimpleNamespace(lineno=1, snakefile="sweep.smk", name="response", workflow=SimpleNamespace(linemaps={}))
    for error, line in ((InputFileError("round_0.json: no"), "round_0.json: no"), (KeyError("speed"), None)):
        text = str(InputFunctionException(error, wildcards={"blade": "Ref"}, rule=rule))
        about = {"exception": InputFunctionException.__name__, "event": "error"}
        record = logging.makeLogRecord({"msg": text, **about})
        assert snakemake_run.MessageAlone().filter(record)
        assert record.getMessage() == (line or text)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('{"new": [800, 802.6]}', "it asks for 802.6 rad/s, which is no speed of the configuration"),
        ('{"new": [7197, 800]}', "it asks for 7197 rad/s"),
        ('{"new": ["x"]}', "could not convert"),
        ('{"new": 800}', "not iterable"),
        ('{"old": []}', "KeyError: 'new'"),
        ("[]", "TypeError"),
        ('{"new": [800', "JSONDecodeError"),
    ],
)
def test_a_damaged_round_is_one_line_and_its_speeds_are_held_against_the_grid(tmp_path, text, reason):
    plan = plan_speeds([{"start": 800, "stop": 820, "step": 10, "refine_to": 2.5}], 1.0)
    (tmp_path / "sound.json").write_text('{"new": [800, 802.5]}')
    assert speeds_of_round(str(tmp_path / "sound.json"), plan) == [800.0, 802.5]
    (tmp_path / "round_0.json").write_text(text)
    with pytest.raises(InputFileError) as refused:
        speeds_of_round(str(tmp_path / "round_0.json"), plan)
    message = str(refused.value)
    assert reason in message and message.count("cannot be read") == 1 and "\n" not in message, message
    assert message.endswith("; if it is a result, delete it and run again")


def test_replaced_results_are_announced(root, folder):
    draft = read_settings(root, command_line_document({"fidelity": "draft"}))
    assert replaced_level(draft) == []
    (folder / "results").mkdir()
    write_json(merged_settings(draft), folder / "results/configuration.json")
    assert replaced_level(draft) == []
    (line,) = replaced_level(read_settings(root, command_line_document({"fidelity": "fine"})))
    assert "results in results that depend on the level are replaced, draft by fine; give this run a name" in line
    named = read_settings(root, command_line_document({"fidelity": "fine", "run": {"name": "trial"}}))
    assert replaced_level(named) == []


@pytest.mark.slow
def test_the_clear_line_comes_last(root, tmp_path):
    copy_project(root, tmp_path)
    table = tmp_path / "config/profiles/rotor37.csv"
    table.write_text(table.read_text().replace("50,21.761,21.622,56.190", "50,21.761,21.622,89.000"))
    text = snakemake(tmp_path, "results/Ref/geometry.nc", "--cores", "1", check=False)
    last = text.strip().splitlines()[-1]
    assert last.startswith("rule geometry: blade Ref: span 50%: no ")
    assert last.endswith("(blade Ref, details in logs/Ref/geometry.log)")
    assert "Traceback" not in text and not (tmp_path / "results/Ref/geometry.nc").exists()


@pytest.mark.slow
def test_environments_of_conda_are_refused_before_one_is_made(root, tmp_path):
    copy_project(root, tmp_path)
    assert "jobs need the Python that runs Snakemake" in snakemake(tmp_path, "campbell", "--sdm", "conda", "-c1", check=False)


@pytest.mark.slow
@pytest.mark.parametrize("wait", [0.0, 1.0])
def test_a_killed_run_goes_on_with_the_same_command(root, tmp_path, wait):
    copy_stubbed(root, tmp_path)
    slow = tmp_path / "workflow/scripts/step.py"
    slow.write_text("import time\ntime.sleep(1000)\n" + slow.read_text())
    command = ("results/Ref/geometry.nc", "--cores", "1")

    def begun():
        locked = any((tmp_path / ".snakemake/locks").glob("*"))
        time.sleep(wait if locked else 0.0)
        return locked

    kill_snakemake(tmp_path, *command, when=begun)
    slow.write_text(slow.read_text().replace("time.sleep(1000)", ""))
    text = snakemake(tmp_path, *command)
    assert "the last run here was killed" in text
    assert (tmp_path / "results/Ref/geometry.nc").exists()
