"""Kinds of entries of blades.yaml that optional packages register, next to profiles and bases."""

from functools import cache
from pathlib import Path
from typing import ClassVar

from r37core.base.io import function_named
from r37core.base.packages import registered
from r37core.blade.definition import Definition

from .section import Section


class BladeKind(Section):
    """A blade given by something else than profiles; the `key` of its entry tells the kind.

    `file_keys`: keys of files, where a value is none of `no_files`; `varied`: keys with a number that may vary in a family;
    `has_shape`: whether its definition is a Shape, which this program meshes, so that variants may have other sweep and lean;
    `has_material`: whether it has a material and a mesh, and so stress, and can be a base.
    """

    key: ClassVar[str]
    file_keys: ClassVar[tuple[str, ...]]
    no_files: ClassVar[tuple[str, ...]] = ()
    varied: ClassVar[tuple[str, ...]] = ()
    has_shape: ClassVar[bool] = False
    has_material: ClassVar[bool] = True

    def definition(self, name: str, root: Path, check_sense: bool) -> Definition:
        """Definition of the blade, with files from the folder `root`; `check_sense`: whether its sense is checked.

        Raises EntryRefused with the key to blame, TextFileError and BladeShapeError of a file, OSError.
        """
        raise NotImplementedError


@cache
def blade_kinds() -> dict[str, type[BladeKind]]:
    """Key of an entry -> its kind."""
    return {key: function_named(name) for key, name in registered("BLADE_ENTRIES").items()}
