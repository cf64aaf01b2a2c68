"""A search for better designs as an extension."""

from __future__ import annotations

from pydantic import Field

from r37core.config.section import LeftOut
from r37core.plans.extension import Extension, Panel

from .captions import CAPTIONS
from .checks import search_can_be_run
from .designs import FOLDER
from .plan import joined_dataset, remarks, samples_of, targets
from .section import SearchSection

EXTENSION = Extension(
    name=FOLDER,
    section=(
        SearchSection | LeftOut,
        Field(default=None, description="designs of one blade that are better than it is (docs/better_blade.md)"),
    ),
    checks=(search_can_be_run,),
    later=samples_of,
    targets=targets,
    remarks=remarks,
    captions=CAPTIONS,
    closing="search.closing.closing",
    panel=Panel(joined_dataset, "search.panel.search_contents", "search/panel.js"),
)
