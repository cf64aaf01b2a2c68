"""Second motions as an extension."""

from r37core.plans.extension import Extension, Panel

from .checks import can_be_swept
from .plan import dataset, simulated, targets
from .section import SECTION

EXTENSION = Extension(
    name="second_motions",
    section=SECTION,
    checks=(can_be_swept,),
    simulated=simulated,
    targets=targets,
    motions=dataset,
    captions={
        "second_motions": (
            "Blade {blade} in scene {scene}, carried up and down the speeds, and from rest. Motion of the leading edge, "
            "normal and tangential together, with its scatter over the revolutions. Shaded: the motions differ by more "
            "than they scatter. Then the median stress, the largest motion's share of a long time, and Lyapunov exponents."
        ),
        "second_motions_of_all": (
            "All blades in scene {scene}, carried up and down through the speeds, and from rest. Shaded: the motions differ by "
            "more than they scatter."
        ),
    },
    closing="second_motions.tables.closing",
    look_at="<results>/second_motions.csv",
    panel=Panel(dataset, "second_motions.panel.contents", "second_motions/panel.js"),
)
