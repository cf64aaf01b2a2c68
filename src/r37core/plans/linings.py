"""Stiffness of the linings of a run at the tips, before it starts."""

from contextlib import suppress
from pathlib import Path

from r37core.base.io import InputFileError
from r37core.config import Settings
from r37core.contact.laws import lines_of_bar
from r37core.results.closing import lining_texts
from r37core.rom.contact_model import read_contact_model
from r37core.time_integration.lining_at_tip import lining_at_tip

from . import paths


def linings_at_tip(settings: Settings) -> list[str]:
    """Lines on the linings to run: at the tips of the blades whose models are there, else of a length of tip."""
    lines = []
    for scene, lining in settings.linings.items():
        chosen = settings.scenes[scene]
        pattern = paths.CONTACT_MODEL.replace("<results>", str(settings.root / settings.results))
        files = {name: Path(paths.fill(pattern, blade=name, tip_line=chosen.tip_line)) for name in settings.blade_names}
        there = {}
        for blade, file in files.items():
            # one that cannot be read is made again by the run
            with suppress(InputFileError):
                there[blade] = read_contact_model(file)
        if there:
            texts = lining_texts({(blade, scene): lining_at_tip(model, chosen.scene) for blade, model in there.items()})
            lines += [f"{text} (as the models in {settings.results} have it)" for text in texts]
        elif not lining.published:
            elastic, _, plastic = lines_of_bar(lining.elastic_modulus, 1e-3 * lining.contact_length, lining)
            lines.append(
                f"{scene}: stiffness of the lining {elastic:.3g} N/m for each mm of tip, {plastic:.3g} while it wears; the "
                "run ends with that of the whole tip, and the blade's own"
            )
    return lines
