"""Configuration: YAML files checked by JSON schemas, and the settings made of them."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import yaml
from jsonschema import Draft202012Validator
from jsonschema.exceptions import ValidationError, best_match

from r37core.blade.definition import BladeDefinition
from r37core.blade.errors import BladeShapeError
from r37core.blade.tables import read_profile_table, read_stacking_table, stacking_rows
from r37core.contact.casing import Casing
from r37core.contact.scene import Friction, Lining, Scene
from r37core.fem.material import Material
from r37core.march.choice import MarchChoice
from r37core.speeds import SpeedError, expand_speeds
from r37core.studies.levels import recommended_level
from r37core.yaml_file import load_yaml

_SHIFT_KEYS = ("stacking_table", "sweep_lean", "chordwise_sweep_deg")
_MATERIAL_KEYS = {
    "youngs_modulus_pa": "youngs_modulus",
    "density_kg_m3": "density",
    "poissons_ratio": "poissons_ratio",
    "yield_stress_pa": "yield_stress",
}


class ConfigError(ValueError):
    """A configuration that cannot be used; the message names the file, the key, what was found and what is allowed."""


@dataclass(frozen=True)
class BladeSettings:
    """One blade: its shape and its material."""

    definition: BladeDefinition
    material: Material


@dataclass(frozen=True)
class SceneSettings:
    """One scene: what the blade meets, on which tip line, how long, and which results are wanted."""

    scene: Scene
    tip_line: str
    revolutions: int
    results: tuple[str, ...]
    stress_history_speeds: tuple[float, ...]


@dataclass(frozen=True)
class Settings:
    """Everything the workflow needs to know, checked.

    `blades` and `scenes` are those to run, in order; `speeds` (rad/s) of each (blade, scene); `fidelity` the chosen
    level's entry; `structure` and `campbell` as in the file, with defaults filled in.
    """

    blades: dict[str, BladeSettings]
    scenes: dict[str, SceneSettings]
    speeds: dict[tuple[str, str], tuple[float, ...]]
    fidelity_name: str
    fidelity: dict[str, Any]
    structure: dict[str, Any]
    campbell: dict[str, Any]
    interactions: dict[str, float]
    studies: dict[str, Any]
    levels: dict[str, Any]
    scene_entries: dict[str, Any]
    tolerance: float

    def shape_hash(self, blade: str) -> str:
        """Short hash of all that a blade's geometry depends on."""
        return _short_hash(self.blades[blade].definition, self.structure["edges"])

    def structure_hash(self, blade: str) -> str:
        """Short hash of all that a blade's structural results depend on."""
        return _short_hash(self.blades[blade], self.fidelity["mesh"], self.fidelity["reduction"], self.structure)

    def structure_with(self, tip_line: str) -> dict[str, Any]:
        """The section `structure`, without what only the geometry uses, for contact nodes on `tip_line`."""
        kept = {key: value for key, value in self.structure.items() if key != "edges"}
        return kept | {"boundary": self.structure["boundary"] | {"tip_line": tip_line}}

    def march_choice(self, scene: str, speed: float) -> MarchChoice:
        """Numbers of the march at one speed of a scene, with only what its results need."""
        chosen = self.scenes[scene]
        everything = march_of_level(self.fidelity["march"])
        stress = "stress" in chosen.results
        history = speed in chosen.stress_history_speeds
        return replace(
            everything,
            revolutions=chosen.revolutions,
            snapshots_per_revolution=everything.snapshots_per_revolution if stress else 0,
            snapshot_revolutions=(chosen.revolutions if history else 1) if stress else 0,
            energy="energy" in chosen.results,
        )


def march_of_level(march: Mapping[str, Any]) -> MarchChoice:
    """The march of a fidelity level's section `march`, with the stress of the last revolution and the energy balance."""
    return MarchChoice(
        time_step=march["time_step_s"],
        revolutions=march["revolutions"],
        samples_per_revolution=march["stress_instants"] * march["samples_per_stress_instant"],
        snapshots_per_revolution=march["stress_instants"],
        snapshot_revolutions=1,
        energy=True,
        highest_frequency=march.get("highest_frequency_hz", math.inf),
        integrator=march["integrator"],
        engine=march["engine"],
    )


def _short_hash(*parts: object) -> str:
    """Hash of plain numbers, texts and frozen dataclasses, whose repr is exact."""
    return hashlib.sha256(repr(parts).encode()).hexdigest()[:16]


def load_settings(config: Mapping[str, Any], root: Path, config_name: str = "config/config.yaml") -> Settings:
    """Check a configuration (the content of config.yaml) and the files it names, relative to the folder `root`.

    Raises ConfigError for anything wrong, before any work is done.
    """
    schemas = root / "config" / "schemas"
    checked = _validated(dict(config), schemas / "config.schema.yaml", config_name)
    fidelity_file, blades_file = checked["fidelity_file"], checked["blades_file"]
    levels = _validated(_load(root, fidelity_file), schemas / "fidelity.schema.yaml", fidelity_file)
    level = _level(checked, levels, fidelity_file, config_name)
    entries = _validated(_load(root, blades_file), schemas / "blades.schema.yaml", blades_file)
    names = _selected("blades", checked, entries, blades_file, config_name)
    entries_of_scenes = _scene_entries(checked, root, schemas, config_name)
    scenes = {
        name: _scene(name, entry, levels[level]["march"], checked["structure"]["boundary"]["tip_line"], checked["scenes_file"])
        for name, entry in entries_of_scenes.items()
    }
    submesh = checked["structure"]["stress_submesh"]
    if not submesh["minimum_z_m"] < submesh["maximum_z_m"]:
        raise ConfigError(
            f"{config_name}: structure.stress_submesh.minimum_z_m: found {submesh['minimum_z_m']}; "
            f"allowed: less than maximum_z_m ({submesh['maximum_z_m']})"
        )
    speeds = _speeds(checked, names, list(scenes), levels[level]["march"]["speed_step_rad_s"], config_name)
    _check_history_speeds(scenes, speeds, checked["scenes_file"])
    return Settings(
        blades={name: _blade(name, entries, root, blades_file) for name in names},
        scenes=scenes,
        speeds=speeds,
        fidelity_name=level,
        fidelity=levels[level],
        structure=checked["structure"],
        campbell=checked["campbell"],
        interactions=checked["interactions"],
        studies=checked["studies"],
        levels=levels,
        scene_entries=entries_of_scenes,
        tolerance=checked["tolerance"],
    )


def _level(checked: Mapping[str, Any], levels: Mapping[str, Any], fidelity_file: str, config_name: str) -> str:
    """The level that is named, or for `auto` the cheapest one whose measured error is within the tolerance."""
    if checked["fidelity"] != "auto":
        _check_known("fidelity", [checked["fidelity"]], levels, fidelity_file, config_name)
        return checked["fidelity"]
    measured = {name: level["measured"] for name, level in levels.items() if "measured" in level}
    errors = {name: entry["error"] for name, entry in measured.items()}
    costs = {name: entry["cpu_s_per_run"] for name, entry in measured.items()}
    chosen = recommended_level(errors, costs, checked["tolerance"])
    if chosen is None:
        known = ", ".join(f"{name} {error:g}" for name, error in errors.items()) or "none"
        raise ConfigError(
            f"{config_name}: tolerance: found {checked['tolerance']:g}; measured errors of the levels in {fidelity_file}: "
            f"{known}; accept more, or name a level under fidelity"
        )
    return chosen


def _selected(key: str, checked: Mapping[str, Any], entries: Mapping[str, Any], file: str, config_name: str) -> list[str]:
    """Names that config.yaml asks for under `key`, which may be `all`; ConfigError for one that `file` lacks."""
    names = list(entries) if checked[key] == "all" else list(checked[key])
    _check_known(key, names, entries, file, config_name)
    return names


def _check_known(key: str, names: list[str], entries: Mapping[str, Any], file: str, config_name: str) -> None:
    for name in names:
        if name not in entries:
            raise ConfigError(f"{config_name}: {key}: found '{name}'; allowed: {', '.join(entries)} ({file})")


def _load(root: Path, file: str) -> Any:
    try:
        return load_yaml(root / file)
    except FileNotFoundError:
        raise ConfigError(f"{file}: there is no such file; check the keys ..._file in config.yaml") from None
    except yaml.YAMLError as error:
        raise ConfigError(f"{file}: not readable as YAML: {error}") from None


def _validated(content: Any, schema_file: Path, name: str) -> Any:
    """`content` with the schema's defaults filled in; ConfigError at the first thing wrong."""
    schema = load_yaml(schema_file)
    content = _with_defaults(content, schema)
    error = best_match(Draft202012Validator(schema).iter_errors(content))
    if error is not None:
        raise ConfigError(f"{name}: {_explain(error)}")
    return content


def _with_defaults(content: Any, schema: Mapping[str, Any]) -> Any:
    if not isinstance(content, Mapping):
        return content
    filled = dict(content)
    properties = schema.get("properties", {})
    for key, part in properties.items():
        if key not in filled and "default" in part:
            filled[key] = part["default"]
    others = schema.get("additionalProperties")
    for key, value in filled.items():
        part = properties.get(key, others)
        if isinstance(part, Mapping):
            filled[key] = _with_defaults(value, part)
    return filled


def _explain(error: ValidationError) -> str:
    """`key: found ...; allowed: ...` for a schema violation."""
    key = ".".join(str(part) for part in error.absolute_path) or "top level"
    schema = error.schema
    if error.validator == "required":
        missing = [name for name in error.validator_value if name not in error.instance]
        return f"{key}: missing key {', '.join(missing)}; allowed keys: {', '.join(schema['properties'])}"
    if error.validator == "additionalProperties":
        unknown = [str(name) for name in error.instance if name not in schema["properties"]]
        return f"{key}: found unknown key {', '.join(unknown)}; allowed keys: {', '.join(schema['properties'])}"
    bounds = {
        "minimum": "at least",
        "exclusiveMinimum": "more than",
        "maximum": "at most",
        "exclusiveMaximum": "less than",
        "minItems": "rows: at least",
        "minProperties": "entries: at least",
        "pattern": "text like",
    }
    allowed = [f"one of {', '.join(map(str, schema['enum']))}"] if "enum" in schema else []
    if "oneOf" in schema:
        allowed.append(" or ".join(str(part.get("const", part.get("type"))) for part in schema["oneOf"]))
    if "type" in schema:
        allowed.append(str(schema["type"]))
    allowed += [f"{words} {schema[name]}" for name, words in bounds.items() if name in schema]
    return f"{key}: found {error.instance!r}; allowed: {', '.join(allowed) or error.message}"


def _blade(name: str, entries: Mapping[str, Any], root: Path, file: str) -> BladeSettings:
    chain = _inheritance(name, entries, file)
    material: dict[str, float] = {}
    shift: dict[str, Any] = {}
    for link in chain:
        entry = entries[link]
        given = [key for key in _SHIFT_KEYS if key in entry]
        if len(given) > 1:
            raise ConfigError(f"{file}: {link}: found {' and '.join(given)}; allowed: at most one of {', '.join(_SHIFT_KEYS)}")
        if given:
            shift = {"blade": link, "key": given[0], "value": entry[given[0]]}
        material |= entry.get("material", {})
    missing = [key for key in _MATERIAL_KEYS if key not in material]
    if missing:
        raise ConfigError(f"{file}: {name}.material: missing key {', '.join(missing)} (give it here or in the base)")
    table = entries[chain[0]]["profiles"]
    try:
        profiles = tuple(read_profile_table(root / table))
    except FileNotFoundError:
        raise ConfigError(f"{file}: {chain[0]}.profiles: there is no file {table}") from None
    except BladeShapeError as error:
        raise ConfigError(f"{table}: blade {name}: {error}") from None
    definition = BladeDefinition(name, profiles, **_shift(shift, root, file))
    return BladeSettings(definition, Material(**{_MATERIAL_KEYS[key]: float(material[key]) for key in _MATERIAL_KEYS}))


def _inheritance(name: str, entries: Mapping[str, Any], file: str) -> list[str]:
    """Names from the blade with a profile table down to `name`."""
    chain = [name]
    while "profiles" not in entries[chain[0]]:
        base = entries[chain[0]].get("base")
        if base is None:
            raise ConfigError(f"{file}: {chain[0]}: missing key profiles or base; a blade needs one of them")
        if base not in entries or base in chain:
            others = ", ".join(entry for entry in entries if entry not in chain)
            raise ConfigError(f"{file}: {chain[0]}.base: found '{base}'; allowed: another blade of this file ({others})")
        chain.insert(0, base)
    if "base" in entries[chain[0]]:
        raise ConfigError(f"{file}: {chain[0]}: found both profiles and base; allowed: one of them")
    return chain


def _shift(shift: Mapping[str, Any], root: Path, file: str) -> dict[str, Any]:
    """Arguments of BladeDefinition for a sweep given in one of the three ways."""
    if not shift:
        return {}
    blade, key, value = shift["blade"], shift["key"], shift["value"]
    if key == "chordwise_sweep_deg":
        return {"chordwise_sweep_angle": math.radians(value)}
    try:
        rows = read_stacking_table(root / value, blade) if key == "stacking_table" else stacking_rows(value)
    except FileNotFoundError:
        raise ConfigError(f"{file}: {blade}.{key}: there is no file {value}") from None
    except BladeShapeError as error:
        where = value if key == "stacking_table" else f"{file}: {blade}.{key}"
        raise ConfigError(f"{where}: blade {blade}: {error}") from None
    return {"stacking": rows}


def _scene_entries(checked: Mapping[str, Any], root: Path, schemas: Path, config_name: str) -> dict[str, Any]:
    file = checked["scenes_file"]
    entries = _validated(_load(root, file), schemas / "scenes.schema.yaml", file)
    return {name: entries[name] for name in _selected("scenes", checked, entries, file, config_name)}


def checked_scene(entry: Mapping[str, Any], schemas: Path) -> Scene:
    """The scene of one entry of scenes.yaml; ConfigError where the schema in the folder `schemas` forbids it."""
    return _contact_scene(_validated({"scene": entry}, schemas / "scenes.schema.yaml", "scenes.yaml")["scene"])


def _contact_scene(entry: Mapping[str, Any]) -> Scene:
    casing, lining, friction = entry["casing"], entry.get("lining"), entry.get("friction")
    return Scene(
        casing=Casing(
            clearance=casing["clearance_m"],
            lobes=casing["lobes"],
            width=casing["width"],
            amplitude=casing["amplitude_clearances"],
            rise_fraction=casing["rise_fraction"],
            cone_angle=None if casing["cone_angle_deg"] == "tip" else math.radians(casing["cone_angle_deg"]),
        ),
        lining=None
        if lining is None
        else Lining(
            thickness=lining["thickness_m"],
            elastic_modulus=lining["elastic_modulus_pa"],
            plastic_modulus=lining["plastic_modulus_pa"],
            yield_stress=lining["yield_stress_pa"],
            bar_width=lining["bar_width_m"],
            bars=lining["bars"],
            shared_ring=lining["rings"] == "shared",
            bar_area=lining.get("bar_area_m2"),
        ),
        friction=None
        if friction is None
        else Friction(
            coefficient=friction["coefficient"],
            vector=friction["form"] == "vector",
            against_rotation=friction["direction"] == "against_rotation",
            coupled=friction["coupling"] == "coupled",
        ),
        damping_ratio=entry["damping_ratio"],
        exact_gap=entry["gap"] == "exact",
        divergence_limit=entry["divergence_limit_m"],
    )


def _scene(name: str, entry: Mapping[str, Any], march: Mapping[str, Any], tip_line: str, file: str) -> SceneSettings:
    if "wear" in entry["results"] and "lining" not in entry:
        raise ConfigError(f"{file}: {name}.results: found wear; allowed: only in a scene with a lining")
    if entry["stress_history_speeds_rad_s"] and "stress" not in entry["results"]:
        raise ConfigError(f"{file}: {name}.stress_history_speeds_rad_s: allowed: only with stress among the results")
    return SceneSettings(
        scene=_contact_scene(entry),
        tip_line=entry.get("tip_line", tip_line),
        revolutions=entry.get("revolutions", march["revolutions"]),
        results=tuple(entry["results"]),
        stress_history_speeds=tuple(float(speed) for speed in entry["stress_history_speeds_rad_s"]),
    )


def _speeds(
    checked: Mapping[str, Any], blades: list[str], scenes: list[str], default_step: float, config_name: str
) -> dict[tuple[str, str], tuple[float, ...]]:
    def expanded(ranges: list[Any], key: str) -> tuple[float, ...]:
        try:
            return expand_speeds(ranges, default_step)
        except SpeedError as error:
            raise ConfigError(f"{config_name}: {key}: {error}") from None

    general = expanded(checked["speeds"], "speeds")
    special = [expanded(rule["speeds"], f"speeds_for.{i}.speeds") for i, rule in enumerate(checked["speeds_for"])]

    def of(blade: str, scene: str) -> tuple[float, ...]:
        for rule, speeds in zip(checked["speeds_for"], special, strict=True):
            if blade in rule.get("blades", [blade]) and scene in rule.get("scenes", [scene]):
                return speeds
        return general

    return {(blade, scene): of(blade, scene) for blade in blades for scene in scenes}


def _check_history_speeds(
    scenes: Mapping[str, SceneSettings], speeds: Mapping[tuple[str, str], tuple[float, ...]], file: str
) -> None:
    for name, chosen in scenes.items():
        run = {speed for (_, scene), several in speeds.items() if scene == name for speed in several}
        for speed in chosen.stress_history_speeds:
            if speed not in run:
                raise ConfigError(
                    f"{file}: {name}.stress_history_speeds_rad_s: found {speed:g}; allowed: speeds that are simulated "
                    "(add it to speeds or speeds_for in config.yaml)"
                )
