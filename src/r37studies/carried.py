"""Settings as a rule's parameter, for jobs that make structures and runs of their own."""

from pathlib import Path
from typing import Any

from r37core.base.io import function_named
from r37core.config import Settings
from r37core.config.document import Document


class Carried:
    """Settings of a job, which reads them from its copy of config.yaml and the files that this names.

    As a rule's parameter they re-run nothing: what they hold that counts stands next to them.
    """

    def __init__(self, settings: Settings):
        self.settings = settings

    def __reduce__(self) -> Any:
        return _read, (self.settings.document, self.settings.root)


def _read(config: Document, root: Path) -> Carried:
    # models of config.yaml are made of the sections of all extensions, of which this is one
    return Carried(function_named("r37core.product.extensions.load_settings")(config, root))
