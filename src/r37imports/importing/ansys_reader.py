"""Reader of Ansys archives (.cdb), by the extra package meshlane.

meshlane 1 takes an element of a type that it does not know for a solid, so that a pressure on a surface becomes flat bricks.
"""

import io
import re
from pathlib import Path

from r37imports.refusal import ImportRefused, warn_of

from .meshio_reader import raw_mesh
from .raw_mesh import RawMesh

_SOLIDS = {5, 45, 70, 87, 90, 92, 95, 162, 185, 186, 187, 226, 227, 285}
_SHELLS_AND_LINES = {1, 3, 4, 25, 28, 42, 43, 63, 77, 82, 93, 131, 132, 180, 181, 182, 183, 188, 189, 223, 281, 288, 289}
"""Numbers of the types that meshlane reads as what they are."""

_OTHER_SOLIDS = {46, 62, 64, 65, 69, 72, 73, 96, 97, 98, 117, 122, 123, 127, 128, 147, 148, 164, 168, 190, 191, 215, 231, 232}
_OTHER_SOLIDS |= {236, 237, 239, 240, 278, 279}
"""Numbers of further solids of Ansys, which would be left out of the blade."""

_LEFT_OUT = "170"
"""A type, of contact, that meshlane leaves out."""

_TYPE = re.compile(r"(?im)^(\s*ET\s*,[^,\n]+,\s*)(?:[A-Z]+)?(\d+)")
_TYPE_BLOCK = re.compile(r"(?im)^ETBLOCK\b.*\n.*\n((?:\s*\d+.*\n)*)")
_TYPE_ROW = re.compile(r"(?m)^([ \t]*\d+)([ \t]+\d+)")


def read_ansys(file: Path) -> RawMesh:
    """The mesh of an archive; elements that are no solids are left out, and named.

    Raises ImportRefused without meshlane, and for types of solids that it does not know.
    """
    try:
        import meshlane
    except ImportError:
        raise ImportRefused(
            "Ansys archives need the extra package meshlane: pip install -e '.[ansys]' in the project's folder"
        ) from None
    left_out: set[int] = set()

    def known(text: str) -> str:
        number = int(text)
        if number in _OTHER_SOLIDS:
            raise ImportRefused(f"found elements of type SOLID{number}; allowed: SOLID185, SOLID186, SOLID187 and SOLID285")
        if number in _SOLIDS | _SHELLS_AND_LINES:
            return text
        left_out.add(number)
        # in columns it ends where the number did
        return _LEFT_OUT.rjust(len(text))

    # titles and names may be in Latin-1
    text = _TYPE.sub(lambda row: row[1] + known(row[2]), file.read_text(encoding="utf-8", errors="replace"))
    text = _TYPE_BLOCK.sub(lambda block: _TYPE_ROW.sub(lambda row: row[1] + known(row[2]), block[0]), text)
    mesh = raw_mesh(meshlane.read(io.StringIO(text), "ansysInp"))
    if left_out:
        warn_of(f"elements of the types {', '.join(map(str, sorted(left_out)))} of Ansys are no solids, and are left out")
    return mesh
