"""tradeoff of config.yaml: which approximations are varied, and where."""

from __future__ import annotations

from typing import Annotated, Any, Generic, Literal, TypeVar

from pydantic import Field, model_validator

from r37core.cases.plan import CasesSection
from r37core.config.fidelity import TimeStep
from r37core.config.section import ExtensionSection, LeftOut, Name, Section, Unique, left_out, refused

Value = TypeVar("Value")


class Parameter(Section, Generic[Value]):
    """Values of one parameter, and the one that the others are compared with."""

    values: Unique[Value] = Field(description="Values that are run")
    reference: Value = Field(description="Value that the others are compared with")

    @model_validator(mode="after")
    def _reference_is_a_value(self) -> Parameter[Value]:
        if self.reference not in self.values:
            raise refused(("reference",), repr(self.reference), f"one of the values, {', '.join(map(str, self.values))}")
        return self


class Parameters(Section):
    """The parameters that are varied, one at a time."""

    level: Parameter[Name] | LeftOut = left_out("Fidelity levels")
    central_difference_step: Parameter[TimeStep] | LeftOut = left_out("Step of central differences (s)")
    exact_modal_step: Parameter[TimeStep] | LeftOut = left_out("Step of exact_modal (s)")
    static_above: Parameter[Annotated[float, Field(ge=1e-3, le=1e9)]] | LeftOut = left_out(
        "Limit of omega h above which modes are static, with exact_modal"
    )
    revolutions: Parameter[Annotated[int, Field(ge=2, le=20000)]] | LeftOut = left_out("Length of a run")
    mesh_nodes: Parameter[Annotated[int, Field(ge=500, le=500_000)]] | LeftOut = left_out(
        "Nodes of the mesh, of a blade with profiles"
    )
    boundary_nodes: Parameter[Annotated[int, Field(ge=1, le=200)]] | LeftOut = left_out("Contact nodes")
    fixed_interface_modes: Parameter[Annotated[int, Field(ge=0, le=500)]] | LeftOut = left_out(
        "Fixed-interface modes at each speed of the reduced model"
    )
    highest_frequency: Parameter[Annotated[float, Field(ge=1, le=1e12)]] | LeftOut = left_out(
        "Highest frequency that is kept (Hz)"
    )
    bars: Parameter[Annotated[int, Field(ge=10, le=1_000_000)]] | LeftOut = left_out("Bars of the abradable lining")
    stress_instants: Parameter[Annotated[int, Field(ge=1, le=10000)]] | LeftOut = left_out("Stress evaluations per revolution")
    stress_region: Parameter[Literal["submesh", "whole"]] | LeftOut = left_out("Region of the recovered stress")
    friction_form: Parameter[Literal["constant", "vector"]] | LeftOut = left_out("Form of friction")

    def varied(self) -> dict[str, Parameter[Any]]:
        """The parameters that are varied, by name."""
        return {name: parameter for name, parameter in self if parameter is not None}


DEFAULTS = Parameters.model_validate(
    {
        "central_difference_step": {"values": [2.5e-8, 5.0e-8, 1.0e-7, 2.0e-7, 4.0e-7], "reference": 2.5e-8},
        "exact_modal_step": {"values": [8.0e-7, 1.6e-6, 2.4e-6, 3.2e-6, 4.8e-6, 6.4e-6, 9.6e-6], "reference": 8.0e-7},
        "static_above": {"values": [0.25, 0.5, 1.0, 1.5, 2.0], "reference": 1.0},
        "revolutions": {"values": [25, 50, 100, 200, 400, 800], "reference": 800},
        "mesh_nodes": {"values": [2500, 5000, 10000, 20000, 40000], "reference": 40000},
        "boundary_nodes": {"values": [2, 4, 8, 15], "reference": 15},
        "fixed_interface_modes": {"values": [0, 3, 10, 20, 40], "reference": 40},
        "highest_frequency": {"values": [2.0e4, 5.0e4, 1.0e5, 2.0e5, 1.0e7], "reference": 1.0e7},
        "bars": {"values": [300, 1000, 3000, 10000, 30000, 100000], "reference": 100000},
        "stress_instants": {"values": [8, 31, 62, 248], "reference": 248},
        "stress_region": {"values": ["submesh", "whole"], "reference": "whole"},
        "friction_form": {"values": ["constant", "vector"], "reference": "constant"},
    }
)
"""Parameters varied without a section of one's own, next to all fidelity levels, of which the last is the reference."""


class PlaceSection(Section):
    """Neighbouring speeds, as shares of the Campbell speed."""

    first: float = Field(ge=0.01, le=100, description="Lowest share")
    last: float = Field(ge=0.01, le=100, description="Highest share")
    speeds: int = Field(ge=1, le=1000, description="Number of speeds, evenly spaced")

    @model_validator(mode="after")
    def _forward(self) -> PlaceSection:
        if self.last < self.first or (self.last == self.first and self.speeds > 1):
            raise refused(("last",), f"{self.last:g}", f"more than first ({self.first:g})")
        return self


class Places(Section):
    """Where the errors are measured."""

    peak: PlaceSection = PlaceSection(first=1.0, last=1.02, speeds=5)
    jump: PlaceSection = PlaceSection(first=1.024, last=1.044, speeds=5)
    off_resonance: PlaceSection = PlaceSection(first=0.9, last=0.92, speeds=3)


class TradeoffSection(CasesSection):
    """Error and cost of every approximation (snakemake tradeoff)."""

    places: Places = Places()
    parameters: Parameters | LeftOut = left_out("Parameters that are varied; by default all, with values from coarse to fine")


SECTION = ExtensionSection("tradeoff", TradeoffSection, TradeoffSection())
