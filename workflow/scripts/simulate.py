"""Simulate one blade at one speed in one scene. Arguments: speed, output, log, task, about, models. Output: speed_*.npz.

Started by start.py, without Snakemake's own preamble; task and attributes of the file, in JSON, are made in r37core.plans. The
server that forks these jobs calls `make_ready` (r37core.console.job_server).
"""

import sys

from r37core.console.failures import reported
from r37core.machine_code.native import this_processor
from r37core.time_integration.speed_job import make_ready, run_job

__all__ = ["make_ready"]

# done once for the jobs that a server forks from here
this_processor()


if __name__ == "__main__":
    speed, output, log, task, about, *models = sys.argv[1:]
    with reported("simulate", log, f"speed {speed}, "):
        run_job(speed, output, task, about, *models)
