"""Variables of the sweep's datasets: name, dimensions beyond blade, scene and speed, units, meaning.

Later revolutions are those of the last half of a run, or the last 100 of one that goes on until it settles.
"""

from r37core.base.dataset_file import SPEED, Variable
from r37core.stress.statistic import HIGH
from r37core.time_integration.settling import MotionAtEnd
from r37core.time_integration.status import MotionKind, RunStatus

_TIP = ("tip_point",)
_REGION = ("region",)
_OF_REVOLUTIONS = "largest von Mises stress of each of the later revolutions"

PLACES = {
    "chord": "0 at the leading, 1 at the trailing edge",
    "span": "0 at the root, 1 at the tip",
    "side": "-1 on the pressure, 1 on the suction side",
}
"""Numbers of a place on the blade, as BladeMesh has them."""

STATUS = {
    "status": Variable((), "1", "how the run ended", "i1", RunStatus),
    "diverged_revolution": Variable((), "1", "revolution at which the run diverged"),
}

_MOTION = {
    **{
        f"{kind}_{direction}": Variable(_TIP, "m", f"{measure} {direction} displacement over the later revolutions{note}")
        for kind, measure in (("rms", "rms of the"), ("peak", "largest"))
        for direction, note in (("normal", " (along the casing's normal)"), ("radial", ""), ("tangential", ""))
    },
    "peak_share_of_height": Variable((), "1", "largest displacement over the blade's height"),
    "share_of_height_limit": Variable((), "1", "share of the height beyond which second order leaves full finite elements"),
    "beyond_limits": Variable((), "1", "1 where the run is beyond the model's limits", "f4"),
    "bounded_share_of_time": Variable((), "1", "share of the steps in which the bound on the elastic energy acts"),
    "energy_residual_share": Variable((), "1", "size of the energy residual over the largest of work, loss and energy change"),
    "friction_power": Variable((), "W", "mean power of the friction over the later revolutions, of a rotor over all"),
    "melting_power": Variable((), "W", "power of the friction of which a tenth melts the tip in a second"),
    "motion_at_end": Variable((), "1", "state of the motion at the end of the run", "i1", MotionAtEnd),
    "settled_revolution": Variable((), "1", "revolution after which the run ended as it had settled, NaN where it did not"),
    "time_step": Variable((), "s", "step of the time integration that was taken"),
    "clearance": Variable(("contact_node",), "m", "clearance of the round casing at the contact nodes, leading edge first"),
    "share_of_time_in_contact": Variable((), "1", "share of the steps with a contact force"),
    "largest_normal_force": Variable((), "N", "largest normal force on a tip node"),
    "largest_penetration": Variable((), "m", "largest penetration of the tip's edge into the casing"),
    "casing_hits": Variable((), "1", "how often a tip node came upon the casing"),
    "worst_complementarity": Variable((), "1", "largest relative violation of the contact conditions"),
    "contact_work": Variable((), "J", "work of the contact forces on the blade"),
    "damping_loss": Variable((), "J", "energy lost to damping"),
    "energy_change": Variable((), "J", "energy of the vibration at the end, less that at the start"),
    "energy_residual": Variable((), "J", "energy change minus contact work plus damping loss"),
    "revolution_maximum": Variable(("revolution", "tip_point"), "m", "largest normal displacement of each revolution", "f4"),
}

OF_KIND = {
    "motion_kind": Variable((), "1", "kind of the motion that goes on after the run", "i1", MotionKind),
    "lyapunov_exponent": Variable((), "1", "largest Lyapunov exponent per revolution of the motion after the run"),
    "lyapunov_exponent_error": Variable((), "1", "standard error of the Lyapunov exponent"),
    "recurrence": Variable((), "1", "distance of the state from that a period before, as a share of its size"),
    "recurrence_period": Variable((), "1", "period of the motion in revolutions, after which it comes nearest to itself"),
}
"""Variables of KindNumbers."""

_GIVEN_MOTION = {
    "initial_energy": Variable((), "J", "energy of the vibration at the start"),
    "initial_energy_left_out": Variable((), "1", "share of the given motion's energy that lies in modes which are not stepped"),
}

_SPECTRUM = {
    "amplitude": Variable(("engine_order",), "m", "amplitude of the leading edge's normal displacement", "f4"),
    "amplitude_tangential": Variable(("engine_order",), "m", "amplitude of the leading edge's tangential displacement", "f4"),
}

_STRESS = {
    "max_von_mises_last_revolution": Variable(_REGION, "Pa", "largest von Mises stress in the region in the last revolution"),
    "max_von_mises_ever": Variable(_REGION, "Pa", f"{_OF_REVOLUTIONS}: largest"),
    "stress_drift": Variable(_REGION, "1", "share by which the stress still drifts as the longest run ends"),
    "max_von_mises_of_run": Variable(_REGION, "Pa", "largest von Mises stress in the region in any revolution"),
    "max_von_mises_median": Variable(_REGION, "Pa", f"{_OF_REVOLUTIONS}: median"),
    "max_von_mises_high": Variable(_REGION, "Pa", f"{_OF_REVOLUTIONS}: {HIGH:.0%} of them have no larger one"),
    **{
        f"max_von_mises_{name}": Variable(_REGION, "1", f"{name} of the largest stress of the later revolutions: {meaning}")
        for name, meaning in PLACES.items()
    },
    "share_of_revolutions_above_yield": Variable(
        _REGION, "1", "share of the later revolutions whose largest stress exceeds yield"
    ),
}

_GOODMAN = {
    "goodman_share": Variable(_REGION, "1", "share of the Goodman line: largest of all nodes and later revolutions"),
    "goodman_share_median": Variable(_REGION, "1", "median of the largest share of the Goodman line in each later revolution"),
    "share_of_revolutions_above_goodman": Variable(
        _REGION, "1", "share of the later revolutions with a node above the Goodman line"
    ),
    "goodman_alternating_stress": Variable(_REGION, "Pa", "alternating stress where the share of the Goodman line is largest"),
    "goodman_mean_stress": Variable(_REGION, "Pa", "mean stress there, 0 in compression"),
}

_OF_NODES = {
    "alternating_stress": Variable(
        ("stress_node",), "Pa", "largest von Mises stress of the stress less its mean over the later revolutions", "f4"
    ),
    "mean_stress": Variable(
        ("stress_node",), "Pa", "sum of the normal stresses of vibration and rotation, mean over the later revolutions", "f4"
    ),
}

_WEAR = {
    "wear": Variable(("angle",), "m", "wear of the lining, largest over the rings, at the end", "f4"),
    "max_wear": Variable((), "m", "largest wear of the lining at the end"),
    "wear_growth": Variable((), "m", "largest growth of a bar's wear in the last 50 revolutions, or quarter of the run"),
    "used_thickness": Variable(
        (), "m", "lining thickness used: deepest penetration that left wear; all of it where the lining is worn through"
    ),
    "worn_through_share": Variable((), "1", "share of the circumference at which the lining is worn through, at the end"),
    "wear_harmonic": Variable(("lobes",), "m", "amplitude of the wear profile's lobes"),
}

_WAVES = {
    "casing_amplitude": Variable(
        ("casing_mode", "casing_order"), "m", "amplitude of the waves of the casing's modes, which does not turn", "f4"
    ),
    **{
        f"casing_rms_{wave}": Variable(
            ("casing_mode",), "m", f"rms over time and circumference of the waves that run {sense}", "f4"
        )
        for wave, sense in (("forward", "with the rotor, or nowhere"), ("backward", "against the rotor"))
    },
    "casing_energy": Variable(("casing_mode",), "J", "mean energy of the casing's modes over the later revolutions", "f4"),
}

VARIABLES = STATUS | _MOTION | OF_KIND | _GIVEN_MOTION | _SPECTRUM | _STRESS | _GOODMAN | _OF_NODES | _WEAR | _WAVES
"""Variables over the speeds of a response."""

OF_LINING = {
    "lining_elastic_stiffness": Variable((), "N m-1", "stiffness of the elastic lining under the whole tip"),
    "lining_plastic_stiffness": Variable((), "N m-1", "stiffness of the lining under the whole tip while it wears"),
    "tip_stiffness": Variable((), "N m-1", "stiffness of the blade at rest under a normal force spread along its tip"),
    "lined_tip_share": Variable((), "1", "width of lining over length of tip, both along the casing's meridian"),
}

OF_CASING = {
    "casing_nodal_diameter": Variable(("casing_mode",), "1", "nodal diameters of the casing's mode"),
    "casing_frequency": Variable(("casing_mode",), "Hz", "natural frequency of the casing's mode, which does not turn"),
}

OF_STRESS = {
    "yield_stress": Variable((), "Pa", "yield stress of the blade's material"),
    "stress_region": Variable(_REGION, "1", "where stress is looked for", "str"),
    "static_stress": Variable((), "1", "1 where stresses have that of rotation, 0: vibration alone", "f4"),
}

OF_FATIGUE = {
    "fatigue_strength": Variable((), "Pa", "stress amplitude that the blade's material endures at zero mean"),
    "ultimate_strength": Variable((), "Pa", "tensile strength of the blade's material"),
}

OF_ALL_SPEEDS = {
    "casing_cone_angle": Variable((), "rad", "half angle of the casing's cone, negative where it narrows downstream"),
    "lined": Variable((), "1", "1 where a lining is worn, 0: the tip meets the casing itself", "f4"),
    "casing_lobes": Variable((), "1", "number of the casing's lobes", "f4"),
    **OF_LINING,
    **OF_CASING,
    **OF_STRESS,
    **OF_FATIGUE,
}
"""Variables of a response that are the same at every speed."""

HISTORIES = {
    "max_von_mises_history": Variable(
        ("history_speed", "region", "revolution"), "Pa", "largest von Mises stress of each revolution", "f4"
    ),
    "first_yield_revolution": Variable(("history_speed", "region"), "1", "first revolution whose largest stress exceeds yield"),
}
"""Variables of the speeds with a stress history."""

AXES = {
    "speed": SPEED,
    "revolution": Variable(("revolution",), "1", "number of the revolution"),
    "engine_order": Variable(("engine_order",), "1", "engine order"),
    "angle": Variable(("angle",), "rad", "start of the sector round the casing"),
    "lobes": Variable(("lobes",), "1", "number of lobes"),
    "contact_node": Variable(("contact_node",), "1", "number of the contact node, from the leading edge on"),
    "stress_node": Variable(("stress_node",), "1", "number of the node in the region that a map shows"),
    "casing_mode": Variable(("casing_mode",), "1", "number of the casing's mode"),
    "casing_order": Variable(
        ("casing_order",), "1", "frequency over speed, not turning; positive with the rotor, negative against it"
    ),
    "history_speed": Variable(("history_speed",), "rad s-1", "speed with a stress history"),
}
"""Numeric axes, of which a dataset has what its responses have together."""

DATASETS = {
    "rms": ("lined", "casing_lobes", *OF_LINING, "casing_cone_angle", *_MOTION, *OF_KIND),
    "spectrum": tuple(_SPECTRUM),
    "stress": ("lined", *_STRESS, *OF_STRESS, *HISTORIES),
    "fatigue": ("lined", *_GOODMAN, *OF_FATIGUE),
    "wear": tuple(_WEAR),
    "casing": (*OF_CASING, *_WAVES),
}
"""Dataset -> its variables, where a response has them; each also carries those of FLAGS. Nodes differ from blade to blade: what
they have stays in the response."""

FLAGS = tuple(STATUS)
