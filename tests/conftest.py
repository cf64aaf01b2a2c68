"""What many tests share: the reference blade, a coarse mesh of it, its matrices and its reduced model."""

import os
import shutil
from pathlib import Path

import pytest

for library in ("OPENBLAS", "OMP", "MKL"):
    os.environ[f"{library}_NUM_THREADS"] = "1"

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="session")
def root():
    return ROOT


@pytest.fixture(scope="session")
def settings():
    from r37core.config import read_settings

    return read_settings(ROOT)


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
    return settings.blades["Ref"].definition.build()


@pytest.fixture(scope="session")
def mesh(blade):
    from r37core.mesh.generate import generate_mesh

    return generate_mesh(blade, nodes=2500, layers=1, tip_elements=14)


@pytest.fixture(scope="session")
def matrices(mesh, steel):
    from r37core.fem.matrices import assemble

    return assemble(mesh, steel)


@pytest.fixture(scope="session")
def choice(settings):
    return settings.reduction_choice()


@pytest.fixture(scope="session")
def model(mesh, matrices, choice):
    from r37core.rom.reduce import reduce_blade

    return reduce_blade(mesh, matrices, choice)


@pytest.fixture(scope="session")
def contact(model):
    from r37core.rom.contact_reduction import contact_model

    return contact_model(model, "pressure_edge")


@pytest.fixture
def config_copy(root, tmp_path):
    """A folder with a copy of the configuration alone."""
    shutil.copytree(root / "config", tmp_path / "config")
    return tmp_path


@pytest.fixture
def project(root, tmp_path):
    """A copy of the project with a small sweep."""
    from workflow_runs import copy_project

    copy_project(root, tmp_path)
    return tmp_path
