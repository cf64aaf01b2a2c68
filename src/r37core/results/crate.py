"""ro-crate-metadata.json: what lies in the folder of the results and what made it, as a Research Object Crate 1.1.

The form is that of https://www.researchobject.org/ro-crate/specification/1.1.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import r37core
from r37core.base.io import readable
from r37core.base.origin import LICENSE, REFERENCES, date_created, source
from r37core.machine_code.kept import content_digest

METADATA = "ro-crate-metadata.json"

_FORMATS = {".nc": "application/x-netcdf", ".csv": "text/csv", ".json": "application/json"}


def crate(files: Iterable[Path | str], folder: Path | str) -> dict[str, Any]:
    """Metadata of a crate of the `files` in a `folder`, each with its size and SHA-256. Raises InputFileError."""
    made, parts = date_created(), [_part(Path(file), Path(folder)) for file in files]
    references: list[dict[str, str]] = [{"@id": part["@id"]} for part in parts]
    return {
        "@context": "https://w3id.org/ro/crate/1.1/context",
        "@graph": [
            {
                "@id": METADATA,
                "@type": "CreativeWork",
                "conformsTo": {"@id": "https://w3id.org/ro/crate/1.1"},
                "about": {"@id": "./"},
            },
            {
                "@id": "./",
                "@type": "Dataset",
                "name": "Rubbing of compressor blades, simulated",
                "description": "Vibration, stress and wear over speed; "
                "validation/tables/columns.csv has all columns, docs/results.md the variables",
                "datePublished": made,
                "license": {"@id": "#license"},
                "citation": {"@id": REFERENCES},
                "hasPart": references,
                "mentions": {"@id": "#run"},
            },
            {"@id": "#license", "@type": "CreativeWork", "name": LICENSE},
            {
                "@id": REFERENCES,
                "@type": "ScholarlyArticle",
                "name": "Piollet, Nyssen and Batailly, Journal of Sound and Vibration 460 (2019) 114878",
            },
            {"@id": "#r37", "@type": "SoftwareApplication", "name": "r37", "version": r37core.__version__},
            {
                "@id": "#run",
                "@type": "CreateAction",
                "name": f"Run of {source()}",
                "instrument": {"@id": "#r37"},
                "object": {"@id": "configuration.json"},
                "result": references,
                "endTime": made,
            },
            *parts,
        ],
    }


def _part(file: Path, folder: Path) -> dict[str, Any]:
    with readable(file):
        digest = content_digest(file)
    return {
        "@id": file.relative_to(folder).as_posix(),
        "@type": "File",
        "name": file.stem.replace("_", " "),
        "encodingFormat": _FORMATS.get(file.suffix, "application/octet-stream"),
        "contentSize": str(file.stat().st_size),
        "sha256": digest,
    }
