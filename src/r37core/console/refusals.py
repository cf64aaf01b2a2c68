"""What Snakemake says of bad input: the message alone, without the files and lines of ours where it was raised."""

from __future__ import annotations

import logging
import re

from r37core.config import ConfigError
from r37core.io import InputFileError

_OF_A_FILE = re.compile(rf"^ *{InputFileError.__name__}: (.*)$", re.MULTILINE)


def without_files(refusal: type[Exception]) -> type[Exception]:
    """Snakemake's own exception, without the traceback from which it lists the places in our rules."""
    hidden = property(lambda error: None, lambda error, traceback: None)
    return type(ConfigError.__name__, (refusal,), {"__traceback__": hidden})


class MessageAlone(logging.Filter):
    """A filter that leaves of an error in an input function the message of the file that could not be read."""

    def filter(self, record: logging.LogRecord) -> bool:
        """Every record passes."""
        if getattr(record, "exception", None) == "InputFunctionException" and (told := _OF_A_FILE.search(record.getMessage())):
            record.msg, record.args = told[1], ()
        return True
