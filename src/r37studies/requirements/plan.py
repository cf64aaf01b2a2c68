"""requirements of config.yaml, and their plan: what is judged, by what, and where it lies."""

from dataclasses import dataclass, replace
from functools import cached_property
from math import nan
from typing import Any

from r37core.base.plain import to_plain
from r37core.config import Settings, level_errors, operating_range
from r37core.config.cross_checks import engine_order_is_known, pairs_not_covered
from r37core.config.declaring import declared_by, si_form
from r37core.config.section import ExtensionSection, Section, option
from r37core.config.settings import contact_nodes, length_of_run
from r37core.contact.casing import least_change
from r37core.plans import paths
from r37core.plans.extension import Extension, Panel
from r37core.plans.extent import Pair, Runs
from r37core.plans.stages import Stage
from r37core.plans.sweep_plan import Sweep
from r37core.results.datasets import FURTHER_RUNS
from r37core.results.spectral_lines import modes_of
from r37core.rom.naming import mode_names
from r37core.rom.reduction_choice import POINTS
from r37studies.other_models import MODEL_FILES, ModelChoice, tip_elements

from .choice import LONGEST, RESULTS, RUN_UPS, STEP, CampbellMargin, Requirements, most_further_runs, run_up_lengths


@declared_by(CampbellMargin)
class CampbellMarginSection(Section):
    """A margin of crossings in the Campbell diagram."""


@declared_by(Requirements)
class RequirementsSection(Section):
    """Requirements; a run judges each blade in each scene by them."""

    campbell_margins: list[CampbellMarginSection] = option("Margins of crossings in the Campbell diagram", [])

    def requirements(self) -> Requirements:
        """The requirements in SI units."""
        margins = tuple(si_form(CampbellMargin, margin) for margin in self.campbell_margins)
        return si_form(Requirements, self, campbell_margins=margins)


SECTION = ExtensionSection(
    "requirements",
    RequirementsSection,
    option("Requirements in operation, by which each blade and scene is judged", RequirementsSection()),
)

VERDICT, LOOKS = "<results>/verdict.csv", "<results>/{blade}/{scene}/looks.nc"
ALL_LOOKS = f"<results>/{FURTHER_RUNS}.nc"

MOST_SECONDS = 600.0
"""CPU time (s) that the runs from rest of a verdict may take, where they are as long as they may be."""


@dataclass(frozen=True)
class Judged:
    """Plan of what is judged in a run."""

    sweep: Sweep

    @property
    def requirements(self) -> dict[str, Any]:
        """The requirements, as plain values."""
        return to_plain(self.sweep.settings.section(SECTION).requirements())

    @cached_property
    def not_looked(self) -> dict[str, str]:
        """Reason why no further runs of a scene are done, where that is so."""
        settings = self.sweep.settings
        reasons, changing = {}, "no further runs of a clearance that changes within a run"
        for name, chosen in settings.scenes.items():
            if chosen.scene.casing.change or chosen.scene.rotor:
                reasons[name] = changing if chosen.scene.casing.change else "no further runs of a rotor"
        operating = operating_range(settings)
        if operating is None:
            return reasons
        for name in settings.scenes.keys() - reasons.keys():
            run = length_of_run(settings, name, operating.last, LONGEST)
            if run.cpu_time * (operating.last - operating.first) / STEP > MOST_SECONDS:
                reasons[name] = f"no further runs, which take too long with steps of {run.time_step:g} s"
        return reasons

    @cached_property
    def looked(self) -> list[tuple[str, str]]:
        """Pairs of blade and scene of which further runs may be needed: their runs are judged, and cover the range."""
        settings = self.sweep.settings
        operating, requirements = operating_range(settings), settings.section(SECTION).requirements()
        if operating is None or not requirements.run_requirements.any:
            return []
        short = pairs_not_covered(settings, operating)
        pairs = self.sweep.runs_with("rms")
        return [pair for pair in pairs if pair not in short and pair[1] not in self.not_looked]

    def coarser_model(self, wildcards: Any) -> dict[str, str]:
        """Files of the model of a blade and scene on a mesh of half the nodes, which `snakemake tradeoff` may have made.

        None of a mesh that another program made, nor of a scene with a tip line of its own.
        """
        settings, blade = self.sweep.settings, wildcards.blade
        own_line = settings.scenes[wildcards.scene].tip_line == settings.structure.boundary.tip_line
        if not settings.blades[blade].has_profiles or not own_line:
            return {}
        mesh, modes = settings.fidelity.mesh, settings.fidelity.reduction.fixed_interface_modes
        nodes = mesh.nodes // 2
        contact = min(contact_nodes(settings, blade, count) for count in (mesh.tip_elements, tip_elements(nodes)))
        model = ModelChoice(nodes, contact, modes)
        return {f"coarser_{kind}": MODEL_FILES[kind].format(blade=blade, model=model.name) for kind in ("contact", "rom")}

    def looks(self) -> Stage:
        """The stage of the further runs of a blade and scene."""
        settings = self.sweep.settings
        operating = operating_range(settings)
        params = {
            "scene": self.sweep.plain_scene,
            # of a run from rest: those of the pipeline
            "choice": lambda wildcards: to_plain(settings.integration_choice(wildcards.blade, wildcards.scene)),
            "results": lambda wildcards: [each for each in self.sweep.results(wildcards) if each in RESULTS],
            "kept": settings.fidelity.time_integration.kept,
            "material": lambda wildcards: to_plain(settings.blades[wildcards.blade].material),
            "yield_stress": self.sweep.yield_stress,
            "strengths": self.sweep.strengths,
            # nothing else moves a run
            "requirements": to_plain(settings.section(SECTION).requirements().run_requirements),
            "operating": to_plain(operating and replace(operating, dwell=())),
            "known": lambda wildcards: self.known_of(wildcards.blade, wildcards.scene),
            "provenance": self.sweep.provenance,
        }
        return Stage("r37studies.requirements.steps.look", params)

    @property
    def volumes(self) -> list[str]:
        """Files that say the volume of each blade in `densities`: its geometry, or the mesh of another program."""
        blades = self.sweep.settings.blades
        patterns = {name: paths.GEOMETRY if blades[name].has_profiles else paths.MESH for name in self.densities}
        return [pattern.format(blade=name) for name, pattern in patterns.items()]

    @property
    def densities(self) -> dict[str, float]:
        """Density (kg/m3) of each blade whose volume is known: of all but those given by matrices."""
        blades = self.sweep.settings.blades.items()
        return {name: blade.material.density for name, blade in blades if blade.material is not None and not blade.is_matrices}

    def known_of(self, blade: str, scene: str) -> dict[str, Any]:
        """Fields of the Evidence on a blade in a scene that follow from the configuration, as plain values."""
        settings = self.sweep.settings
        casing, lining = settings.scenes[scene].scene.casing, settings.scenes[scene].scene.lining
        return {
            "clearance": nan if casing.changes_with_speed else casing.clearance + least_change(casing),
            "thickness": lining.thickness if lining else nan,
            "error": level_errors(settings, [(blade, scene)])[0],
            "point_contact": settings.contact_of(blade) == POINTS,
            "not_looked": self.not_looked.get(scene, ""),
        }


def targets(sweep: Sweep) -> dict[str, paths.Wildcards]:
    """The verdict and its further runs, where there are requirements."""
    judged: paths.Wildcards = [{}] if sweep.settings.section(SECTION).requirements().any else []
    looked: paths.Wildcards = [{}] if Judged(sweep).looked else []
    return {VERDICT: judged, ALL_LOOKS: looked}


def can_be_judged(settings: Settings) -> None:
    """Requirements have an operating range, and their crossings are in the Campbell diagram."""
    requirements, document = settings.section(SECTION).requirements(), settings.document
    if not requirements.any:
        return
    operating = operating_range(settings)
    if operating is None:
        raise document.refusal("requirements without operating", "operating: with idle and redline beside them", "requirements")
    for rate, length in run_up_lengths(operating).items():
        if not RUN_UPS[0] / 10 <= length <= 10 * RUN_UPS[-1]:
            long = f"a rate of {rate:g} rad/s2, over {length:.3g} revolutions"
            allowed = f"rates over {RUN_UPS[0] // 10} to {10 * RUN_UPS[-1]} revolutions of the judged range"
            raise document.refusal(long, allowed, "operating")
    modes = mode_names(settings.config.campbell.modes)
    asked: set[tuple[str, int]] = set()
    for number, margin in enumerate(requirements.campbell_margins):
        place = ("requirements", "campbell_margins", number)
        parts = modes_of(margin.mode)
        if not set(parts) <= set(modes) or len(parts) > len(set(parts)) or len(parts) > 2:
            raise document.refusal(f"'{margin.mode}'", f"{', '.join(modes)}, or two of them as 7-5 or 5+7", *place, "mode")
        if not margin.engine_orders:
            raise document.refusal("none", "one or more engine orders", *place, "engine_orders")
        engine_order_is_known(settings, (*place, "engine_orders"), max(margin.engine_orders))
        for order in margin.engine_orders:
            if (margin.mode, order) in asked:
                raise document.refusal(f"{order} of {margin.mode} twice", "each once", *place, "engine_orders")
            asked.add((margin.mode, order))
        # a crossing above the diagram is not known, and may be too near
        needed = max([dwell.stop for dwell in operating.dwell] or [operating.last]) / (1.0 - min(margin.least, 0.99))
        if settings.structure.maximum_speed_rad_s < needed:
            reach = f"{100.0 * margin.least:g}, for which crossings up to {needed:.6g} rad/s count"
            allowed = (
                f"a margin within structure.maximum_speed_rad_s ({settings.structure.maximum_speed_rad_s:g}), or that larger"
            )
            raise document.refusal(reach, allowed, *place, "at_least_percent")


_LOOKED = 0.7
"""Share of the most further runs that are run as a rule."""


def further_runs(settings: Settings) -> dict[Pair, Runs]:
    """Further runs that a verdict may need, by blade and scene: none where a requirement fails clearly or nothing touches."""
    runs: dict[Pair, Runs] = {}
    if (operating := operating_range(settings)) is None:
        return runs
    for pair in Judged(Sweep(settings)).looked:
        number, lengths = _LOOKED * most_further_runs(operating), run_up_lengths(operating).values()
        revolutions = settings.scenes[pair[1]].revolutions
        # each begins with the revolutions of a run
        run_ups = 2.0 * sum(1.0 + length / revolutions for length in lengths)
        runs[pair] = Runs(number + 2 * len(lengths), 0, number + run_ups)
    return runs


def remarks(settings: Settings) -> list[str]:
    """Which blades and scenes are not run over the whole operating range, and what no run can tell."""
    operating, lines = operating_range(settings), []
    if operating is None:
        return []
    if short := pairs_not_covered(settings, operating):
        named = ", ".join(f"{blade} in {scene}" for blade, scene in short[:3]) + (", ..." if len(short) > 3 else "")
        reach = f"{operating.first:.6g} to {operating.last:.6g} rad/s"
        lines.append(f"operating: the speeds of {named} do not reach over {reach}; what is judged there is not known")
    lines += _not_told(settings)
    return lines


def _not_told(settings: Settings) -> list[str]:
    """Requirements that no run of some blades and scenes can tell, for want of a result or of strengths."""
    requirements, sweep, lines = settings.section(SECTION).requirements(), Sweep(settings), []
    pairs = sweep.runs_with("rms")
    lined = [pair for pair in pairs if settings.scenes[pair[1]].scene.lined]
    weak = [name for name in settings.blades if not settings.blades[name].strengths.are_known]
    for name, result, asked in (
        ("above_yield", "stress", pairs),
        ("goodman_share", "fatigue", pairs),
        ("used_lining", "wear", lined),
    ):
        if getattr(requirements, name) is None:
            continue
        scenes = dict.fromkeys(scene for blade, scene in asked if (blade, scene) not in sweep.runs_with(result))
        if scenes:
            lines.append(f"requirements: {name} cannot be told without {result} among the results of {', '.join(scenes)}")
        if result == "fatigue" and weak:
            strengths = "material.fatigue_strength_pa and ultimate_strength_pa"
            lines.append(f"requirements: {name} cannot be told of {', '.join(weak)} without {strengths}")
    lacking = [name for name in settings.blades if not settings.blades[name].strengths.have_line]
    if requirements.miner_sum is not None and lacking:
        lines.append(f"requirements: miner_sum cannot be told of {', '.join(lacking)} without material.fatigue_exponent")
    return lines


EXTENSION = Extension(
    name="requirements",
    section=SECTION,
    checks=(can_be_judged,),
    runs=further_runs,
    targets=targets,
    offers={"verdict": VERDICT, FURTHER_RUNS: ALL_LOOKS},
    remarks=remarks,
    closing="r37studies.requirements.table.closing",
    panel=Panel(VERDICT, "r37studies.requirements.table.contents", "r37studies/requirements/panel.js"),
)
