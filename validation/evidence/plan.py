"""What the evidence is made of: runs of the product, and steps that make tables and pictures of their files.

The files of validation/plan declare them, one subject each. The hash of an item is of all that it uses: its code, its
parameters, the configuration of the runs that it reads, the items behind it and the numbers of the engine.
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property
from importlib import import_module
from pathlib import Path
from pkgutil import resolve_name
from typing import Any

from r37core.base.io import as_list, write_json
from r37core.base.yaml_file import load_yaml
from r37core.plans.code import CodeHashes

from .configuration import overlay

VALIDATION = Path("validation")
TABLES = f"{VALIDATION}/tables"
ENGINE = f"{VALIDATION}/engine_numbers.json"
MADE = "results/evidence"
"""Folder of what is not committed."""

Files = Mapping[str, str | Sequence[str]]


@dataclass(frozen=True)
class Run:
    """A run of the product: overlays of config/ and keys on top of the shipped configuration; without a name the main job.

    `alone`: with nothing beside it, as it measures its own time. `priority`: more for longer ones, which begin first.
    `memory_mb`: the most that it takes, for a model of the level `standard`.
    """

    name: str
    overlays: tuple[str, ...] = ()
    keys: Mapping[str, Any] = field(default_factory=dict)
    alone: bool = False
    priority: int = 1
    memory_mb: int = 2200

    @property
    def folder(self) -> str:
        """Folder of its results."""
        return f"results/runs/{self.name}" if self.name else "results"

    @property
    def content(self) -> dict[str, Any]:
        """Its configuration on top of the shipped one."""
        named = {"run": {"name": self.name}} if self.name else {}
        return overlay(Path(), *self.overlays, **self.keys, **named)

    def responses(self, blades: Sequence[str], *scenes: str) -> list[str]:
        """Responses of blades in some scenes."""
        return [f"{self.folder}/{blade}/{scene}/response.nc" for scene in scenes for blade in blades]

    def models(self, blade: str) -> dict[str, str]:
        """Models of a blade for runs with stress, by kind."""
        return {kind: f"{self.folder}/{blade}/{kind}_pressure_edge.npz" for kind in ("contact", "stress")}


@dataclass(frozen=True)
class Item:
    """A step of the evidence: its function, as `evidence.clearance.peaks`, the files that it makes and reads, and parameters.

    `alone`: with nothing beside it, on all cores. `priority`: as of a run. `sources`: files of the repository that it is made
    from, which count by their content. `program`: one that it needs and that pip does not install.
    """

    step: str
    outputs: Files
    inputs: Files = field(default_factory=dict)
    params: Mapping[str, Any] = field(default_factory=dict)
    sources: Sequence[str] = ()
    alone: bool = False
    priority: int = 0
    memory_mb: int = 1000
    program: str = ""

    @property
    def name(self) -> str:
        """Name of its job: that of its first file."""
        return Path(self.files[0]).stem

    @property
    def files(self) -> list[str]:
        """All that it makes."""
        return [file for files in self.outputs.values() for file in as_list(files)]

    @property
    def read(self) -> list[str]:
        """All that it reads of other items and of runs."""
        return [file for files in self.inputs.values() for file in as_list(files)]


def table(name: str) -> str:
    """File of a table."""
    return f"{TABLES}/{name}.csv"


class Plan:
    """All items and runs of a project's validation/plan, and the hash of what each is made from."""

    def __init__(self, root: Path = Path()):
        self.root = root
        modules = [import_module(f"plan.{file.stem}") for file in sorted((root / VALIDATION / "plan").glob("[a-z]*.py"))]
        values = [value for module in modules for value in vars(module).values()]
        self.runs = {value.name: value for value in values if isinstance(value, Run)}
        self.items = {item.name: item for module in modules for item in getattr(module, "EVIDENCE", ())}
        self._code = CodeHashes(root / VALIDATION, root / VALIDATION, packages=("evidence",))
        self._all_code = CodeHashes(root / "src", root / VALIDATION)
        self._maker = {file: item for item in self.items.values() for file in item.files}
        self.hash_of = cache(self._hash_of)

    @cached_property
    def committed(self) -> dict[str, Item]:
        """Committed files, and the item that makes each."""
        return {file: item for file, item in sorted(self._maker.items()) if not file.startswith("results/")}

    def behind(self, part: Item | Run) -> tuple[list[Item], list[Run]]:
        """Items and runs whose files a part reads."""
        if isinstance(part, Run):
            return [], []
        makers = [self._maker.get(file) for file in part.read]
        items = list(dict.fromkeys(maker.name for maker in makers if maker))
        runs = {self._run_of(file).name: None for file, maker in zip(part.read, makers, strict=True) if not maker}
        return [self.items[name] for name in items], [self.runs[name] for name in runs]

    def targets(self, run: Run) -> list[str]:
        """Files of a run that items read."""
        read = {file for item in self.items.values() for file in item.read if file not in self._maker}
        return sorted(file for file in read if self._run_of(file) == run)

    def _run_of(self, file: str) -> Run:
        parts = Path(file).parts
        if parts[0] != "results":
            raise ValueError(f"{file}: a file of the repository is a source")
        return self.runs[parts[2] if parts[1] == "runs" else ""]

    def stamp(self, part: Item | Run) -> str:
        """File that is there when a run, or an item with all its files, was made from what is there now."""
        name = part.name if isinstance(part, Item) else f"product_{part.name}"
        return f"{MADE}/stamps/{name}-{self.hash_of(name)}"

    def part(self, name: str) -> Item | Run:
        """The item, or the run, whose stamp has this name."""
        return self.items[name] if name in self.items else self.runs[name.removeprefix("product_")]

    def threads(self, name: str, cores: int) -> int:
        """Cores of a part: all where it is alone, half of them for a run, so that another one fills what it leaves idle."""
        part = self.part(name)
        if part.alone:
            return cores
        return max(cores // 2, 1) if isinstance(part, Run) else 1

    def without_program(self) -> dict[str, str]:
        """Items that cannot be made here, by name, and the program that is not installed."""
        return {item.name: item.program for item in self.items.values() if item.program and not shutil.which(item.program)}

    def _hash_of(self, name: str) -> str:
        return hashlib.sha256("\n".join(self._parts_of(self.part(name))).encode()).hexdigest()[:16]

    def _parts_of(self, part: Item | Run) -> Iterator[str]:
        """What the hash of an item or a run is of."""
        if isinstance(part, Run):
            # the files that it is asked for do not count: another item may ask for more
            yield repr([part.content, *self._entries_of(part.content)])
            yield self._engine
            return
        # the numbers of the engine are made again when any of its code has changed, all else when these move
        yield self._all_code(part.step) if ENGINE in part.files else self._code(part.step)
        yield repr((part.step, part.outputs, part.inputs, part.params))
        # of a step that runs the product's functions itself, at levels of its own
        if configuration := part.params.get("configuration"):
            yield repr(list(self._entries_of({"fidelity": "all"} | configuration)))
        yield from (hashlib.sha256((self.root / source).read_bytes()).hexdigest() for source in part.sources)
        if ENGINE not in part.files:
            yield self._engine
        items, runs = self.behind(part)
        yield from (self.hash_of(item.name) for item in items)
        yield from (self.hash_of(f"product_{run.name}") for run in runs)

    def _entries_of(self, keys: Mapping[str, Any]) -> Iterator[Any]:
        """What keys take from files of the configuration, as content: comments, layout and other entries do not count."""
        shipped = load_yaml(self.root / "config/config.yaml")
        yield shipped
        for kind in ("blades", "scenes", "fidelity"):
            entries = load_yaml(self.root / str(keys.get(f"{kind}_file", f"config/{kind}.yaml")))
            yield used(entries, keys.get(kind, shipped.get(kind, "all")))

    @cached_property
    def _engine(self) -> str:
        return (self.root / ENGINE).read_text(encoding="utf-8")


def used(entries: Mapping[str, Any], names: str | Sequence[str]) -> list[tuple[str, Any]]:
    """Entries of a file with these names, and those that they are based on; all where a name is not among them."""
    waiting = as_list(names)
    if not set(waiting) <= entries.keys():
        return sorted(entries.items())
    chosen: dict[str, Any] = {}
    while waiting:
        name = waiting.pop()
        chosen[name] = entries[name]
        waiting += [base for base in [chosen[name].get("base")] if base in entries.keys() - chosen.keys()]
    return sorted(chosen.items())


class Named(dict[str, Any]):
    """Files or parameters of a step by name, as attributes."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(name) from None


def make(plan: Plan, name: str, cores: int) -> None:
    """Make the files of an item, or those of a run that items read. Raises what the step raises."""
    part = plan.part(name)
    if isinstance(part, Run):
        run_product(part, plan.targets(part), cores)
        return
    for file in part.files:
        Path(file).parent.mkdir(parents=True, exist_ok=True)
    resolve_name(part.step)(*map(Named, (part.inputs, part.outputs, part.params)))


def run_product(run: Run, targets: Sequence[str], cores: int) -> None:
    """Files of a run by the product's own command. Raises CalledProcessError where it fails; what it made stays."""
    file = Path(f"{MADE}/configurations/{run.name or 'main'}.yaml")
    file.parent.mkdir(parents=True, exist_ok=True)
    # a file of JSON is one of YAML
    write_json(run.content, file)
    limits = ["--cores", str(cores), "--resources", f"mem_mb={run.memory_mb}"]
    words = ["snakemake", *targets, *limits, "--nolock", "--configfile", "config/config.yaml", str(file)]
    subprocess.run([sys.executable, "-m", *words], check=True)
