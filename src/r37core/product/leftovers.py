"""Results that the configuration no longer asks for: `python -m r37core.product.leftovers` lists or removes them."""

import argparse
import re
import shutil
from collections.abc import Iterator
from itertools import count
from pathlib import Path

from r37core.base.speeds import SpeedPlan, exact_text
from r37core.config import Settings
from r37core.plans import paths
from r37core.plans.sweep_plan import Sweep, speeds_of_round
from r37core.product.extensions import RESERVED, read_settings
from r37core.product.targets import everything
from r37core.sweep.recipe import STRUCTURES


def leftovers(results: Path, settings: Settings) -> list[Path]:
    """Folders and files in `results` that the configuration no longer asks for; what no rule makes is left alone."""
    left = {*_run_leftovers(results, settings), *_dropped(results, settings)} if results.is_dir() else set()
    return sorted(path for path in left if left.isdisjoint(path.parents))


def _run_leftovers(results: Path, settings: Settings) -> Iterator[Path]:
    expected = {results: [*settings.blades, *RESERVED]} | {results / blade: list(settings.scenes) for blade in settings.blades}
    for place, names in expected.items():
        yield from (folder for folder in place.glob("*/") if folder.is_dir() and folder.name not in names)
    for (blade, scene), plan in settings.speed_plans.items():
        folder = results / blade / scene
        wanted = {f"speed_{exact_text(speed)}.npz" for speed in _speeds(folder, plan)}
        yield from (file for file in folder.glob("speed_*.npz") if file.name not in wanted)
        if not plan.refined:
            yield from folder.glob("round_*.json")


def _dropped(results: Path, settings: Settings) -> Iterator[Path]:
    """Files that fit a pattern of what the rules make, and are not planned; the folder of a named run is no blade's."""
    patterns = _planned(settings)
    planned = {results / file.removeprefix("<results>/") for file in paths.filled(patterns)}
    for pattern in patterns:
        plain = pattern.removeprefix("<results>/")
        files = results.glob(re.sub(r"\{\w+\}", "*", plain))
        others = RESERVED if plain.startswith("{blade}") else ()
        yield from (file for file in files if file not in planned and file.relative_to(results).parts[0] not in others)
    # a job that makes a dataset alone keeps what it goes on from in a folder of the same name
    folders = {folder for file in planned for folder in (file.with_suffix(""), *file.parents)}
    for pattern in {parent for file in patterns for parent in _own_folders(file)}:
        present = (folder for folder in results.glob(re.sub(r"\{\w+\}", "*", pattern)) if folder.is_dir())
        # models of members and designs are hidden next to them
        yield from (folder for folder in present if folder not in folders and not folder.name.startswith("."))
    yield from (parts.parent for parts in results.glob(f"*/{STRUCTURES}") if parts.parent not in folders)


def _own_folders(pattern: str) -> Iterator[str]:
    """Patterns of the folders of blades, and of others, inside the folders that capabilities have to themselves."""
    first, *others = Path(pattern.removeprefix("<results>/")).parts[:-1] or ("",)
    if first in RESERVED:
        yield from ("/".join((first, *others[:depth])) for depth in range(1, len(others) + 1))


def _planned(settings: Settings) -> dict[str, paths.Wildcards]:
    """Patterns of files that one configuration makes and another does not, with those of this one."""
    tip_lines = {settings.structure.boundary.tip_line, *(scene.tip_line for scene in settings.scenes.values())}
    models = [{"blade": blade, "tip_line": line} for blade in settings.blades for line in tip_lines]
    model_files = dict.fromkeys((paths.CONTACT_MODEL, paths.STRESS_OPERATOR, paths.REDUCED_MODEL), models)
    return everything(Sweep(settings)) | model_files


def _speeds(folder: Path, plan: SpeedPlan) -> list[float]:
    """Speeds that the rounds of refinement asked for; all of the grid while no last round says that they are done."""
    speeds: list[float] = list(plan.certain)
    for number in count():
        file = folder / f"round_{number}.json"
        if not plan.refined or not file.exists():
            break
        new = speeds_of_round(str(file))
        if not new:
            return speeds
        speeds += new
    return plan.every_speed()


def size(path: Path) -> int:
    """Bytes of a file, or of all files in a folder."""
    return sum(file.stat().st_size for file in path.rglob("*") if file.is_file()) if path.is_dir() else path.stat().st_size


def main() -> None:
    """List what is left over, or remove it."""
    parser = argparse.ArgumentParser(description="Results that the configuration no longer asks for.")
    parser.add_argument("--remove", action="store_true", help="remove them; without it they are listed")
    chosen = parser.parse_args()
    settings = read_settings(Path("."))
    left = leftovers(settings.results, settings)
    for path in left:
        print(f"{size(path) / 1e6:10.2f} MB  {path}")
        if chosen.remove:
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    print(f"{len(left)} left over" + (", removed" if chosen.remove else "; make clean REMOVE=yes removes them" if left else ""))


if __name__ == "__main__":
    main()
