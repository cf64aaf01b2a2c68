"""Checks of a search against blades, scenes and the Campbell diagram."""

from r37core.base.varied_number import SCENE, VariedNumber
from r37core.base.yaml_file import KeyPath
from r37core.blade.definition import Shape
from r37core.blade.profile import BladeShapeError
from r37core.blade.profile_tables import check_sweep, stacking_rows
from r37core.config import ConfigError, Settings, operating_range
from r37core.config.changed_numbers import ImpossibleValueError, entry_with
from r37core.config.cross_checks import engine_order_is_known, pairs_not_covered
from r37core.config.document import Document
from r37core.config.messages import did_you_mean, single_line
from r37core.config.shape_keys import SHARES, ShapeKeys
from r37core.rom.naming import mode_names
from r37studies.surrogate.gaussian_processes import SearchPackageMissing, library

from .designs import SearchDesigns, choice_of, designs_of
from .measures import FATIGUE_MEASURES, IN_OPERATION
from .section import SECTION


def search_can_be_run(settings: Settings) -> None:
    """The blade, the scenes and the variables are there, and the library is installed that proposes designs."""
    entry, document = settings.section(SECTION), settings.document
    if entry is None:
        return
    if entry.blade not in settings.blade_names:
        raise document.refusal(f"'{entry.blade}'", f"one that is run ({', '.join(settings.blade_names)})", "search", "blade")
    designs = designs_of(settings)
    if not isinstance(settings.designs.entries[entry.blade], ShapeKeys):
        raise document.refusal(f"'{entry.blade}', an imported blade", "a blade with profiles", "search", "blade")
    _scenes_are_run(settings)
    for key, bounds in entry.variables.items():
        if VariedNumber.named(key).kind == SCENE:
            _is_of_scenes(designs, document, VariedNumber.named(key))
        for value in bounds:
            _has_values(designs, document, ("search", "variables", key), {key: value})
    # keys that exclude each other do so at any value
    _has_values(designs, document, ("search", "variables"), {key: lowest for key, (lowest, _) in entry.variables.items()})
    table = settings.blades[entry.blade].definition
    for key in SHARES:
        if key in entry.variables and isinstance(table, Shape) and table.stacking is None:
            without = f"{key} of '{entry.blade}', which has no table of sweep and lean"
            raise document.refusal(without, "a blade with one, or other variables", "search", "variables", key)
    _operation_is_known(settings)
    with document.blamed(("search",), SearchPackageMissing):
        library()


def _operation_is_known(settings: Settings) -> None:
    """ConfigError for a measure in operation without an operating range, or where speeds do not reach over it."""
    choice, operating = choice_of(settings), operating_range(settings)
    named = [name for name, quantity in choice.quantities.items() if quantity.measure in IN_OPERATION]
    document = settings.document
    if not named:
        return
    if operating is None:
        raise document.refusal(f"{named[0]}, a measure in operation", "a section operating, or another measure", "search")
    for _, scene in pairs_not_covered(settings, operating)[:1]:
        reach = f"{operating.first:.6g} to {operating.last:.6g} rad/s"
        raise document.refusal(f"{reach}, which the speeds of {scene} do not reach over", "speeds that do", "operating")


def _has_values(designs: SearchDesigns, document: Document, path: KeyPath, values: dict[str, float]) -> None:
    """ConfigError, at `path`, where the entry or a scene cannot have these values of some variables."""
    for scene in designs.scenes:
        with document.blamed(path, ImpossibleValueError, before=f"scene '{scene}': "):
            entry_with(designs.settings.scene_designs.entries[scene], designs.scene_changes(scene, values))
    with document.blamed(path, ConfigError, BladeShapeError):
        design = designs.varied_entry("of the search", values)
        start = designs.blade("of the search", None).definition
        if design.sweep_lean and isinstance(start, Shape):
            check_sweep(stacking_rows([row.model_dump() for row in design.sweep_lean]), start.height)


def _is_of_scenes(designs: SearchDesigns, document: Document, number: VariedNumber) -> None:
    """ConfigError for a variable of scenes that no scene of the search has, or of which they have different values."""
    name, values = number.name, designs.values_in_scenes(number)
    path = ("search", "variables", name)
    if not values:
        keys = (key for numbers in designs.scene_numbers.values() for key in numbers)
        known = dict.fromkeys(VariedNumber(SCENE, key).name for key in keys)
        without = f"{single_line(name)}, which none of the scenes {', '.join(designs.scenes)} has"
        raise document.refusal(without, f"{', '.join(known)}{did_you_mean(name, known)}", *path)
    if len(set(values.values())) > 1:
        different = ", ".join(f"{value:g} in '{scene}'" for scene, value in values.items())
        raise document.refusal(f"{name} with {different}", "scenes of the search that start at the same value", *path)


def _scenes_are_run(settings: Settings) -> None:
    entry, document = designs_of(settings).entry, settings.document
    modes = mode_names(settings.config.campbell.modes)
    quantities = [
        ((where, name), each) for where in ("objectives", "constraints") for name, each in getattr(entry, where).items()
    ]
    for place, quantity in quantities:
        path = ("search", *place)
        needed = "fatigue" if quantity.measure in FATIGUE_MEASURES else "stress"
        for scene in quantity.scenes or ():
            if scene not in settings.scene_names:
                allowed = f"scenes that are run ({', '.join(settings.scene_names)})"
                raise document.refusal(f"'{scene}'", allowed, *path, "scenes")
            if needed not in settings.results_of(entry.blade, scene):
                allowed = f"scenes with {needed} among their results"
                raise document.refusal(f"'{scene}', without {needed}", allowed, *path, "scenes")
        if quantity.mode is not None and quantity.mode not in modes:
            allowed = f"one of the Campbell diagram, {', '.join(modes)} (campbell.modes)"
            raise document.refusal(single_line(quantity.mode), allowed, *path, "mode")
        if quantity.engine_order is not None:
            engine_order_is_known(settings, (*path, "engine_order"), quantity.engine_order)
    if not designs_of(settings).scenes:
        raise document.refusal("no scene", "an objective or constraint of contact, with scenes", "search", "objectives")
