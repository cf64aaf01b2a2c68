"""The package r37: what it gives is what the workflow gives, what takes long is kept, and bad input has one clear message."""

import os
import re
import runpy
import shlex
import subprocess
import sys
import tarfile
import tomllib
import venv
from itertools import count
from pathlib import Path
from typing import Any, get_args, get_type_hints

import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr
import yaml
from refusal_tables import pattern_of, refusal_rows
from workflow_runs import copy_finished, copy_project, own_package

import r37
from r37.calculation import cache_folder, structure_file
from r37.command import main
from r37core.base.dataset_file import read_dataset
from r37core.config import command_line_document
from r37core.machine_code.kept import kept_file
from r37core.product.extensions import read_settings
from r37core.rom.rom_file import read_reduced_model
from r37core.sweep import recipe
from r37studies.exports.matrices_out import write_reduced_matrices

pytestmark = pytest.mark.usefixtures("warm_calls")

SPEEDS = [750.0, 1150.0, 1550.0]


@pytest.fixture(scope="module")
def finished(small_sweep, tmp_path_factory):
    """A sweep of the workflow."""
    return copy_finished(small_sweep, tmp_path_factory.mktemp("finished") / "sweep")


@pytest.fixture(scope="module")
def config(finished):
    """The config.yaml of that sweep, which calls name."""
    return finished / "config/config.yaml"


@pytest.mark.slow
@pytest.mark.parametrize("scene", ["abradable", "direct"])
def test_a_sweep_is_that_of_the_workflow(finished, config, scene):
    response = r37.sweep("Ref", scene, reversed(SPEEDS), config=config)
    xr.testing.assert_identical(response, read_dataset(finished / f"results/Ref/{scene}/response.nc"))
    assert list(response["speed"]) == SPEEDS
    one = r37.simulate("Ref", scene, 1150, config=config)
    xr.testing.assert_identical(one, response.sel(speed=1150.0))


@pytest.mark.slow
def test_a_campbell_diagram_is_that_of_the_workflow_and_what_is_kept_is_not_made_again(finished, config, monkeypatch):
    first = r37.campbell("Ref", config=config)
    xr.testing.assert_identical(first, read_dataset(finished / "results/Ref/campbell.nc"))
    made = []
    steps = {"blade": "geometry", "fem": "mesh", "rom": "reduced_model", "results": "campbell_of_blade"}
    for folder, step in steps.items():

        def make(input, output, params, step=step):
            made.append(step)
            (output.vtu if step == "mesh" else next(file for _, file in output.items())).write_text("x")

        monkeypatch.setattr(f"r37core.{folder}.steps.{step}", make)
    xr.testing.assert_identical(r37.campbell("Ref", config=config), first)
    assert made == []
    monkeypatch.setattr(recipe, "code_of", lambda *step: ["other code"])
    with pytest.raises(r37.InputFileError):
        r37.campbell("Ref", config=config)
    assert made == list(steps.values())


@pytest.mark.slow
def test_changes_count(config):
    histories = r37.scene("abradable", config=config, stress_history_speeds_rad_s=[1150, 1900])
    assert list(r37.sweep("Ref", histories, [1000, 1150], config=config)["history_speed"]) == [1150.0]
    less = r37.scene("abradable", config=config, results=["wear"], **{"friction.coefficient": 0.05})
    before, after = (r37.simulate("Ref", scene, 1150, results=["wear"], config=config) for scene in ("abradable", less))
    assert "max_von_mises_last_revolution" not in before and "amplitude" not in before
    assert not np.array_equal(before["rms_normal"], after["rms_normal"])
    assert '"coefficient": 0.05' in after.attrs["scene_parameters"]
    heavy = r37.blade("Ref", config=config, **{"material.density_kg_m3": 16000.0})
    ratio = r37.campbell(heavy)["frequency"] / r37.campbell("Ref", config=config)["frequency"]
    # at rest; the basis is that of other speeds, too
    np.testing.assert_allclose(ratio.isel(speed=0), np.sqrt(0.5), rtol=1e-3)
    assert r37.campbell(heavy).attrs["input_hash"] != r37.campbell("Ref", config=config).attrs["input_hash"]


def test_a_changed_entry_is_the_one_that_an_edited_file_has(root, config_copy):
    changed = r37.blade("L50", config=root / "config/config.yaml", sweep_percent=50, **{"material.yield_stress_pa": 1e9})
    file = config_copy / "config/blades.yaml"
    old = "L50: { base: Ref,"
    assert old in file.read_text()
    file.write_text(file.read_text().replace(old, f"{old} material: {{ yield_stress_pa: 1.0e+9 }}, sweep_percent: 50,"))
    assert changed.settings == read_settings(config_copy).blades["L50"]
    assert changed.settings == r37.blade("L50", file=file).settings


@pytest.mark.parametrize("call", [r37.blade, r37.scene])
def test_changes_of_any_type_pass_a_type_checker(call):
    """It holds what `**` unpacks against all names."""
    named = {name: kind for name, kind in get_type_hints(call).items() if name not in ("name_of_entry", "return")}
    assert named.keys() == {"name", "file", "config", "changes"}
    assert all(kind is Any or Any in get_args(kind) for kind in named.values())


def test_files_of_ones_own_may_lie_anywhere(root, tmp_path):
    """Tables of a blades.yaml lie beside it, or beside the folder config; the other files are the shipped ones."""
    (tmp_path / "profiles.csv").write_text((root / "config/profiles/rotor37.csv").read_text())
    (tmp_path / "mine.yaml").write_text(
        "Mine:\n  profiles: profiles.csv\n  chordwise_sweep_deg: 10\n"
        "  material: { youngs_modulus_pa: 1.8e+11, density_kg_m3: 8000, poissons_ratio: 0.3, yield_stress_pa: 1.0e+9 }\n"
    )
    scenes = (root / "config/scenes.yaml").read_text().replace("base: abradable", "base: mine")
    (tmp_path / "scenes.yaml").write_text(scenes.replace("abradable:", "mine:", 1))
    blade = r37.blade("Mine", file=tmp_path / "mine.yaml")
    assert len(blade.settings.definition.profiles) == len(read_settings(root).blades["Ref"].definition.profiles)
    assert r37.scene("mine", file=tmp_path / "scenes.yaml").entry == read_settings(root).scene_designs.entries["abradable"]
    with pytest.raises(r37.ConfigError, match="abradable, direct"):
        r37.simulate(blade, "none", 1000)


@pytest.mark.slow
def test_blades_of_other_programs(root, config, tmp_path, monkeypatch):
    """The mesh of docs/your_blade.md, and matrices of our own reduced model: it comes back as it was."""
    page = (root / "docs/your_blade.md").read_text()
    (tmp_path / "draw.py").write_text(re.search(r"```python\n(.*?)```", page, re.DOTALL)[1])
    monkeypatch.chdir(tmp_path)
    runpy.run_path("draw.py")
    settings = read_settings(config.parent.parent)
    model = read_reduced_model(structure_file(settings, "Ref", "reduced_model"))
    write_reduced_matrices(model, [0.0, 1000.0, 2000.0], tmp_path / "matrices")
    entry = {"matrices": "matrices", "mass_unit": "kg", "stiffness_unit": "N/m", "length_unit": "m", "rotation": "negative"}
    frame = {"rotor_axis": [0, 0, 1], "radial": [1, 0, 0]}
    mesh = re.search(r"```yaml\n(.*?)```", page, re.DOTALL)[1]
    (tmp_path / "blades.yaml").write_text(mesh + yaml.safe_dump({"Reduced": {**entry, **frame}}))
    fan, reduced = (r37.blade(name, file="blades.yaml", config=config) for name in ("Fan", "Reduced"))
    monkeypatch.chdir("/")
    assert r37.campbell(fan)["crossing_speed"].sel(mode="1B", engine_order=6).item() == pytest.approx(1492, rel=0.01)
    shipped = r37.simulate("Ref", "direct", 1150, config=config, results=["energy"])
    ours = r37.simulate(reduced, "direct", 1150)
    assert "max_von_mises_last_revolution" not in ours and "amplitude" in ours
    np.testing.assert_allclose(ours["rms_normal"], shipped["rms_normal"], rtol=1e-6)


@pytest.mark.parametrize(("kind", "call", "message"), refusal_rows(Path(__file__).with_name("refusals.txt"), "calls"))
def test_bad_input_has_one_clear_message(root, monkeypatch, kind, call, message):
    """Of calls of the shipped configuration."""
    monkeypatch.setattr("r37.call_configuration._PACKAGE", root)
    with pytest.raises(r37.ConfigError, match=pattern_of(message)) as caught:
        eval(call, {"r37": r37, "xr": xr, "count": count})
    assert "\n" not in str(caught.value)


def test_a_damaged_file_is_made_again(tmp_path):
    made = []

    def make(file):
        made.append(file)
        file.write_text("content")

    def fail(file):
        make(file)
        raise ValueError("impossible")

    def kept(made_of=1.0):
        return kept_file("model.nc", [made_of], make, tmp_path)

    file = kept()
    assert kept() == file and len(made) == 1
    assert kept(2.0) != file and len(made) == 2
    for damage in ("", "contenT"):
        file.write_text(damage)
        assert kept().read_text() == "content"
    file.with_name(f"{file.name}.sha256").unlink()
    assert kept().read_text() == "content"
    assert len(made) == 5 and not list(tmp_path.glob(".*"))
    before = set(tmp_path.iterdir())
    # what fails leaves nothing
    with pytest.raises(ValueError, match="impossible"):
        kept_file("model.nc", [3.0], fail, tmp_path)
    assert set(tmp_path.iterdir()) == before


def test_another_process_may_be_faster_where_there_are_no_locks(monkeypatch, tmp_path):
    def flock(file, operation):
        raise OSError("no locks available")

    monkeypatch.setattr("fcntl.flock", flock)

    def make(file):
        if not list(tmp_path.glob("model-*")):
            kept_file("model.nc", [1.0], lambda other: other.write_text("first"), tmp_path)
        file.write_text("second")

    assert kept_file("model.nc", [1.0], make, tmp_path).read_text() == "first"


def test_the_cache_folder_is_where_the_environment_says(monkeypatch, tmp_path):
    monkeypatch.delenv("R37_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder() == tmp_path / "r37"
    monkeypatch.setenv("R37_CACHE", str(tmp_path / "mine"))
    assert cache_folder() == tmp_path / "mine"
    (tmp_path / "mine").rmdir()
    (tmp_path / "mine").write_text("no folder")
    with pytest.raises(r37.ConfigError, match=r"R37_CACHE: found the cache folder .*mine, which cannot be written"):
        cache_folder()


BACKENDS = {"": "agg", "import matplotlib; matplotlib.use('svg')": "svg", "import r37core.figures.style": "agg"}

PLOTTED = """
import os, sys
import netCDF4, numpy, pandas, scipy.linalg, xarray
assert "matplotlib" not in sys.modules
for before in sys.argv[1:]:
    if os.fork() == 0:
        exec(before)
        import matplotlib, r37
        rms = {f"rms_{name}": (("speed", "tip_point"), numpy.ones((2, 1))) for name in ("normal", "tangential")}
        rms |= {"status": ("speed", [0, 0]), "exit_cause": ("speed", [0, 0]), "exit_revolution": ("speed", 2 * [numpy.nan])}
        r37.plot_response(xarray.Dataset(rms, {"speed": [1.0, 2.0], "tip_point": ["leading_edge"]}))
        print(matplotlib.get_backend().lower(), flush=True)
        os._exit(0)
    os.wait()
"""


def test_plots_take_the_chosen_backend():
    """Without one, what matplotlib chooses on a machine without a display."""
    kept = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "MPLBACKEND")}
    command = [sys.executable, "-c", PLOTTED, *BACKENDS]
    done = subprocess.run(command, env=kept, capture_output=True, text=True, check=True)
    assert done.stdout.split() == list(BACKENDS.values()), done.stderr


def test_results_that_are_not_there(tmp_path):
    with pytest.raises(r37.InputFileError, match="there is no such folder"):
        r37.open_results(tmp_path / "results")
    with pytest.raises(r37.InputFileError, match="there are no datasets"):
        r37.open_results(tmp_path)


@pytest.mark.slow
def test_plots_are_those_of_the_workflow_and_leave_matplotlib_alone(finished, config):
    results, before = r37.open_results(finished / "results"), dict(plt.rcParams)
    campbell, response = r37.campbell("Ref", config=config), results.response("Ref", "abradable")
    for diagram in (campbell, results["campbell"].sel(blade="Ref")):
        assert r37.plot_campbell(diagram).axes[0].get_title() == "Campbell diagram, blade Ref"
    assert r37.plot_campbell(campbell, title="mine").axes[0].get_title().endswith("blade mine")
    with_stress = r37.plot_response(response, campbell)
    assert len(with_stress.axes) == 4 and "dotted" in with_stress.axes[0].get_title()
    (line,) = (one for one in with_stress.axes[0].lines if one.get_label() == "abradable lining")
    np.testing.assert_allclose(line.get_ydata(), 1e3 * response["rms_normal"].sel(tip_point="leading_edge"))
    part = results["rms"].sel(blade="Ref", scene="direct")
    assert len(r37.plot_response(part).axes) == 3 and "dotted" not in r37.plot_response(part).axes[0].get_title()
    assert len(r37.plot_response(response.sel(speed=1150.0)).axes) == 4
    assert dict(plt.rcParams) == before


@pytest.mark.slow
def test_python_of_the_pages_runs(root, finished, monkeypatch):
    """With a small level, rotor, sample and search: the page's speeds and names count, its numbers do not."""
    monkeypatch.setattr("r37.call_configuration._PACKAGE", finished)
    monkeypatch.chdir(finished)
    (finished / "blades.yaml").write_text((finished / "config/blades.yaml").read_text())
    blocks = [
        block
        for page in ("README.md", "docs/python.md", "docs/results.md")
        for block in re.findall(r"```python\n(.*?)```", (root / page).read_text(), re.DOTALL)
        if "r37." in block
    ]
    assert len(blocks) > 5
    names, smaller = {"r37": r37}, {'"draft"': '"tiny"', '"blades": 36': '"blades": 4'}
    smaller |= {'"designs": 4': '"designs": 3', '"first": 3': '"first": 2', '"members": 4': '"members": 2', "[50, 100]": "[50]"}
    for block in blocks:
        for shown, small in smaller.items():
            block = block.replace(shown, small)
        exec(block, names)


@pytest.mark.slow
def test_the_speeds_to_avoid_of_the_page_on_rotors(root, finished, monkeypatch, capsys):
    """With all blades above yield at all speeds, at none, with all runs diverged, and above yield at the first speed alone."""
    monkeypatch.chdir(finished)
    block = re.search(r"```python\n(.*?)```", (root / "docs/rotor.md").read_text(), re.DOTALL)[1]
    block = block.replace("results/runs/patches", "results")
    crossing = float(xr.open_dataset("results/campbell.nc")["crossing_speed"].sel(blade="Ref", mode="1B", engine_order=4))
    ends, first = SPEEDS[:: len(SPEEDS) - 1], f"xr.where(stress.speed == {SPEEDS[0]}, 0.0, 1e12)"
    for limit, status, avoided in (("0.0", 1, ends), ("1e12", 1, []), ("1e12", 0, ends), (first, 1, SPEEDS[:2])):
        exec(block.replace("stress.yield_stress", limit).replace("status == 1", f"status == {status}"), {})
        shown = re.findall(r"-?\d+\.\d+", capsys.readouterr().out)
        np.testing.assert_allclose([float(number) for number in shown], 100 * (np.array(avoided) / crossing - 1), atol=0.051)


@pytest.mark.slow
def test_the_command_does_what_the_page_says(root, finished, monkeypatch, capsys):
    """With the small level in place of others, and speeds of its own."""
    monkeypatch.setattr("r37.call_configuration._PACKAGE", finished)
    monkeypatch.chdir(finished)
    (finished / "config.yaml").write_text((finished / "config/config.yaml").read_text())
    shape, _, rest = (finished / "config/blades.yaml").read_text().partition("\nL50:")
    (finished / "blades.yaml").write_text(f"{shape}\nL50:{rest.splitlines()[0]}\n")
    page = re.search(r"```sh\n(.*?)```", (root / "docs/python.md").read_text(), re.DOTALL)[1].replace("draft", "tiny")
    told = []
    for line in page.splitlines():
        assert main(shlex.split(line, comments=True)[1:]) == 0
        told.append(capsys.readouterr().out)
    assert f"{r37.campbell('Ref')['crossing_speed'].sel(mode='1B', engine_order=4).item():.6g}" in told[0]
    assert told[1].startswith(f"Ref\n{told[0]}L50\n") and told[1].count("1B") == 2
    assert "blades: Ref, CS100\n" in told[2] and "simulations: sweep 12\n" in told[2]


@pytest.mark.parametrize("file", [3.5, 300 * "x", "a\0b", "a\nb", ".", "/dev/zero", []])
def test_what_is_no_file_is_refused_in_one_line(file):
    for call in (lambda: r37.blades(config=file), lambda: r37.blades(file=file), lambda: r37.scene("direct", file=file)):
        with pytest.raises(r37.ConfigError, match=r"^(config|file): found .*; allowed: ") as refused:
            call()
        assert str(refused.value).isprintable() and len(str(refused.value)) < 200


def test_numbers_of_numpy_are_numbers():
    changes = {"casing.lobes": np.int64(3), "friction.coefficient": np.float32(0.5), "gap": np.str_("exact")}
    entry = r37.scene("direct", **changes).entry
    assert (entry.casing.lobes, entry.friction.coefficient, entry.gap) == (3, 0.5, "exact")
    assert command_line_document({"a": [np.int64(1), {"b": np.bool_(True)}]}).content == {"a": [1, {"b": True}]}


def test_the_command_refuses_in_one_line(root, capsys):
    config = str(root / "config/config.yaml")
    assert main(["campbell", "Rex", "--config", config]) == 1
    told = capsys.readouterr()
    assert told.out == "" and told.err.startswith("r37: blade: found 'Rex'; allowed: Ref") and told.err.count("\n") == 1
    assert main(["check", "missing.yaml"]) == 1
    assert main(["check", config]) == 0
    assert (
        "level: standard\nsimulations: sweep about 2842, as results ask (896 at least)\nCPU time: about 11.9 minutes"
        in capsys.readouterr().out
    )


def test_an_interrupted_command_says_so_in_a_line(monkeypatch, capsys):
    def interrupted(_):
        raise KeyboardInterrupt

    monkeypatch.setattr("r37.init", interrupted)
    assert main(["init", "study"]) == 130
    assert capsys.readouterr().err == "r37: interrupted\n"


@pytest.mark.slow
def test_an_installed_package_needs_no_repository(root, tmp_path):
    """Built as a source distribution and installed from it into an environment of its own, which borrows other packages."""
    project, environment, elsewhere = (tmp_path / name for name in ("project", "environment", "elsewhere"))
    for folder in (project, elsewhere):
        folder.mkdir()
    copy_project(root, project)
    own_package(project)
    for name in ("pyproject.toml", "MANIFEST.in", "README.md"):
        (project / name).write_text((root / name).read_text())
    (project / "config/my_trial.yaml").write_text("fidelity: draft\n")
    venv.create(environment, symlinks=True)
    packages = next(environment.glob("lib/python*/site-packages"))
    (packages / "borrowed.pth").write_text("\n".join(path for path in sys.path if path.endswith("site-packages")))

    def run(*arguments, cwd=elsewhere):
        kept = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        command = [environment / "bin/python", *arguments]
        return subprocess.run(command, cwd=cwd, env=kept, capture_output=True, text=True, timeout=900, check=False)

    def python(*arguments, cwd=elsewhere):
        done = run(*arguments, cwd=cwd)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout.strip().splitlines()

    needed = tomllib.loads((project / "pyproject.toml").read_text())["build-system"]["requires"]
    if run("-m", "pip", "install", "--quiet", *needed).returncode:
        pytest.skip("an index of packages that pip reaches")
    build = "from setuptools import build_meta; print(build_meta.build_sdist('.'))"
    *_, source = python("-c", build, cwd=project)
    command = ("-m", "pip", "install", "--quiet", "--no-compile", "--no-index", "--no-deps", "--no-build-isolation")
    python(*command, project / source)
    (packages / "r37core/__pycache__").symlink_to(root / "src/r37core/__pycache__")
    for folder in ("config", "envs", "profiles", "workflow"):
        shipped, installed = (
            {file.relative_to(place) for file in (place / folder).rglob("*.*") if file.suffix != ".pyc"}
            for place in (root, packages / "r37")
        )
        assert installed == shipped
    assert all((packages / name / "py.typed").exists() for name in ("r37", "r37core"))
    with tarfile.open(project / source) as archive:
        assert not [name for name in archive.getnames() if "/tests/" in name]
    (project / "src").rename(project / "gone")
    code = "import r37; print(r37.__file__); print(float(r37.campbell('Ref', fidelity='tiny').frequency[0, 0]))"
    # workers of other processes need no guard in the program
    (elsewhere / "program.py").write_text(f"{code}; print(r37.run('Ref', 'abradable', [750, 1150], fidelity='tiny', cores=2))")
    file, frequency, compared = python("program.py")
    assert compared.endswith(": campbell, rms, spectrum, stress, wear")
    assert Path(file).is_relative_to(packages)
    assert "level: tiny" in python(environment / "bin/r37", "check")
    assert 800.0 < float(frequency) < 900.0  # Hz, 1B at rest
    python(environment / "bin/r37", "init", "study")
    campbell = "results/Ref/campbell.nc"
    done = run("-m", "snakemake", campbell, "--cores", "1", "--config", "blades=[Ref]", cwd=elsewhere / "study")
    # the hooks of the study's Snakefile are those of the workflow
    assert done.returncode == 0 and "jobs 4 of 4" in done.stderr, done.stderr
    assert read_dataset(elsewhere / "study" / campbell)["frequency"][0, 0] == pytest.approx(float(frequency), rel=1e-12)
