"""Lists the claims that are older than what makes them, and makes them again. Run: make claims [ONLY=name] [LIST=yes].

A name is that of a claim, of a page or picture (growth.png), or of a table (accuracy.md#growth). Files of results that a
command does not renew are not taken, unless Snakemake made them: it knows itself what is out of date.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path

from r37core.io import write_text
from r37core.text_file import with_part

from .claim import ROOT, Claim, Output
from .hashes import present_hash
from .older import read_older, write_older
from .registry import CLAIMS
from .stamps import read_stamp, write_stamp

_SNAKEMAKES = ("results/figures/", "results/runs/")


def stale(claims: Iterable[Claim], root: Path) -> list[tuple[Claim, list[Output]]]:
    """Claims with outputs whose hash is not the present one, those that tests compare left out."""
    older = [
        (claim, [output for output in claim.outputs if read_stamp(output, root) != present_hash(claim, output, root)])
        for claim in claims
        if not claim.checked_by
    ]
    return [(claim, outputs) for claim, outputs in older if outputs]


def named(name: str) -> list[Claim]:
    """The claims of a name; ValueError where there are none."""
    claims = [claim for claim in CLAIMS if name == claim.name or any(_is(output, name) for output in claim.outputs)]
    if not claims:
        allowed = ", ".join(claim.name for claim in CLAIMS)
        raise ValueError(f"ONLY: found '{name}'; allowed: {allowed}, or a file or table of docs/, as accuracy.md#growth")
    return claims


def _is(output: Output, name: str) -> bool:
    return name in (output.place, output.page, Path(output.page).name, output.place.removeprefix("docs/"))


def make(claim: Claim, cores: str, root: Path) -> None:
    """Run the commands of a claim and put what they made into the pages; ValueError where something was not made.

    The hashes are those from before: what is changed meanwhile makes the output old.
    """
    hashes = present_hashes(claim, root)
    began = time.time()
    for command in claim.commands:
        words = command.replace("{snakemake}", f"{{python}} -m snakemake --cores {cores}").replace("{python}", sys.executable)
        print(f"+ {words}", flush=True)
        subprocess.run(
            words, shell=True, cwd=root, check=True, env=os.environ | {"PYTHONPATH": str(root / "validation/benchmarks")}
        )
    for output in claim.outputs:
        made = output.source or output.page
        # Snakemake leaves what is up to date as it is
        by_script = "{snakemake}" not in claim.commands[-1] and not made.startswith(_SNAKEMAKES)
        if not (root / made).exists() or (by_script and (root / made).stat().st_mtime < began - 1.0):
            raise ValueError(f"{claim.name}: its commands did not write {made}")
    take(claim, hashes, root)


def present_hashes(claim: Claim, root: Path) -> dict[str, str]:
    """Place -> the present hash, of outputs that carry one."""
    return {output.place: present_hash(claim, output, root) for output in claim.outputs if not claim.checked_by}


def keep(claim: Claim, root: Path) -> None:
    """Renew the hashes of what is there; what is known to be older stays so."""
    older, hashes = read_older(root), present_hashes(claim, root)
    for output in claim.outputs:
        if output.place in hashes.keys() - older.keys():
            write_stamp(output, hashes[output.place], root)


def take(claim: Claim, hashes: dict[str, str], root: Path) -> None:
    """Put what was made into the pages, with its hashes; older than what makes it is nothing of that any more."""
    for output in claim.outputs:
        if output.source is not None and output.marker:
            text = (root / output.source).read_text(encoding="utf-8")
            page = (root / output.page).read_text(encoding="utf-8")
            write_text(with_part(page, output.marker, output.text(text)), root / output.page)
        elif output.source is not None:
            shutil.copy(root / output.source, root / output.page)
        if output.place in hashes:
            write_stamp(output, hashes[output.place], root)
    write_older({place: why for place, why in read_older(root).items() if place not in hashes}, root)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(prog="make claims", description=__doc__.split("\n")[0])
    parser.add_argument("only", nargs="*", help="names; without, all that are older")
    parser.add_argument("--list", action="store_true", help="make nothing")
    parser.add_argument("--taken", action="store_true", help="the results are there, made by this code: run no command")
    parser.add_argument("--same", action="store_true", help="code was rearranged, results are the same: renew only the hashes")
    parser.add_argument("--cores", default="2")
    options = parser.parse_args()
    if (options.taken or options.same) and not options.only:
        parser.error("TAKEN and SAME need ONLY=name: whoever asks for them vouches for these")
    try:
        _make_all(options)
    except (ValueError, subprocess.CalledProcessError) as error:
        sys.exit(str(error))


def _make_all(options: argparse.Namespace) -> None:
    chosen = [claim for name in options.only for claim in named(name)]
    # what was asked for by name is made, older or not
    todo = [(claim, list(claim.outputs)) for claim in chosen] if chosen else stale(CLAIMS, ROOT)
    reasons = read_older(ROOT)
    for claim, outputs in todo:
        print(f"{claim.name} ({'minutes not measured' if claim.minutes is None else f'about {claim.minutes:g} min'}):")
        print("\n".join(f"    {output.place}{_because(reasons.get(output.place))}" for output in outputs))
        if claim.by_hand:
            print(f"    by hand: {claim.by_hand}; then make claims ONLY={claim.name} TAKEN=yes")
    minutes = sum(claim.minutes or 0.0 for claim, _ in todo if claim.commands)
    print(f"{len(todo)} to make, about {minutes / 60.0:.1f} hours in all" if todo else "nothing is older than what makes it")
    if options.list:
        return
    for claim, _ in todo:
        if options.same:
            keep(claim, ROOT)
        elif options.taken:
            take(claim, present_hashes(claim, ROOT), ROOT)
        elif claim.commands:
            make(claim, options.cores, ROOT)


def _because(why: str | None) -> str:
    return f": {why}" if why else ""


if __name__ == "__main__":
    main()
