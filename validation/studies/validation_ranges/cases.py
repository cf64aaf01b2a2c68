"""The study `validation_ranges`: whether the published numbers lie in the range of ours where what goes in spreads.

`snakemake validation_ranges`
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from r37core.cases.case import Case
from r37core.config import ConfigError, Settings
from r37core.config.changed_numbers import ImpossibleValueError, changed_scene, scene_numbers
from r37core.config.spread import Spread
from r37core.contact.scene import Scene
from r37core.plans import paths
from r37core.plans.member_values import drawn, is_of_sample, sobol_points
from validation.published import REFERENCE
from validation.studies.modelling_choices import cases as modelling_choices
from validation.studies.modelling_choices.cases import (
    CHOICES,
    LEVEL,
    SHIPPED,
    SURVEY,
    campbell_files,
    case_in,
    scene_name,
    windows,
)
from validation.studies.plan import scene_entry_of
from validation.studies.sections import ValidationRangesSection

NOMINAL = "nominal"
"""Name of the run without tolerances among the members, which are 0, 1, ..."""

_CHOICE = replace(CHOICES[SHIPPED], quick=True)
"""The windows of what is shipped: in narrow ones a member's peak, which moves by 2%, may lie outside."""


def cases(settings: Settings) -> dict[str, Case]:
    """A case for the nominal run and each member, blade and window of speeds, as `member/window`."""
    steps = settings.studies.modelling_choices.speed_steps_rad_s
    planned = windows(_CHOICE, steps.model_copy(update={"fine": steps.coarse}))
    scenes = {kind: _scenes(settings, kind) for kind in ("lined", "direct")}
    return {
        f"{member}/{of}": case_in(settings, replace(_CHOICE, what=f"member {member}"), window, scenes[window.kind][member])
        for member in scenes["lined"]
        for of, window in planned.items()
    }


def _scenes(settings: Settings, kind: str) -> dict[str, Scene]:
    """The `lined` or the `direct` scene without tolerances, and as each member has it."""
    entry = scene_entry_of(settings, scene_name(settings, kind))
    numbers, tolerances, scenes = scene_numbers(entry), _tolerances(settings), {NOMINAL: entry.scene()}
    nominal, section = [numbers.get(key) for key in tolerances], _section(settings)
    for member, point in sobol_points(len(tolerances), section.members, section.seed).items():
        if not is_of_sample(member):
            continue
        values = dict(zip(tolerances, drawn(tolerances.values(), nominal, point), strict=True))
        try:
            scenes[member] = changed_scene(entry, {key: value for key, value in values.items() if value is not None})
        except ImpossibleValueError as error:
            path = ("studies", "validation_ranges", "of_scenes", error.key)
            text = f"member {member}: {error}; or a narrower tolerance"
            raise settings.documents.config.error(path, text) from None
    return scenes


def _tolerances(settings: Settings) -> Mapping[str, Spread]:
    """Key of each number -> how it spreads; tolerances/members.py has seen that the scenes have them."""
    return {key: entry.spread() for key, entry in _section(settings).of_scenes.items()}


def _section(settings: Settings) -> ValidationRangesSection:
    section = settings.studies.validation_ranges
    if section is None:
        raise ConfigError(
            "config.yaml: studies.validation_ranges: missing; the study needs its tolerances, as in the shipped file"
        )
    return section


def inputs(settings: Settings) -> dict[str, Any]:
    """Shape of the reference blade, Campbell diagrams, and what modelling_choices ran of what is shipped."""
    return {
        "geometry": paths.fill(paths.GEOMETRY, blade=REFERENCE),
        "campbells": list(_campbells(settings).values()),
        "shipped": [paths.fill(paths.STUDY_CASE, study="modelling_choices", case=name) for name in _shipped(settings)],
    }


def _campbells(settings: Settings) -> dict[tuple[str, str], str]:
    """Those of the level's own mesh alone."""
    return {which: file for which, file in campbell_files(settings).items() if which[1] == LEVEL}


def _shipped(settings: Settings) -> list[str]:
    return [name for name in modelling_choices.cases(settings) if name.split("/")[0] in (SHIPPED, SURVEY)]


def values(settings: Settings) -> dict[str, Any]:
    """Which Campbell diagrams and which runs as shipped there are, and the tolerances in words."""
    words = {key: tolerance.words for key, tolerance in _tolerances(settings).items()}
    return {"campbells": list(_campbells(settings)), "shipped": _shipped(settings), "tolerances": words}
