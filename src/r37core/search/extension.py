"""A search for better designs as an extension."""

from r37core.plans.extension import Extension, Panel

from .checks import search_can_be_run
from .designs import FOLDER
from .plan import joined_dataset, remarks, samples_of, targets
from .section import SECTION

EXTENSION = Extension(
    name=FOLDER,
    section=SECTION,
    checks=(search_can_be_run,),
    later=samples_of,
    targets=targets,
    remarks=remarks,
    captions={
        "search_designs": (
            "Designs of the search; small is good. Left: the best value of each objective so far among designs that keep all "
            "constraints, over the number of designs. Dashed: the start; dotted: the end of the first, quasi-random designs. "
            "Right: the objectives against each other, or a single one over the rounds. Designs that break a constraint are "
            "pale. Of those in orange no other that keeps the constraints is better in all objectives. Bars: standard "
            "deviation by chance."
        ),
        "search_slices": (
            "Each objective along each variable. The line is the mean of the surrogate, the band two standard deviations; the "
            "other variables are those of the best design. Points are the designs, which differ in the other variables, too. "
            "Above: share of the surrogate's variance in which the variable has a part. Beside: Q2, the share of the designs' "
            "variance that the surrogate predicts at designs left out."
        ),
    },
    closing="search.dataset.closing",
    panel=Panel(joined_dataset, "search.panel.search_contents", "search/panel.js"),
)
