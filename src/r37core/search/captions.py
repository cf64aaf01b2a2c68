"""What is seen in the figures of a search."""

from __future__ import annotations

CAPTIONS = {
    "search_designs": "Designs of the search. Left: the best value of each objective over the number of designs. Right: the "
    "objectives against each other, with those that none is better than in all of them.",
    "search_slices": "Each objective along each variable through the best design. The line is the mean of the surrogate, the band "
    "two standard deviations. Points are the designs.",
}
"""Kind of figure -> what is seen in it."""
