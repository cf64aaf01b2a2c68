"""What the section of the study alone cannot check."""

from __future__ import annotations

from functools import partial

from r37core.config import Settings
from r37core.config.changed_numbers import ImpossibleValueError, changed_scene, scene_numbers
from r37core.config.messages import on_one_line


def members_of_the_study_are_possible(settings: Settings) -> None:
    """The study of the published numbers, where this run has its two scenes, names numbers that these can have."""
    study, choices = settings.studies.validation_ranges, settings.studies.modelling_choices
    names = (choices.lined_scene, choices.direct_scene)
    if study is None or not settings.scene_entries.keys() >= set(names):
        return
    entries = [settings.scene_entries[name] for name in names]
    if entries[0].lining is None:
        # refused where the scene is named
        return
    known = {key: value for entry in entries for key, value in scene_numbers(entry).items()}
    path = ("studies", "validation_ranges", "of_scenes")
    for key, entry in study.of_scenes.items():
        refusal, spread = partial(settings.documents.config.refusal, (*path, key)), entry.spread()
        if key not in known:
            raise refusal(on_one_line(key), f"one of {', '.join(known)}")
        if spread.percent and known[key] == 0.0:
            raise refusal(f"percent of {key}, which is 0", "uniform, normal, between or values")
        for scene in (scene for scene in entries if key in scene_numbers(scene)):
            for end in spread.ends(known[key]):
                try:
                    changed_scene(scene, {key: end})
                except ImpossibleValueError as error:
                    text = f"the end of its range: {error}; or a narrower tolerance"
                    raise settings.documents.config.error((*path, key), text) from None
