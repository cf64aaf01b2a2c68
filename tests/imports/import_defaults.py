"""Sources of imports as tests want them: what neither a test nor the dataclass names is simple."""

from defaults import with_defaults

from r37imports.importing import source
from r37imports.importing.source import Where

__all__ = ["Where"]

MeshSource = with_defaults(source.MeshSource, sense_check=True)
MatricesSource = with_defaults(source.MatricesSource, mass_unit="kg", stiffness_unit="N/m", sense_check=True)
