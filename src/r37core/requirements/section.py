"""requirements of config.yaml: what a blade has to keep in operation."""

from pydantic import Field

from r37core.config.declaring import declared_by, si_form
from r37core.config.section import ExtensionSection, Section

from .choice import CampbellMargin, Requirements


@declared_by(CampbellMargin)
class CampbellMarginSection(Section):
    """A margin of crossings in the Campbell diagram."""


@declared_by(Requirements)
class RequirementsSection(Section):
    """Requirements; a run judges each blade in each scene by them."""

    campbell_margins: list[CampbellMarginSection] = Field(
        default=[], description="Margins of crossings in the Campbell diagram"
    )

    def requirements(self) -> Requirements:
        """The requirements in SI units."""
        margins = tuple(si_form(CampbellMargin, margin) for margin in self.campbell_margins)
        return si_form(Requirements, self, campbell_margins=margins)


SECTION: ExtensionSection[RequirementsSection] = ExtensionSection(
    "requirements",
    RequirementsSection,
    Field(default=RequirementsSection(), description="Requirements in operation, by which each blade and scene is judged"),
)
