"""Reading of config.yaml and the files it names: checked settings, or one refusal of all that is wrong."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from r37core.base.varied_number import BLADE, SCENE

from .blade_kind import blade_kinds
from .blades import blades_model
from .config_file import UNITS, Config
from .document import ConfigError, ConfigRefusals, Document, command_line_document, completed, entries_of, read_document
from .families import Designs, expanded_families
from .fidelity import Level, Levels
from .named_files import file_keys, located_files, located_in_configuration
from .scenes import Scenes
from .settings import Settings

CONFIG_FILE = "config/config.yaml"


@dataclass(frozen=True)
class Reader:
    """Reads configurations: config.yaml is checked by `model`, and what concerns several files by `checks`."""

    model: type[Config]
    checks: tuple[Callable[[Settings], None], ...]

    def read_settings(self, root: Path, *changes: Document) -> Settings:
        """Settings of config/config.yaml in the folder `root`, with `changes` on top. Raises ConfigError."""
        return self.load_settings(together(configuration_file(root, CONFIG_FILE, root), changes), root)

    def settings_of_run(
        self,
        root: Path,
        files: Sequence[Path],
        values: Mapping[str, Any],
        module_values: Mapping[str, Any] | None = None,
        only_given: bool = False,
    ) -> Settings:
        """Settings of a run of the workflow in the current folder: the configuration, `files` on top, then `values`.

        The configuration is config/config.yaml of the current folder or, where that has none, of `root`; it is left out if
        `only_given`. `module_values`: on top of all, what another workflow gives its module r37. Raises ConfigError.
        """
        here = Path.cwd()
        folder = here if (here / CONFIG_FILE).exists() else root
        first = [] if only_given and files else [configuration_file(folder, CONFIG_FILE, root)]
        named = [Path(file).relative_to(here) if Path(file).is_relative_to(here) else Path(file) for file in files]
        changes = [*first, *(configuration_file(here, str(file), root) for file in named), command_line_document(values)]
        if module_values:
            place = "config of the module r37"
            if not isinstance(module_values, Mapping):
                raise ConfigError(f"{place}: found {module_values!r}; allowed: keys and values, as in {CONFIG_FILE}")
            changes.append(command_line_document(module_values, place))
        return self.load_settings(together(changes[0], changes[1:]), root)

    def load_settings(
        self,
        config: Document | Mapping[str, Any],
        root: Path,
        *,
        blades_above: Document | None = None,
        scenes_above: Document | None = None,
    ) -> Settings:
        """Check a configuration (the content of config.yaml) and the files it names, as seen from the folder `root`.

        `blades_above`, `scenes_above`: changes that lie on top of these two files. Raises ConfigError before any work is done,
        with all that is wrong in the files or, where these are right by themselves, with all that is wrong with them together.
        """
        document = config if isinstance(config, Document) else Document(CONFIG_FILE, dict(config))
        refusals = ConfigRefusals()
        checked = refusals.of(document.check, self.model)
        files = [self._file(document, key) for key in ("blades_file", "fidelity_file", "scenes_file")]
        designs = refusals.of(designs_of_file, BLADE, root, files[0], blades_above)
        levels = refusals.of(_levels, root, files[1])
        scenes = refusals.of(designs_of_file, SCENE, root, files[2], scenes_above)
        refusals.tell()
        assert checked and designs and levels and scenes
        settings = Settings(root, document, checked, designs, *levels, scenes)
        for check in self.checks:
            refusals.of(check, settings)
        refusals.tell()
        return settings

    def _file(self, document: Document, key: str) -> str:
        """The file that config.yaml names, also where something else there is refused."""
        named = document.content.get(key) if isinstance(document.content, Mapping) else None
        return named if isinstance(named, str) and named.isprintable() else self.model.model_fields[key].default


def _levels(root: Path, name: str) -> tuple[dict[str, Level], Document]:
    document = read_document(root, name)
    return document.check(Levels).root, document


def entry_document(kind: str, root: Path, name: str, above: Document | None = None) -> tuple[Document, ConfigRefusals]:
    """The file `name` of blades or scenes (`kind`), with changes `above`: entries with what their bases give them.

    Files that blades name are seen from `root`. Also the refusals of bases that are not there; entries with these are left out.
    """
    document, refusals = completed(read_document(root, name), above, kind, blade_kinds() if kind == BLADE else ("base",))
    if kind == BLADE and (entries := entries_of(document)):
        located = {key: located_files(entry, file_keys(entry), root / name, root) for key, entry in entries.items()}
        document = replace(document, content={**document.content, **located})
    return document, refusals


def designs_of_file(kind: str, root: Path, name: str, above: Document | None = None) -> Designs[Any]:
    """Blades or scenes (`kind`) of the file `name`, which starts from the folder `root`, with changes `above`.

    Raises ConfigError for all that is wrong.
    """
    document, refusals = entry_document(kind, root, name, above)
    if not document.content:
        # all entries have bases that are refused
        refusals.tell()
    checked = refusals.of(document.check, {BLADE: blades_model(), SCENE: Scenes}[kind])
    refusals.tell()
    assert checked
    return expanded_families(checked.root, root, document)


def configuration_file(folder: Path, name: str, root: Path | None = None) -> Document:
    """A file with keys of config.yaml, and the files that it names as seen from `root`, or absolute. Raises ConfigError."""
    document = read_document(folder, name)
    if not isinstance(document.content, dict):
        raise document.refusal(repr(document.content)[:60], "keys and values, as in config/config.yaml")
    return replace(document, content=located_in_configuration(document.content, folder / name, root))


def together(below: Document, changes: Iterable[Document]) -> Document:
    """A configuration with `changes` on top, each on those before it."""
    for change in changes:
        below = _single_unit(below, change).overlaid(change)
    return below


def _single_unit(below: Document, change: Document) -> Document:
    """The document without speeds in the unit that a change on top does not give its own in."""
    keys = [key for key in UNITS if key in change.content]
    if len(keys) != 1:
        return below
    return replace(below, content={key: value for key, value in below.content.items() if key not in UNITS or key in keys})
