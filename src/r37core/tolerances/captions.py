"""What is seen in each figure of tolerances."""

CAPTIONS = {
    "tolerances": (
        "Tolerances of blade {blade} in scene {scene}: median of all members, the band that nine tenths lie in, and the "
        "nominal run (dashed). Then the share of the members above yield, with the interval of the chance. Last, by how much "
        "each number moves three measures, with intervals: rank coefficients, and where asked for Sobol's total indices. Above "
        "the bars stands the place in the ranking; pale ones have none."
    ),
}
