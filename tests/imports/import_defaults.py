"""Sources of imports as tests want them: what neither a test nor the dataclass names is simple; what is refused of them."""

import numpy as np
import pytest
from defaults import with_defaults

from r37imports.importing import source
from r37imports.importing.source import Where
from r37imports.refusal import ImportRefused

__all__ = ["Where"]

MeshSource = with_defaults(source.MeshSource, sense_check=True)
MatricesSource = with_defaults(source.MatricesSource, mass_unit="kg", stiffness_unit="N/m", sense_check=True)


def refused(message, error=ImportRefused):
    """A block that ends in a refusal with this message, a regular expression."""
    return pytest.raises(error, match=message)


def assert_same_sets(mesh, other, *names):
    """Sets of nodes of these names are the same in two meshes."""
    for name in names:
        np.testing.assert_array_equal(mesh.node_set(name), other.node_set(name))
