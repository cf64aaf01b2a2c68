"""The material that a mesh file has of its own: it is not used, and a remark names it where it differs from the blade's."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from r37core.fem.material import Material

from .abaqus_reader import deck_blocks
from .bulk_data import bulk_cards, bulk_number
from .files import DECK, kind_of, mesh_files

_UNITS = ((1.0, 1.0), (1e6, 1e12), (1e9, 1e9), (1e3, 1e9), (6894.757, 1.068685e7))
"""Factors of modulus (Pa) and density (kg/m3) in m-kg-s, mm-t-s, mm-kg-ms, mm-kg-s and in-lbf-s, of which a file names none."""

_ALIKE = 0.01


class FileMaterial(NamedTuple):
    """Young's modulus, Poisson's ratio and density of a file, in its own units; NaN for what it does not have."""

    youngs_modulus: float = np.nan
    poissons_ratio: float = np.nan
    density: float = np.nan

    def agrees(self, material: Material) -> bool:
        """True if this is the same material, in one of the usual systems of units, as far as the file has numbers."""
        own = np.array(self)
        blade, present = np.array([material.youngs_modulus, material.poissons_ratio, material.density]), np.isfinite(own)
        factors = ([modulus, 1.0, density] for modulus, density in _UNITS)
        return any(np.allclose((own * factor)[present], blade[present], rtol=_ALIKE, atol=0.0) for factor in factors)

    @property
    def wording(self) -> str:
        """Numbers of the material, as the file has them."""
        numbers = zip(("Young's modulus", "Poisson's ratio", "density"), self, strict=True)
        return ", ".join(f"{name} {value:g}" for name, value in numbers if np.isfinite(value))


def ignored_material(name: str, root: Path, material: Material) -> FileMaterial | None:
    """The first material of the mesh file `name` in the folder `root` that is not the blade's; None without one."""
    file = mesh_files(name, root)[0]
    reader = {DECK: _deck_material, ".bdf": _bulk_material, ".nas": _bulk_material}.get(kind_of(file))
    return next((each for each in reader(file) if not each.agrees(material)), None) if reader else None


def _deck_material(file: Path) -> Iterator[FileMaterial]:
    """Materials of Abaqus and CalculiX: the first row of *ELASTIC and of *DENSITY after each *MATERIAL."""
    materials: list[dict[str, list[float]]] = [{}]
    for keyword, _, rows in deck_blocks(file):
        if keyword == "MATERIAL":
            materials.append({})
        elif keyword in ("ELASTIC", "DENSITY") and rows:
            materials[-1].setdefault(keyword, list(map(bulk_number, rows[0])))
    for known in filter(None, materials):
        modulus, ratio = [*known.get("ELASTIC", []), np.nan, np.nan][:2]
        yield FileMaterial(modulus, ratio, [*known.get("DENSITY", []), np.nan][0])


def _bulk_material(file: Path) -> Iterator[FileMaterial]:
    """Cards MAT1 of Nastran: MID, E, G, NU, RHO."""
    for name, *fields in bulk_cards(file):
        if name == "MAT1":
            _, modulus, _, ratio, density = map(bulk_number, fields[:5])
            yield FileMaterial(modulus, ratio, density)
