"""A run of Snakemake as r37 finds and changes it: configuration, messages, lock, last words.

Only this package knows Snakemake's inside, by the names that `SNAKEMAKE` has; `tests/core/test_console.py` looks for each of
them there. Nothing is imported from it: the Snakefile hands over its objects.
"""

import atexit
import contextlib
import logging
import os
import re
import shlex
import socket
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from r37core.base.io import READ_ONLY, InputFileError
from r37core.base.origin import date_created
from r37core.config import ConfigError, Settings
from r37core.config.remarks import remarks_at_end
from r37core.plans.extent import number_of
from r37core.product.closing import closing_lines
from r37core.product.extensions import settings_of_run, whole_extent
from r37core.product.remarks import check_asked, lines_of_extensions, remarks, replaced_level, source_folder

from . import failures, lock
from .caller import Caller
from .executor import Executor
from .progress import Progress, quieten

SNAKEMAKE = "9.27.1"
"""The version that this package was written for."""

_OF_A_FILE = re.compile(rf"^ *{InputFileError.__name__}: (.*)$", re.MULTILINE)


@dataclass(frozen=True)
class Console:
    """One run of the `workflow`, with its `settings` and its package's `source`.

    `refusal`: Snakemake's own exception, which it shows without a traceback. `tell` warns the user; `began`: time in s;
    `caller`: of a run that a Python call has started, which says all itself.
    """

    workflow: Any
    refusal: type[Exception]
    tell: Callable[[str], object]
    settings: Settings
    source: Path
    began: float
    caller: Caller | None

    def start(self) -> None:
        """Check the targets, before the first job."""
        with _refused(self.refusal):
            check_asked(self.settings, self.workflow.dag_settings.targets)
        if self.workflow.local_exec:
            # Snakemake keeps to a number of jobs per second by timers, one more for every job that ends while others wait: a
            # quarter of a core in the default sweep. The limit is for the queues of clusters
            self.workflow.scheduler.job_rate_limiter = None
            if self.workflow.executor_plugin.executor is not Executor:
                self.tell("each job starts by itself, which takes several times as long as with --executor warm")

    def succeed(self) -> None:
        """Print what the run found, after the last job."""
        lock.release()
        if self.caller:
            return
        extension_lines = lines_of_extensions(self.settings, self.began)
        lines = closing_lines(self.settings.results, self.began, time.time(), remarks_at_end(self.settings), extension_lines)
        _say_last([*failures.taken(), *lines])

    def fail(self) -> None:
        """Print the messages of failed jobs, what matters last."""
        lock.release()
        if self.caller:
            self.caller.failed(failures.notes())
        else:
            lines: list[str] = []
            # a figure that failed hides no verdict, and what is half made no failure
            with contextlib.suppress(Exception):
                lines = lines_of_extensions(self.settings, self.began)
            _say_last(["", *lines, *failures.taken()])


def begin(workflow: Any, logger: logging.Logger, refusal: type[Exception], root: Path, values: Mapping[str, Any]) -> Console:
    """Read the configuration of a run, say what there is to say, and put one line in place of thousands of messages.

    `root`: folder of our Snakefile. `values`: configuration that another Snakefile gives its module r37, on top of all.
    Snakemake's own messages of each job are in its log file, and on the terminal with R37_FULL_LOG=1 or --verbose. Raises
    `refusal` for a configuration that is not allowed.
    """
    began, config, output = time.time(), workflow.config_settings, workflow.output_settings
    refusal, caller = without_files(refusal), Caller.current()
    for handler in logger.handlers:
        handler.addFilter(MessageAlone())
        if caller:
            handler.addFilter(caller)
    if workflow.is_main_process:
        failures.begin(f"{socket.gethostname()}_{os.getpid()}")
    # Snakemake puts it into the commands of its scripts as it stands: a blank or `$()` in a folder's name would count
    sys.executable = shlex.quote(sys.executable)
    Executor.scripts = root / "workflow/scripts"
    if workflow.remote_exec:
        Executor.replace_local()
    if "CONDA" in {method.name for method in workflow.deployment_settings.deployment_method}:
        raise refusal("--sdm conda: jobs need the Python that runs Snakemake, with r37 in it; leave the option out")
    # where our Snakefile is the main one, values are those of the command line, without lines and with texts for numbers
    above = {} if workflow.modifier.is_main_snakefile() else values
    # read here instead of by a `configfile:`, so that messages have lines and numbers are numbers in every file
    with _refused(refusal):
        source = source_folder(root)
        # another Snakefile that has our rules as a module may have no configuration of its own
        own, only_given = Path(workflow.basedir), config.replace_workflow_config
        folder = own if (own / "config").is_dir() else root
        settings = settings_of_run(folder, config.configfiles, config.config, above, only_given=only_given)
    check_machine(settings.results, refusal, reads_only=output.dryrun)
    lifted = lock.enter() if workflow.is_main_process else []
    for line in [*lifted, *remarks(settings), *replaced_level(settings)]:
        logger.info(line)
    if not (caller or os.environ.get("R37_FULL_LOG") or output.dryrun or output.verbose):
        quieten(logger.handlers, Progress(number_of(whole_extent(settings))))
    return Console(workflow, refusal, logger.warning, settings, source, began, caller)


def check_machine(results: Path, refusal: type[Exception], reads_only: bool) -> None:
    """Refuse what would end a run only when it writes its first or last file."""
    try:
        date_created()
    except ValueError as error:
        raise refusal(str(error)) from None
    if results.exists() and not reads_only and not os.access(results, os.W_OK):
        raise refusal(f"{results}: cannot be written; {READ_ONLY}")


def without_files(refusal: type[Exception]) -> type[Exception]:
    """Snakemake's own exception, without the traceback from which it lists the places in our rules."""
    hidden = property(lambda error: None, lambda error, traceback: None)
    return type(ConfigError.__name__, (refusal,), {"__traceback__": hidden})


class MessageAlone(logging.Filter):
    """A filter that leaves of an error the message of the file that could not be read, and of an interruption STOPPED."""

    _interrupted = False

    def filter(self, record: logging.LogRecord) -> bool:
        """Every record passes."""
        if getattr(record, "exception", None) == "InputFunctionException" and (told := _OF_A_FILE.search(record.getMessage())):
            record.msg, record.args = told[1], ()
        self._interrupted |= record.getMessage().startswith("Terminating processes on user request")
        if self._interrupted and record.levelno == logging.ERROR and getattr(record, "exception", None) == "WorkflowError":
            record.msg, record.levelno, record.levelname = failures.STOPPED, logging.INFO, "INFO"
        return True


@contextlib.contextmanager
def _refused(refusal: type[Exception]) -> Iterator[None]:
    try:
        yield
    except ConfigError as error:
        raise refusal(str(error)) from None


def _say_last(lines: list[str]) -> None:
    """Print lines after Snakemake's own last words. The lines are made before: `--directory` is left by then."""
    atexit.register(sys.stderr.writelines, [f"{line}\n" for line in lines])
