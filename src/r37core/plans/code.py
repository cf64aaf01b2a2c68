"""Hashes of the code that a rule's script runs, so that a rule runs again when that code changes and only then."""

import ast
import hashlib
import json
from collections.abc import Collection
from functools import cache
from itertools import takewhile
from pathlib import Path

from r37core.base.packages import PACKAGES
from r37core.machine_code import code_hash
from r37core.machine_code.kept import keep, read_kept


class CodeHashes:
    """Hashes of code by its name: a script in the folder `scripts`, a module or a function of the packages in `source`.

    Each is of all that it imports from the scripts and the package, directly or not. Of a function's own module only what
    the function uses counts. Comments, docstrings and layout do not count, nor does the version in the package's own
    __init__. `source` may hold other packages, too: of those in it only imports of `packages` count.
    """

    def __init__(self, source: Path, scripts: Path, packages: Collection[str] = PACKAGES):
        self._source, self._scripts, self._packages = source, scripts, packages
        self._version_file = source / PACKAGES[0] / "__init__.py"
        # closures share most of their parts
        self._parts, self._needed = cache(self._parts_of), cache(self._needed_by)
        self._order = cache(lambda part: (part[0].is_relative_to(scripts), part[0].parts, part[1]))

    def __call__(self, *names: str) -> str:
        """Short hash of what has these names, as `step`, `r37core.fem.steps` or `r37core.fem.steps.mesh`, and its imports."""
        digest = hashlib.sha256()
        for file, function in self._parts(*names):
            digest.update(file.name.encode() + fingerprint(file, function))
        _facts_of_files().save()
        return digest.hexdigest()[:16]

    def step(self, function: str, *modules: str) -> dict[str, str]:
        """Parameters of a rule that runs this step by the script step.py: its name, and the hash of its code.

        `function`: a step, as `r37core.fem.steps.mesh`; `modules`: those that it imports by name.
        """
        return {"step": function, "code": self("step", function, *modules)}

    def closure(self, *names: str) -> list[Path]:
        """The files of what has these names and of all that they import, directly or not, sorted."""
        return sorted({file for file, _ in self._parts(*names)})

    def _parts_of(self, *names: str) -> list[tuple[Path, str]]:
        """Files, each with the name of the function that alone counts, or "" for the whole.

        Sorted, those of the package first wherever it lies: a hash is of code and not of places.
        """
        parts: set[tuple[Path, str]] = set()
        waiting = [part for name in names for part in self._named(name)]
        while waiting:
            part = waiting.pop()
            if part not in parts:
                parts.add(part)
                waiting += self._needed(*part)
        return sorted(parts - {(self._version_file, "")}, key=self._order)

    def _needed_by(self, file: Path, function: str) -> list[tuple[Path, str]]:
        _, names = _facts_of_files().of(file, function)
        return list({(imported, ""): None for name in names for imported in self._files(name)})

    def _named(self, name: str) -> list[tuple[Path, str]]:
        above, _, last = name.rpartition(".")
        *packages, file = self._files(name)
        is_function = above != "" and self._files(above) == (*packages, file)
        return [*((package, "") for package in packages), (file, last if is_function else "")]

    def _files(self, name: str) -> tuple[Path, ...]:
        counts = name.partition(".")[0] in self._packages
        return module_files(name, (self._scripts, self._source) if counts else (self._scripts,))


@cache
def module_files(name: str, roots: tuple[Path, ...]) -> tuple[Path, ...]:
    """Files of a dotted name, which may end in something that is no module: it and the packages above it."""
    parts = name.split(".")
    below = [root.joinpath(*parts[:count]) for root in roots for count in range(1, len(parts) + 1)]
    return tuple(file for path in below for file in (path.with_suffix(".py"), path / "__init__.py") if _is_file(file))


_is_file = cache(Path.is_file)
"""There are more imports than files."""


def fingerprint(file: Path, function: str = "") -> bytes:
    """Hash of what a file does, or its `function` and what that uses: the same for other docstrings and versions of Python."""
    return _facts_of_files().of(file, function)[0]


class _FactsOfFiles:
    """Fingerprint and imports by a hash of all that they follow from, kept from run to run: hundreds of trees take seconds."""

    _NAME, _MOST = "code_hashes.json", 5000

    def __init__(self) -> None:
        content = read_kept(self._NAME)
        self._known: dict[str, tuple[str, list[str]]] = json.loads(content) if content else {}
        self._new = False
        self._own = b"".join(Path(file).read_bytes() for file in (__file__, code_hash.__file__))
        self.of = cache(self._read)

    def _read(self, file: Path, function: str) -> tuple[bytes, list[str]]:
        content, package = file.read_bytes(), _package_of(file)
        key = hashlib.sha256(b"\0".join([self._own, ".".join([*package, function]).encode(), content])).hexdigest()
        if key not in self._known:
            tree = ast.parse(content)
            if function:
                tree = _used_by(function, tree)
            self._known[key] = (code_hash.code_hash(tree).hex(), _imported_names(tree, package))
            self._new = True
        fingerprint, names = self._known[key]
        return bytes.fromhex(fingerprint), names

    def save(self) -> None:
        if self._new:
            # too many are of versions long past
            kept = self._known if len(self._known) <= self._MOST else {}
            keep(json.dumps(kept).encode(), self._NAME)
        self._new = False


@cache
def _facts_of_files() -> _FactsOfFiles:
    return _FactsOfFiles()


def _used_by(function: str, tree: ast.Module) -> ast.Module:
    """The statements of a module that bind what its function uses, directly or not, and those that bind nothing."""
    wanted, binding = {function}, [(statement, _bound_by(statement)) for statement in tree.body]
    body: list[ast.stmt] = []
    while more := [statement for statement, bound in binding if statement not in body and (not bound or bound & wanted)]:
        body += more
        wanted |= {node.id for statement in more for node in ast.walk(statement) if isinstance(node, ast.Name)}
    return ast.Module([statement for statement in tree.body if statement in body], [])


def _bound_by(statement: ast.stmt) -> set[str]:
    """Names that a statement of a module binds, if that is all it does."""
    if isinstance(statement, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return {statement.name}
    if isinstance(statement, ast.Import | ast.ImportFrom):
        return {alias.asname or alias.name.partition(".")[0] for alias in statement.names}
    if isinstance(statement, ast.Assign | ast.AnnAssign):
        return {node.id for node in ast.walk(statement) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    return set()


def _imported_names(tree: ast.Module, package: list[str]) -> list[str]:
    """Absolute dotted names of all that is imported, functions' own imports included."""
    names: list[str] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) - node.level + 1] if node.level else []
            module = [*above, *([node.module] if node.module else [])]
            names += [".".join([*module, alias.name]) for alias in node.names]
    return names


def _package_of(file: Path) -> list[str]:
    """Names of the packages that a file lies in, from the outermost."""
    return [folder.name for folder in takewhile(lambda folder: (folder / "__init__.py").exists(), file.parents)][::-1]
