"""The plan of the trials: three presets as extensions, and the files and parameters of their rules."""

from dataclasses import dataclass, replace
from typing import Any

from r37core.base.plain import to_plain
from r37core.config import Settings, plain
from r37core.plans import paths
from r37studies.other_models import MODEL_FILES, OWN_MESH, ModelChoice, tip_elements

from . import estimate, stability, tradeoff
from .case import Case

PRESETS = {each.EXTENSION.name: each for each in (estimate, tradeoff, stability)}
"""Command -> its module, in the order of their sections in docs/configuration.md.

It has `cases`, a function of the settings that gives each case by its name, or the reason why this run cannot have it; and
`TABLE`, a function that makes the table of the responses and of `values`, a function of the settings and of the simulations
of a whole run.
"""

EXTENSIONS = tuple(preset.EXTENSION for preset in PRESETS.values())

RESPONSE = "<results>/{preset}/{case}.nc"
TABLE = "<results>/{preset}.csv"


@dataclass(frozen=True)
class Trials:
    """Inputs and parameters of the rules for cases, models of cases, and the tables of each preset."""

    settings: Settings

    def cases(self, preset: str) -> dict[str, Case | str]:
        """Cases of a preset by name, or reasons why this run cannot have them."""
        return self.settings.made(PRESETS[preset].cases)

    def files(self, wildcards: Any) -> list[str]:
        """Responses of all cases of a preset that are run."""
        reasons = self.reasons(wildcards)
        return [RESPONSE.format(preset=wildcards.preset, case=name) for name, why in reasons.items() if not why]

    def reasons(self, wildcards: Any) -> dict[str, str]:
        """Case -> reason why this run cannot have it; empty for one that is run."""
        return {name: case if isinstance(case, str) else "" for name, case in self.cases(wildcards.preset).items()}

    def case(self, wildcards: Any) -> Case:
        """The case of these wildcards."""
        case = self.cases(wildcards.preset)[wildcards.case]
        assert isinstance(case, Case)
        return case

    def inputs(self, wildcards: Any) -> dict[str, str]:
        """Files that a case is run from."""
        case = self.case(wildcards)
        if isinstance(case.model, str):
            patterns = {"rom": paths.REDUCED_MODEL, "contact": paths.CONTACT_MODEL}
            where = {"blade": case.blade, "tip_line": case.model}
        else:
            patterns, where = dict(MODEL_FILES), {"blade": case.blade, "model": case.model.name}
        if "stress" not in case.results:
            del patterns["rom"]
        more = {"campbell": paths.CAMPBELL} if case.crossing else {}
        return {kind: pattern.format(**where) for kind, pattern in (patterns | more).items()}

    def shape(self, wildcards: Any) -> dict[str, str]:
        """Files of a model's shape: the mesh of the run, or the geometry that is meshed with so many nodes."""
        own = ModelChoice.named(wildcards.model).nodes == OWN_MESH
        return {"mesh" if own else "geometry": (paths.MESH if own else paths.GEOMETRY).format(blade=wildcards.blade)}

    def reduction(self, wildcards: Any) -> dict[str, Any]:
        """Parameters of a model that are others than those of the run."""
        choice, settings, blade = ModelChoice.named(wildcards.model), self.settings, wildcards.blade
        boundary = settings.boundary_choice(blade)
        parts = {
            "mesh": {
                **plain(settings.fidelity.mesh),
                "nodes": choice.nodes,
                "layers": 1,
                "tip_elements": tip_elements(choice.nodes),
            },
            "boundary": replace(boundary, nodes=choice.boundary_nodes or None),
            "reduction": replace(settings.reduction_choice(blade), fixed_interface_modes=choice.fixed_interface_modes),
            "stress_regions": settings.stress_regions(blade),
            "tip_line": boundary.tip_line,
        }
        return to_plain(parts)
