"""Object code: made once, kept, shared by processes, checked, and loaded without its compiler."""

import ast
import ctypes
import json
import os
import stat
import subprocess
import sys
import tempfile
from importlib.util import resolve_name
from itertools import pairwise, product
from pathlib import Path

import numpy as np
import pytest
from defaults import IntegrationChoice
from integration_cases import DIRECT, bits_of_programs, random_model, with_static_modes

from r37core.base.plain import to_plain
from r37core.machine_code import kept, native
from r37core.machine_code.alignment import LANES, NUMBER_BYTES, address_of, aligned_zeros
from r37core.machine_code.native import ObjectCodeError, Sources, cached_object, load_function, object_code
from r37core.time_integration.compiled import engine as compiled
from r37core.time_integration.compiled.layout import Kind, capacity_of, integration_record
from r37core.time_integration.integrators import EXACT_MODAL, INTEGRATORS
from r37core.time_integration.simulate import Simulation

TWICE = """
define i64 @odd_name(i64 %x) {
  %y = mul i64 %x, 2
  ret i64 %y
}
"""


@pytest.fixture
def cache(monkeypatch, tmp_path):
    """An empty cache folder, as of a package that cannot be written."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv("R37_CACHE", raising=False)
    monkeypatch.setattr(kept, "_PACKAGE", tmp_path / "nowhere")
    (tmp_path / "nowhere").touch()
    return tmp_path / f"r37/r37-{os.getuid()}"


def make():
    return object_code(TWICE, "odd_name", "twice")


def twice(code):
    return load_function(code, "twice", ctypes.c_int64, ctypes.c_int64)(21)


def test_made_once(cache):
    made = []

    def build():
        made.append(make())
        return made[-1]

    for _ in range(2):
        assert twice(cached_object("twice", Sources(), 1, build)) == 42
    assert len(made) == 1
    cached_object("twice", Sources(), 2, build)
    assert len(made) == 2
    assert len(list(cache.glob("*.o"))) == 2


def test_a_folder_that_others_may_write_is_not_loaded_from(cache, monkeypatch, tmp_path, caplog):
    """Its code would be run. Another folder is taken, and where neither package nor cache can be written a temporary one."""
    cached_object("twice", Sources(), None, make)
    assert stat.S_IMODE(cache.stat().st_mode) == 0o700
    (planted,) = cache.glob("*.o")
    planted.write_bytes(b"planted")
    kept._digest_of(planted).write_text(kept.content_digest(planted))
    cache.chmod(0o770)
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    for _ in range(2):
        assert twice(cached_object("twice", Sources(), None, make)) == 42
    assert len(list((tmp_path / "temporary").glob("r37-*/*.o"))) == 1
    told = [record.getMessage() for record in caplog.records if record.levelname == "WARNING"]
    assert [line.startswith((f"{cache}: not used, as others may write it", f"{tmp_path}/nowhere")) for line in told] == [
        True
    ] * 2
    (tmp_path / "temporary" / cache.name).chmod(0o777)
    with pytest.raises(PermissionError, match="R37_CACHE: found no folder that can be written for machine code"):
        kept.read_kept("twice.o")


def test_what_a_killed_process_left_is_removed_and_a_living_one_keeps_its_folder(tmp_path):
    """A process is killed while it makes a file, another one makes its own meanwhile."""
    code = (
        "import sys, time\nfrom pathlib import Path\nfrom r37core.machine_code.kept import kept_file\n"
        "make = lambda file: (file.write_text('half'), print('begun', flush=True), time.sleep(600))\n"
        "kept_file(sys.argv[1], '', make, Path(sys.argv[2]))"
    )
    command = [sys.executable, "-c", code]
    running = [subprocess.Popen([*command, name, str(tmp_path)], stdout=subprocess.PIPE) for name in ("killed", "living")]
    try:
        for process in running:
            process.stdout.readline()
        running[0].kill()
        running[0].wait()
        kept.kept_file("mine", "", lambda file: file.write_text("whole"), tmp_path)
        assert {path.name.strip(".").split("-")[0] for path in tmp_path.iterdir()} == {"living", "mine"}
        assert [file.read_text() for file in tmp_path.glob(".living-*/living")] == ["half"]
    finally:
        for process in running:
            process.kill()
            process.communicate()


@pytest.mark.parametrize(
    ("variable", "value", "told"),
    [
        ("NUMBA_DISABLE_JIT", "1", "found 1; allowed: 0"),
        ("NUMBA_CPU_NAME", "skylak", "found skylak, which LLVM cannot compile for; allowed: a name of LLVM's"),
        # LLVM ends the process
        ("NUMBA_CPU_NAME", "i386", "found i386"),
    ],
)
def test_a_variable_with_which_nothing_is_compiled_is_named(cache, monkeypatch, variable, value, told):
    monkeypatch.setenv(variable, value)
    with pytest.raises(ObjectCodeError, match=f"{variable}: {told}"):
        cached_object("twice", Sources(), None, make)


CROWDED = """
import ctypes
from r37core.machine_code.native import load_function, object_code

process, page = ctypes.CDLL(None), 4096
process.mmap.restype = ctypes.c_void_p
process.mmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t, ctypes.c_int, ctypes.c_int, ctypes.c_int, ctypes.c_long]
process.munmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t]
code = object_code(
    "define double @half(double %x) {{\\n %y = fmul double %x, 0.375\\n ret double %y\\n}}", "half", "half"
)
half = load_function(code, "half", ctypes.c_double, ctypes.c_double)
room = lambda size: process.mmap(None, size, 0, 0x4022, -1, 0)
wall = room(2**34)
while room(page) > wall:
    pass
process.munmap(wall + 3 * 2**32, {pages} * page)
print(load_function(code, "half", ctypes.c_double, ctypes.c_double)(2.0))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="Linux's mmap")
@pytest.mark.parametrize("pages", [1, 2])
def test_constants_lie_next_to_the_code(pages):
    """Where memory has one hole, and the next room is gigabytes away."""
    done = subprocess.run([sys.executable, "-c", CROWDED.format(pages=pages)], capture_output=True, text=True, check=False)
    assert (done.stdout, done.returncode) == ("0.75\n", 0), done.stderr


def test_processes_wait_for_the_one_that_makes_it(cache):
    """Two that need the same at once: one takes its time, and only it makes it; another thing is made beside."""
    code = (
        "import sys, time\n"
        "from r37core.machine_code import kept, native\n"
        f"kept._PACKAGE = kept.Path({str(cache.parents[1] / 'nowhere')!r})\n"
        "def build():\n"
        "    time.sleep(2)\n"
        "    print(sys.argv[1], flush=True)\n"
        "    return sys.argv[1].encode()\n"
        "print(native.cached_object('slow', native.Sources(), sys.argv[2], build).decode(), flush=True)\n"
    )
    names = [("first", "1"), ("second", "1"), ("other", "2")]
    running = [subprocess.Popen([sys.executable, "-c", code, *name], stdout=subprocess.PIPE, text=True) for name in names]
    first, second, other = (process.communicate(timeout=300)[0].split() for process in running)
    assert other == ["other", "other"]
    assert sorted([first, second], key=len) in ([["first"], ["first", "first"]], [["second"], ["second", "second"]])
    assert len(list(cache.glob("*.o"))) == 2


def test_an_edited_source_or_another_processor_is_made_again(cache, monkeypatch, tmp_path):
    monkeypatch.setattr(native, "_PACKAGE", tmp_path)
    (tmp_path / "law.py").write_text("1")
    cached_object("twice", Sources("law.py"), None, make)
    (tmp_path / "law.py").write_text("2")
    cached_object("twice", Sources("law.py"), None, make)
    assert len(list(cache.glob("*.o"))) == 2
    (tmp_path / "law.py").write_text('"""A law."""\n\n(2)  # twice\n')
    cached_object("twice", Sources("law.py"), None, None)
    assert len(list(cache.glob("*.o"))) == 2, "comments and docstrings compile nothing"
    monkeypatch.setenv("NUMBA_CPU_NAME", "x86-64-v3")
    cached_object("twice", Sources("law.py"), None, lambda: b"")
    assert len(list(cache.glob("*.o"))) == 3


def test_a_source_edited_while_its_importer_runs_leaves_no_object(cache, monkeypatch, tmp_path):
    """The process still compiles what it imported, which must not stand under the new source's name."""
    monkeypatch.setattr(native, "_PACKAGE", tmp_path)
    (tmp_path / "law.py").write_text("1")
    imported = Sources("law.py")
    (tmp_path / "law.py").write_text("2")
    assert twice(cached_object("twice", imported, None, make)) == 42
    assert not list(cache.glob("*.o"))


@pytest.mark.parametrize("damage", [lambda c: c[:100], lambda c: c[:-1], lambda c: b"", lambda c: c[:80] + b"?" + c[81:]])
def test_a_damaged_file_is_made_again(cache, damage):
    cached_object("twice", Sources(), None, make)
    (file,) = cache.glob("*.o")
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    assert twice(cached_object("twice", Sources(), None, make)) == 42
    assert file.read_bytes() == whole


def test_what_only_the_compiler_has_is_refused():
    needing = "declare i64 @no_such_thing(i64)\n" + TWICE.replace("mul i64 %x, 2", "call i64 @no_such_thing(i64 %x)")
    with pytest.raises(ObjectCodeError, match="no_such_thing"):
        object_code(needing, "odd_name", "twice")


def test_a_job_does_not_import_numba(contact, tmp_path):
    """With the time integration compiled, a simulation's process never sees its compiler, nor SciPy."""
    from r37core.rom.contact_model import write_contact_model

    write_contact_model(contact, tmp_path / "contact.npz")
    Simulation(contact, 1000.0, DIRECT, IntegrationChoice(2e-7, 1, 62))
    task = json.dumps(to_plain([DIRECT, IntegrationChoice(2e-7, 2, 62)]))
    code = (
        "import sys, json\nfrom r37core.base.plain import from_plain\nfrom r37core.contact.scene import Scene\n"
        "from r37core.time_integration.integration_choice import IntegrationChoice\n"
        "from r37core.time_integration.speed_run import run_speed\nfrom r37core.rom.contact_model import read_contact_model\n"
        f"model = read_contact_model({str(tmp_path / 'contact.npz')!r})\n"
        f"scene, choice = from_plain(tuple[Scene, IntegrationChoice], json.loads({task!r}))\n"
        "run_speed(model, 1000.0, scene, choice, ('spectrum',), "
        "spectrum_highest_order=10, wear_angles=100)\n"
        "assert not {'numba', 'scipy'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_sources_of_the_compiled_code_are_all_that_it_is_compiled_from(root):
    core = root / "src/r37core"
    for source in compiled.SOURCES.files:
        package = ".".join(["r37core", *Path(source).parent.parts])
        imports = [node for node in ast.walk(ast.parse((core / source).read_text())) if isinstance(node, ast.ImportFrom)]
        for node in imports:
            top, *parts = resolve_name("." * node.level + (node.module or ""), package).split(".")
            file = core.joinpath(*parts)
            files = [file.with_suffix(".py")] if not file.is_dir() else [file / f"{alias.name}.py" for alias in node.names]
            assert top != "r37core" or {str(one.relative_to(core)) for one in files} <= set(compiled.SOURCES.files), source


def records(kind):
    """A record and all in it."""
    yield kind
    for field, _ in kind.fields.values():
        if field.names:
            yield from records(field)


def test_no_record_has_more_than_60_fields_and_its_arrays_are_aligned_and_apart():
    """A record inside of one is one field of it."""
    sizes = [len(kind.names) for kind in records(integration_record(capacity_of(1, 1)))]
    assert len(sizes) == 9
    assert max(sizes) <= 60
    for kind in records(integration_record(capacity_of(88, 9))):
        places = sorted((offset, offset + field.itemsize) for field, offset in kind.fields.values())
        assert all(end <= start for (_, end), (start, _) in pairwise(places))
        for name, (field, offset) in kind.fields.items():
            assert offset % (64 if field.shape or field.names else 8) == 0, name


def test_kinds_are_few_and_told_apart():
    kinds = [Kind(*flags) for flags in product((True, False), repeat=len(Kind._fields))]
    assert len({repr((capacity_of(88, nodes), kind)) for kind in kinds for nodes in (8, 15)}) == 2 * len(kinds)
    assert len(kinds) <= 4


def test_an_address_of_vectors_is_that_of_an_array_without_gaps_on_their_boundary():
    """Numbers may begin anywhere; a vector that does not begin on a boundary ends the process."""
    array = aligned_zeros((4, 2 * LANES))
    for part in (array, array[1:], array[:1, LANES:]):
        assert address_of(part) == part.ctypes.data
    for part in (array[:, :LANES], array[0, 1:]):
        with pytest.raises(ValueError, match="needed: without gaps, from a multiple of 64 bytes on"):
            address_of(part)
    assert address_of(array[0, 1:], NUMBER_BYTES) == array.ctypes.data + NUMBER_BYTES


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_blades_of_any_size_take_one_program(integrator):
    """Of 1 to 96 modes and up to 8 nodes."""
    programs, sizes = [], []
    for nodes, modes in ((3, 1), (8, 5), (8, 40), (8, 96)):
        model, choice = random_model(nodes, modes), IntegrationChoice(1e-7, 2, 31, integrator=integrator)
        if integrator == EXACT_MODAL:
            model = with_static_modes(model, 1e-9)
        simulation = Simulation(model, 12_000.0, DIRECT, choice)
        programs.append(simulation.engine.program)
        sizes.append(len(simulation.problem.blade.frequencies))
        state = simulation.start()
        state.displacement[:] = 1e-7
        simulation.advance(state, 1)
        assert np.isfinite(state.displacement).all()
    assert sizes == [1, 5, 40, 96]
    assert all(program is programs[0] for program in programs)


AVX2, AVX512 = ("fma", "avx2", "bmi2"), ("avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl")
PROCESSORS = {"x86-64-v3": AVX2, "x86-64-v4": AVX2 + AVX512, "znver4": AVX2 + AVX512}
"""Processors by LLVM's names, of each width of vectors and two makers, and what of their instructions programs use."""


@pytest.fixture(scope="module")
def own_bits():
    return bits_of_programs()


@pytest.mark.slow
@pytest.mark.parametrize("name", PROCESSORS)
def test_programs_for_any_processor_give_the_same_bits(name, own_bits):
    """However wide its vectors are, and however LLVM orders its instructions: a process compiles for it."""
    if name == native.this_processor()[0]:
        pytest.skip("another processor than the one that it is")
    missing = [feature for feature in PROCESSORS[name] if f"+{feature}" not in native.this_processor()[1].split(",")]
    if missing:
        pytest.skip(f"this processor has no {', '.join(missing)}, which {name} has")
    code = "import json\nfrom integration_cases import bits_of_programs\nprint(json.dumps(bits_of_programs()))"
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).parents[1]), "NUMBA_CPU_NAME": name}

    command = [sys.executable, "-c", code]
    printed = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, env=environment).stdout
    assert json.loads(printed) == own_bits


def test_only_own_leftovers_are_removed(tmp_path):
    own = kept.kept_file("made.txt", 1, lambda file: file.write_text("made"), tmp_path)
    foreign = [tmp_path / f".{name}.lock" for name in ("bashrc", "s.PGSQL.5432", f"x-{'0' * 31}", f"{'0' * 32}")]
    left = tmp_path / f".{own.name}.lock"
    for lock in (*foreign, left):
        lock.touch()
        (tmp_path / f"{lock.stem}.folder").mkdir()
        (tmp_path / f"{lock.stem}.folder/file").touch()
    kept.kept_file("other.txt", 2, lambda file: file.write_text("made"), tmp_path)
    assert not left.exists() and not (tmp_path / f"{left.stem}.folder").exists()
    assert all(lock.exists() and (tmp_path / f"{lock.stem}.folder/file").exists() for lock in foreign)
