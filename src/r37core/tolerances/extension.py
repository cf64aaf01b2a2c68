"""Tolerances as an extension."""

from r37core.plans.extension import Extension

from .members import members_can_be_drawn
from .plan import FOLDER, SAMPLING, remarks, simulated, targets
from .section import SECTION

EXTENSION = Extension(
    name=FOLDER,
    section=SECTION,
    checks=(members_can_be_drawn,),
    sampling=SAMPLING,
    simulated=simulated,
    targets=targets,
    remarks=remarks,
    captions={
        "tolerances": (
            "Tolerances of blade {blade} in scene {scene}: median of all members, the band that nine tenths lie in, and the "
            "nominal run (dashed). Then the share of the members above yield, with the interval of the chance. Last, by how "
            "much each number moves three measures, with intervals: rank coefficients, and where asked for Sobol's total "
            "indices. Above the bars stands the place in the ranking; pale ones have none."
        ),
    },
    closing="tolerances.table.closing",
)
