"""Arrays of a run at one speed: dimensions, units and meaning of all that its file, speed_*.npz, may have.

The datasets have most of them under the same names, and the pages their table. Light: the simulations import it.

Later revolutions are those of the last half of a run, or the last 100 of one that goes on until it settles. Of a rotor numbers
are the largest of all blades, sums of hits and energies, the spectrum of the blade that leads and the snapshots of the one with
the largest stress. A diverged run has NaN where a number would need the rest of it.
"""

from functools import partial

from r37core.base.variable import Variable

from .settling import MotionAtEnd
from .status import MotionKind, RunStatus

_number = partial(Variable, ())
_TIP, _REGION, _BLADES = ("tip_point",), ("region",), ("blade_number",)
_LEADING_EDGE = "the leading edge's displacement, normal and tangential together,"
_HISTORY = "largest von Mises stress of each revolution, as far as it has snapshots"
_SO_FAR = ("done_revolution",)

PLACES = {
    "chord": "0 at the leading, 1 at the trailing edge",
    "span": "0 at the root, 1 at the tip",
    "side": "-1 on the pressure, 1 on the suction side",
}
"""Numbers of a place on the blade, as BladeMesh has them."""

STATUS = {
    "status": _number("1", "how the run ended", "i1", RunStatus),
    "diverged_revolution": _number("1", "revolution at which the run diverged"),
}

SIZES = {
    **{
        f"{kind}_{direction}": Variable(_TIP, "m", f"{measure} {direction} displacement over the later revolutions{note}")
        for kind, measure in (("rms", "rms of the"), ("peak", "largest"))
        for direction, note in (("normal", " (along the casing's normal)"), ("radial", ""), ("tangential", ""))
    },
    "peak_share_of_height": _number("1", "largest displacement over the blade's height"),
    "share_of_height_limit": _number("1", "share of the height beyond which second order leaves full finite elements"),
}

MOTION = {
    "bounded_share_of_time": _number("1", "share of the steps in which the bound on the elastic energy acts"),
    "energy_residual_share": _number("1", "size of the energy residual over the largest of work, loss and energy change"),
    "friction_power": _number("W", "largest mean power of the friction over 20 revolutions"),
    "friction_heat": _number("J", "work of the friction over the whole run"),
    "melting_power": _number("W", "power of the friction of which the share that enters the tip melts it in a second"),
    "motion_at_end": _number("1", "state of the motion at the end of the run", "i1", MotionAtEnd),
    "settled_revolution": _number("1", "revolution after which the run ended as it had settled, NaN where it did not"),
    "time_step": _number("s", "step of the time integration that was taken"),
    "clearance": Variable(("contact_node",), "m", "clearance of the round casing at the contact nodes, leading edge first"),
    "share_of_time_in_contact": _number("1", "share of the steps with a contact force"),
    "largest_normal_force": _number("N", "largest normal force on a tip node"),
    "largest_penetration": _number("m", "largest penetration of the tip's edge into the casing"),
    "casing_hits": _number("1", "how often a tip node came upon the casing"),
    "worst_complementarity": _number("1", "largest relative violation of the contact conditions"),
    "contact_work": _number("J", "work of the contact forces on the blade"),
    "damping_loss": _number("J", "energy lost to damping"),
    "energy_change": _number("J", "energy of the vibration at the end, less that at the start"),
    "energy_residual": _number("J", "energy change minus contact work plus damping loss"),
    "revolution_maximum": Variable(("revolution", "tip_point"), "m", "largest normal displacement of each revolution", "f4"),
}

OF_KIND = {
    "motion_kind": _number("1", "kind of the motion that goes on after the run", "i1", MotionKind),
    "lyapunov_exponent": _number("1", "largest Lyapunov exponent per revolution of the motion after the run"),
    "lyapunov_exponent_error": _number("1", "standard error of the Lyapunov exponent"),
    "recurrence": _number("1", "distance of the state from that a period before, as a share of its size"),
    "recurrence_period": _number("1", "period of the motion in revolutions, after which it comes nearest to itself"),
}
"""Variables of KindNumbers, in the order of its fields."""

SPECTRUM = {
    "amplitude": Variable(("engine_order",), "m", "amplitude of the leading edge's normal displacement", "f4"),
    "amplitude_tangential": Variable(("engine_order",), "m", "amplitude of the leading edge's tangential displacement", "f4"),
}

LAST_STRESS = {
    "max_von_mises_last_revolution": Variable(_REGION, "Pa", "largest von Mises stress in the region in the last revolution")
}

PLACE_OF_STRESS = {
    f"max_von_mises_{name}": Variable(_REGION, "1", f"{name} of the largest stress of any revolution: {meaning}")
    for name, meaning in PLACES.items()
}

OF_NODES = {
    "alternating_stress": Variable(
        ("stress_node",), "Pa", "largest von Mises stress of the stress less its mean over the later revolutions", "f4"
    ),
    "mean_stress": Variable(
        ("stress_node",), "Pa", "sum of the normal stresses of vibration and rotation, mean over the later revolutions", "f4"
    ),
}

WEAR = {
    "wear": Variable(("angle",), "m", "wear of the lining, largest over the rings, at the end", "f4"),
    "max_wear": _number("m", "largest wear of the lining at the end"),
    "wear_growth": _number("m", "largest growth of a bar's wear in the last 50 revolutions, or quarter of the run"),
    "used_thickness": _number(
        "m", "lining thickness used: deepest penetration that left wear; all of it where the lining is worn through"
    ),
    "worn_through_share": _number("1", "share of the circumference at which the lining is worn through, at the end"),
    "wear_harmonic": Variable(("lobes",), "m", "amplitude of the wear profile's lobes"),
}

WAVES = {
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

OF_SCENE = {
    "casing_cone_angle": _number("rad", "half angle of the casing's cone, negative where it narrows downstream"),
    "lined": _number("1", "1 where a lining is worn, 0: the tip meets the casing itself", "f4"),
    "casing_lobes": _number("1", "number of the casing's lobes", "f4"),
}

OF_LINING = {
    "lining_elastic_stiffness": _number("N m-1", "stiffness of the elastic lining under the whole tip"),
    "lining_plastic_stiffness": _number("N m-1", "stiffness of the lining under the whole tip while it wears"),
    "tip_stiffness": _number("N m-1", "stiffness of the blade at rest under a normal force spread along its tip"),
    "lined_tip_share": _number("1", "width of lining over length of tip, both along the casing's meridian"),
}

OF_CASING = {
    "casing_nodal_diameter": Variable(("casing_mode",), "1", "nodal diameters of the casing's mode"),
    "casing_frequency": Variable(("casing_mode",), "Hz", "natural frequency of the casing's mode, which does not turn"),
}

OF_STRESS = {
    "stress_region": Variable(_REGION, "1", "where stress is looked for", "str"),
    "static_stress": _number("1", "1 where stresses have that of rotation, 0: vibration alone", "f4"),
}

AXES = {
    "engine_order": Variable(("engine_order",), "1", "engine order"),
    "casing_order": Variable(
        ("casing_order",), "1", "frequency over speed, not turning; positive with the rotor, negative against it"
    ),
}

_IN_FILE = {
    "speed": _number("rad s-1", "angular speed of the rotor"),
    "diverged_time": _number("s", "time at which the run diverged"),
    "statistic_end": _number("1", "last of the later revolutions"),
    "statistic_revolutions": _number("1", "number of the later revolutions"),
    "revolution_share_of_height": Variable(
        _SO_FAR, "1", "largest displacement of the tip in each revolution over the blade's height"
    ),
    "force_so_far": Variable(_SO_FAR, "N", "largest normal force on a tip node until the end of each revolution"),
    "heat_so_far": Variable(_SO_FAR, "J", "work of the friction until the end of each revolution"),
    "bounded_so_far": Variable(
        _SO_FAR, "1", "steps in which the bound on the elastic energy acts until the end of each revolution"
    ),
    "revolution_rms": Variable(("done_revolution",), "m", f"rms of {_LEADING_EDGE} in each revolution until the end"),
    "region": Variable(_REGION, "1", "name of the region", "str"),
    "revolution_von_mises": Variable(("region", "recorded_revolution"), "Pa", _HISTORY),
    "snapshots": Variable(
        ("snapshot", "coordinate"),
        "m",
        "reduced coordinates of the vibration in the last revolution, with `static_stress` amplitudes of rotation's shapes",
    ),
    "cycle_alternating": Variable(("cycle",), "Pa", "alternating stress of the largest cycles, region by region"),
    "cycle_mean": Variable(("cycle",), "Pa", "mean stress of these"),
    "cycle_counts": Variable(("region", "later_revolution"), "1", "number of these in each of the later revolutions"),
}

OF_ROTOR = {
    "blade_rms": Variable(_BLADES, "m", f"rms of {_LEADING_EDGE} over the last half of the run"),
    "blade_peak": Variable(_BLADES, "m", f"largest value of {_LEADING_EDGE} over the last half of the run"),
    "blade_maximum": Variable((*_BLADES, "span"), "m", f"largest value of {_LEADING_EDGE} in the span", "f4"),
    "blade_contact": Variable(_BLADES, "1", "share of the steps with a contact force"),
    "blade_worn": Variable(_BLADES, "m3", "volume of lining that the blade has worn off, of bars of the scene's width"),
    "leader": _number("1", "number of the blade with the largest blade_rms; where the run diverged, that did first", "i4"),
    "nodal_diameter_share": Variable(
        ("nodal_diameter",),
        "1",
        "share of the blades' motion, normal and tangential, that runs round the rotor as a wave of so many nodal diameters",
    ),
    "blade_angle": Variable(_BLADES, "rad", "angle at which the blade stands"),
    "blade_frequency_factor": Variable(_BLADES, "1", "frequencies of the blade over those of the model"),
    "blade_longer": Variable(_BLADES, "m", "by how much the blade is longer than the model"),
    "blade_number": Variable(_BLADES, "1", "number of the blade", "i4"),
    "nodal_diameter": Variable(
        ("nodal_diameter",), "1", "nodal diameters; positive for a wave that runs in the sense of growing theta", "i4"
    ),
    "span_revolutions": _number("1", "revolutions of a span"),
    "blade_revolution_von_mises": Variable((*_BLADES, "recorded_revolution"), "Pa", _HISTORY),
}

CARRIED = {
    "carried_displacement": Variable(("rest_mode",), "m kg1/2", "displacement at the end, of modes at rest, then the casing's"),
    "carried_velocity": Variable(("rest_mode",), "m kg1/2 s-1", "velocity at the end, of these modes"),
    "carried_touched": Variable(("tip_node",), "1", "whether the contact node touched the casing in the last step"),
    "carried_contact_force": Variable(("axis", "tip_node"), "N", "contact force along the casing's normal, tangent, meridian"),
    "carried_penetration": Variable(("tip_node",), "m", "penetration of the unworn lining, negative where the node is clear"),
    "carried_bar_position": Variable(("tip_node",), "1", "angle of the contact node in bars of the lining"),
    "carried_wear": Variable(("ring", "bar"), "m", "wear of each bar of the lining, of a motion carried on in it"),
}
"""Motion as the run ends: CarriedMotion."""

ARRAYS = {
    **(STATUS | SIZES | MOTION | OF_KIND | SPECTRUM | LAST_STRESS | PLACE_OF_STRESS | OF_NODES | WEAR | WAVES),
    **(OF_SCENE | OF_LINING | OF_CASING | OF_STRESS | AXES | _IN_FILE | OF_ROTOR | CARRIED),
}
"""All arrays that the file of a run may have."""
