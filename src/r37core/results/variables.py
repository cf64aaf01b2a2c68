"""Variables of the sweep's datasets: name, dimensions beyond blade, scene and speed, units, meaning.

Later revolutions are those of the last half of a run, or the last 100 of one that goes on until it settles.
"""

from r37core.base.dataset_file import SPEED, Variable
from r37core.stress.statistic import HIGH
from r37core.time_integration import speed_arrays as of_run

from .events import OF_EXIT, OF_GOODMAN, OF_YIELD

_REGION = ("region",)
_OF_REVOLUTIONS = "largest von Mises stress of each of the later revolutions"

_MOTION = of_run.SIZES | OF_EXIT | of_run.MOTION

_STRESS = {
    **of_run.LAST_STRESS,
    "max_von_mises_ever": Variable(_REGION, "Pa", "largest von Mises stress in the region in any revolution"),
    **OF_YIELD,
    "stress_drift": Variable(_REGION, "1", "share by which the stress still drifts as the longest run ends"),
    "max_von_mises_median": Variable(_REGION, "Pa", f"{_OF_REVOLUTIONS}: median"),
    "max_von_mises_high": Variable(_REGION, "Pa", f"{_OF_REVOLUTIONS}: {HIGH:.0%} of them have no larger one"),
    **of_run.PLACE_OF_STRESS,
    "share_of_revolutions_above_yield": Variable(
        _REGION, "1", "share of the later revolutions whose largest stress exceeds yield"
    ),
}

_GOODMAN = {
    "goodman_share": Variable(_REGION, "1", "share of the Goodman line: largest of all nodes and revolutions"),
    **OF_GOODMAN,
    "goodman_share_median": Variable(_REGION, "1", "median of the largest share of the Goodman line in each later revolution"),
    "share_of_revolutions_above_goodman": Variable(
        _REGION, "1", "share of the later revolutions with a node above the Goodman line"
    ),
    "goodman_alternating_stress": Variable(_REGION, "Pa", "alternating stress where the share of the Goodman line is largest"),
    "goodman_mean_stress": Variable(_REGION, "Pa", "mean stress there, 0 in compression"),
}

VARIABLES = {
    **(of_run.STATUS | _MOTION | of_run.OF_KIND | of_run.SPECTRUM | _STRESS | _GOODMAN),
    **(of_run.OF_NODES | of_run.WEAR | of_run.WAVES),
}
"""Variables over the speeds of a response."""

OF_STRESS = {"yield_stress": Variable((), "Pa", "yield stress of the blade's material"), **of_run.OF_STRESS}

OF_FATIGUE = {
    "fatigue_strength": Variable((), "Pa", "stress amplitude that the blade's material endures at zero mean"),
    "ultimate_strength": Variable((), "Pa", "tensile strength of the blade's material"),
}

OF_ALL_SPEEDS = {**of_run.OF_SCENE, **of_run.OF_LINING, **of_run.OF_CASING, **OF_STRESS, **OF_FATIGUE}
"""Variables of a response that are the same at every speed."""

HISTORIES = {
    "max_von_mises_history": Variable(
        ("history_speed", "region", "revolution"), "Pa", "largest von Mises stress of each revolution", "f4"
    )
}
"""Variables of the speeds with a stress history."""

AXES = {
    "speed": SPEED,
    "revolution": Variable(("revolution",), "1", "number of the revolution"),
    "engine_order": of_run.AXES["engine_order"],
    "angle": Variable(("angle",), "rad", "start of the sector round the casing"),
    "lobes": Variable(("lobes",), "1", "number of lobes"),
    "contact_node": Variable(("contact_node",), "1", "number of the contact node, from the leading edge on"),
    "stress_node": Variable(("stress_node",), "1", "number of the node in the region that a map shows"),
    "casing_mode": Variable(("casing_mode",), "1", "number of the casing's mode"),
    "casing_order": of_run.AXES["casing_order"],
    "history_speed": Variable(("history_speed",), "rad s-1", "speed with a stress history"),
}
"""Numeric axes, of which a dataset has what its responses have together."""

COUNTED = ("revolution", "contact_node", "stress_node", "casing_mode")
"""Axes that count from 1 on."""

DATASETS = {
    "rms": ("lined", "casing_lobes", *of_run.OF_LINING, "casing_cone_angle", *_MOTION, *of_run.OF_KIND),
    "spectrum": tuple(of_run.SPECTRUM),
    "stress": ("lined", *_STRESS, *OF_STRESS, *HISTORIES),
    "fatigue": ("lined", *_GOODMAN, *OF_FATIGUE),
    "wear": tuple(of_run.WEAR),
    "casing": (*of_run.OF_CASING, *of_run.WAVES),
}
"""Dataset -> its variables, where a response has them; each also carries those of FLAGS. Nodes differ from blade to blade: what
they have stays in the response."""

FLAGS = tuple(of_run.STATUS)
