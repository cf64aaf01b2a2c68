"""A folder of one's own: `r37 init` writes it, and its Snakefile has the workflow as a module."""

import shutil

import pytest
from test_refusals import edit
from workflow_runs import copy_project, planned, snakemake

import r37
from r37 import ConfigError
from r37.command import main
from r37.study_folder import init
from r37core.product.extensions import settings_of_run

ASKED = ("results/rms.nc", "--config", "blades=[Ref]", "speeds=[900, 1200]")
"""So much of a sweep for dry runs."""


@pytest.fixture
def study(root, tmp_path):
    """A study folder beside a copy of the project, whose rules it uses."""
    copy_project(root, tmp_path / "project")
    folder = init(tmp_path / "study")
    snakefile = (folder / "Snakefile").read_text()
    line = "from r37 import SNAKEFILE\n"
    assert line in snakefile
    (folder / "Snakefile").write_text(snakefile.replace(line, f'SNAKEFILE = r"{tmp_path}/project/Snakefile"\n'))
    return folder


@pytest.fixture(autouse=True)
def package_of_the_copy(monkeypatch, tmp_path):
    """As an installed one is that of the rules."""
    monkeypatch.setattr("workflow_runs.source", lambda folder: tmp_path / "project/src")


def test_init_writes_what_is_shipped(root, tmp_path, capsys):
    assert main(["init", str(tmp_path / "deep/study")]) == 0
    assert "snakemake all_blades" in capsys.readouterr().out
    study = tmp_path / "deep/study"
    for file in (*(root / "config").rglob("*.*"), root / "profiles/default/config.yaml"):
        if not file.name.startswith("my"):
            assert (study / file.relative_to(root)).read_bytes() == file.read_bytes()
    assert main(["check", str(study / "config/config.yaml")]) == 0
    assert [entry.name for entry in (tmp_path / "deep").iterdir()] == ["study"]
    (study / "config/my.yaml").write_text("speeds: [1900, 2500]\n")
    assert main(["check", str(study / "config/config.yaml"), str(study / "config/my.yaml")]) == 0
    told = capsys.readouterr().out
    assert "simulations: sweep 28\nCPU time: about " in told
    assert "speeds: up to 2500 rad/s, and structure.maximum_speed_rad_s is 2000" in told


@pytest.mark.parametrize("prefix", ["", "own/fan/"])
def test_names_in_a_file_start_from_its_folder_or_that_of_the_study(root, tmp_path, monkeypatch, capsys, prefix):
    """In the workflow, the command and Python, from any folder; a message has the path that was tried."""
    study = init(tmp_path / "study")
    own = shutil.copytree(root / "examples/fan", study / "own/fan")
    edit(own / "blades.yaml", "mesh: fan.msh", f"mesh: {prefix}fan.msh")
    edit(own / "assess.yaml", "blades_file: blades.yaml", f"blades_file: {prefix}blades.yaml")
    for folder, asked in ((study, "own/fan/assess.yaml"), (tmp_path, "study/own/fan/assess.yaml"), (own, "assess.yaml")):
        monkeypatch.chdir(folder)
        blade = settings_of_run(study, [own / "assess.yaml"], {}).blades["Fan"]
        assert blade.definition.file == "own/fan/fan.msh"
        assert main(["check", asked]) == 0 and "blades: Fan\n" in capsys.readouterr().out
        assert blade == r37.blade("Fan", file=own / "blades.yaml").settings == r37.blade("Fan", config=asked).settings
    edit(own / "blades.yaml", "fan.msh", "fun.msh")
    assert main(["check", "assess.yaml"]) == 1
    assert capsys.readouterr().err.endswith("blades.yaml:3: Fan.mesh: there is no file own/fan/fun.msh\n")
    edit(own / "assess.yaml", f"{prefix}blades.yaml", "none.yaml")
    with pytest.raises(ConfigError, match=r"^own/fan/none\.yaml: there is no such file"):
        settings_of_run(study, [own / "assess.yaml"], {})


def test_init_replaces_nothing(tmp_path, capsys):
    (tmp_path / "notes.txt").write_text("mine")
    for folder in (tmp_path, tmp_path / "notes.txt"):
        assert main(["init", str(folder)]) == 1
        assert "which is not empty; allowed: a folder that is new or empty" in capsys.readouterr().err
    with pytest.raises(ConfigError, match=r"which cannot be written \(File name too long\)"):
        init(tmp_path / ("n" * 300))
    with pytest.raises(ConfigError, match=r"which cannot be written \(File exists\)"):
        init(tmp_path / "notes.txt/study")
    assert [entry.name for entry in tmp_path.iterdir()] == ["notes.txt"]
    (tmp_path / "empty").mkdir()
    assert init(tmp_path / "empty").is_dir()


@pytest.mark.slow
def test_a_study_plans_what_the_repository_plans(study, tmp_path):
    of_project = planned(tmp_path / "project", *ASKED, "fidelity=standard")
    assert planned(study, *ASKED) == of_project and of_project["simulate"] == {"Ref"}


@pytest.mark.slow
def test_a_study_has_rules_of_its_own_and_changes_on_top(study):
    """`config:` of the module lies on top; rules get names of the user's choice, and feed the user's rules."""
    text = (study / "Snakefile").read_text()
    on_top = '    config:\n        {"fidelity": "draft", "blades": ["CS50"]}\n'
    text = text.replace("        SNAKEFILE\n", f"        SNAKEFILE\n{on_top}")
    text = text.replace("use rule * from r37\n", "use rule * from r37 as rub_*\n")
    (study / "Snakefile").write_text(text + '\n\nrule mine:\n    input: "results/campbell.nc"\n    output: "mine.txt"\n')
    jobs = planned(study, "mine.txt")
    assert jobs["rub_reduced_model"] == {"CS50"} and "mine" in jobs
    (study / "Snakefile").write_text(text.replace('{"fidelity": "draft", "blades": ["CS50"]}', "5"))
    assert "config of the module r37: found 5; allowed: keys and values" in snakemake(study, "-n", check=False)
    (study / "Snakefile").write_text(text.replace('"draft"', '"rough"'))
    told = snakemake(study, "-n", check=False)
    assert "config of the module r37: fidelity: found 'rough'; allowed: draft, standard" in told
    assert not (study / "results").exists()


@pytest.mark.slow
def test_a_folder_without_a_configuration_is_refused(study):
    (study / "config/config.yaml").unlink()
    told = snakemake(study, "-n", check=False)
    assert (
        "config/config.yaml: there is no such file in" in told
        and "`r37 init FOLDER` writes a folder that has all files" in told
    )
