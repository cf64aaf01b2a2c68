"""What is seen in the figures of a search."""

from __future__ import annotations

CAPTIONS = {
    "search_designs": (
        "Designs of the search; small is good. Left: the best value of each objective so far among designs that keep all "
        "constraints, over the number of designs. Dashed: the start; dotted: the end of the first, quasi-random designs. "
        "Right: the objectives against each other, or a single one over the rounds. Designs that break a constraint are pale. "
        "Of those in orange no other that keeps the constraints is better in all objectives. "
        "Bars: standard deviation by chance."
    ),
    "search_slices": (
        "Each objective along each variable. The line is the mean of the surrogate, the band two standard deviations; the "
        "other variables are those of the best design. Points are the designs, which differ in the other variables, too. "
        "Above: share of the surrogate's variance in which the variable has a part. Beside: Q2, the share of the designs' "
        "variance that the surrogate predicts at designs left out."
    ),
}
"""Kind of figure -> what is seen in it."""
