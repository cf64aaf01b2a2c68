"""fidelity.yaml: accuracy levels."""

import math
from typing import Annotated, Any

from pydantic import Field, RootModel

from r37core.contact.scene import Scene
from r37core.rom.reduction_choice import ReductionChoice
from r37core.time_integration.integration_choice import IntegrationChoice

from .declaring import declared_by, section_of, si_form
from .section import ByName, LeftOut, Section, Speed, left_out, option, refused

_LARGEST_SIGNAL = 2**31
"""Bytes of tip motion that one run may keep in memory."""


class Mesh(Section):
    """Size and quality of the mesh."""

    nodes: int = option("Target number of nodes", ge=500, le=500_000)
    layers: int = option("Wedges through the thickness", 1, ge=1, le=8)
    tip_elements: int = option("Wedges along the tip", ge=2, le=500)
    minimum_scaled_jacobian: float = option("Smallest scaled Jacobian of an accepted mesh", 0.1, ge=1e-6, le=1)


Reduction: Any = section_of(ReductionChoice, "Size of the reduced model.", only=("fixed_interface_modes", "basis_tolerance"))


Error = Annotated[float, Field(ge=0, le=1e6)]
"""A relative error."""


class Measured(Section):
    """Error on the worst measured blade (docs/accuracy.md), for verdicts and rankings."""

    error: Error | LeftOut = left_out("Mean relative error of rms, except with bare casing on points")
    error_on_points: Error | LeftOut = left_out("Mean relative error of rms with bare casing on points")
    error_of_blades: dict[str, Error] = option("Error of some blades by name, in place of the others", {})

    def error_of(self, point_contact: bool, blade: str = "") -> float:
        """The error of runs with direct contact on points, or of others, or of a blade; NaN where that was not measured."""
        error = self.error_on_points if point_contact and self.error_on_points is not None else self.error
        return self.error_of_blades.get(blade, math.nan if error is None else error)


TimeStep = Annotated[float, Field(ge=1e-12, le=1e-2)]


class Steps(Section):
    """Largest steps of the scenes with an abradable lining and of those with bare casing."""

    lined: TimeStep = option("Step with an abradable lining")
    direct: TimeStep = option("Step with bare casing")


@declared_by(IntegrationChoice)
class TimeIntegration(Section):
    """Time integration and kept results."""

    one_of = (("time_step_s", "largest_time_step_s"),)

    time_step_s: TimeStep | LeftOut = left_out("Largest step, shortened to divide a revolution; an unstable one is refused")
    largest_time_step_s: Steps | LeftOut = left_out(
        "Largest steps by kind of scene, in place of time_step_s; an unstable one is shortened"
    )
    speed_step_rad_s: Speed = option("Step of speed ranges without one")
    stress_instants: int = option("Stress evaluations per revolution", 62, ge=1, le=10000)
    samples_per_stress_instant: int = option("Samples of the tip motion per stress evaluation", 8, ge=1, le=10000)
    spectrum_highest_order: int = option("Highest engine order of the kept spectrum", 30, ge=1, le=10000)
    wear_angles: int = option("Angles of the kept wear profile", 1000, ge=8, le=1_000_000)

    def _check(self) -> None:
        size = 32 * self.revolutions * self.samples_per_revolution
        if size > _LARGEST_SIGNAL:
            value = f"{self.revolutions} of {self.samples_per_revolution} samples, {size / 2**30:.1f} GiB"
            samples = "stress_instants times samples_per_stress_instant are the samples"
            raise refused(value, f"at most {_LARGEST_SIGNAL / 2**30:g} GiB ({samples})", "revolutions")

    @property
    def samples_per_revolution(self) -> int:
        """Samples of the tip motion per revolution."""
        return self.stress_instants * self.samples_per_stress_instant

    def largest_step(self, scene: Scene | None) -> float:
        """Largest step (s) in a scene; None: as on a bare casing."""
        steps = self.largest_time_step_s
        if steps is not None:
            return steps.lined if scene and scene.lined else steps.direct
        assert self.time_step_s is not None
        return self.time_step_s

    @property
    def kept(self) -> dict[str, int]:
        """How much of the spectrum and of the wear a simulation keeps."""
        return {"spectrum_highest_order": self.spectrum_highest_order, "wear_angles": self.wear_angles}

    @property
    def wording(self) -> str:
        """The largest steps."""
        steps = self.largest_time_step_s
        return f"{self.time_step_s:g} s" if steps is None else f"{steps.lined:g} s with lining, {steps.direct:g} s without"

    def choice(self, scene: Scene | None) -> IntegrationChoice:
        """Time integration in a scene (see largest_step), with stress of the last revolution and energy balance."""
        step = {"time_step": self.largest_step(scene), "shorten": self.time_step_s is None}
        snapshots = {"snapshots_per_revolution": self.stress_instants, "snapshot_revolutions": 1}
        return si_form(IntegrationChoice, self, **step, **snapshots, samples_per_revolution=self.samples_per_revolution)


class Level(Section):
    """One accuracy level."""

    mesh: Mesh
    reduction: Reduction
    measured: Measured | LeftOut = None
    time_integration: TimeIntegration


class Levels(RootModel[ByName[Level]]):
    """fidelity.yaml, accuracy levels by name."""
