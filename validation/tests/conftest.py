"""What the tests of the validation share with those of the product: fixtures, and helpers that lie in tests/."""

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

CHECKOUT = Path(__file__).parents[2]
sys.path[:0] = [str(CHECKOUT / name) for name in ("tests", "", "validation")]

# tests/conftest.py under a name of its own: this file is called conftest, too
_spec = spec_from_file_location("conftest_of_the_product", CHECKOUT / "tests/conftest.py")
_shared = module_from_spec(_spec)
_spec.loader.exec_module(_shared)
HOOKS = ("pytest_configure", "pytest_collection_modifyitems", "pytest_unconfigure")
globals().update(
    {name: value for name, value in vars(_shared).items() if name in HOOKS or not name.startswith(("_", "pytest_"))}
)
