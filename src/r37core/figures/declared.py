"""The pipeline's figures, each declared once; a caption stands in the file itself, in the report and in the gallery."""

from typing import Any

from r37core.base.plain import to_plain
from r37core.config.elastic_casings import elastic_casings
from r37core.plans.extension import Figure
from r37core.plans.paths import CAMPBELL, MESH, RESPONSE, of, run_keys
from r37core.plans.sweep_plan import Sweep

ALL_CAMPBELL, RMS, STRESS = (f"<results>/{kind}.nc" for kind in ("campbell", "rms", "stress"))


def _stress(sweep: Sweep, wildcards: Any) -> str | list[str]:
    """The dataset of the stress, where a run that the figure shows has one."""
    shown = dict(wildcards.items()).items()
    runs = (dict(blade=blade, scene=scene) for blade, scene in sweep.runs_with("stress"))
    return STRESS if any(shown <= run.items() for run in runs) else []


_ROWS = (
    "Rows: speeds that are dangerous (dark: yield is passed in some revolution, inside the model), unknown (hatched: the model "
    "is left first, by the limits at the row's end), sustained (line: most of the later revolutions are above yield) or below "
    "yield throughout (light)."
)

BLADES = "The blades, seen from the side, each in its colour of all figures. The arrow shows the rotation, LE the leading edge."
"""Caption of the blades' picture, which is rendered into its file."""

FIGURES = (
    Figure(
        rule="campbell_figure",
        name="campbell_{blade}",
        runs=lambda sweep: of("blade", sweep.drawn["blade"]),
        draw="r37core.figures.campbell_diagram.draw_campbell",
        files={"campbell": CAMPBELL},
        label="Campbell diagram",
        caption="Campbell diagram of blade {blade}. Left: natural frequencies of the reduced model over speed, each mode in "
        "its colour, with its crossings with engine orders (grey) as dots. Right: change of the clearance at the leading "
        "edge, normal to the casing, over the tangential displacement. The blade swings freely in its first bending (1B) or "
        "first torsion mode (1T); below zero the gap closes. With an elastic casing: its waves as seen from the rotor (thin), "
        "and where a named mode meets one (diamonds).",
        arguments=lambda sweep: {"casings": to_plain(elastic_casings(sweep.settings))},
    ),
    Figure(
        rule="interference_figure",
        name="interference_{blade}",
        runs=lambda sweep: of("blade", [name for name in sweep.drawn["blade"] if sweep.settings.blades[name].cyclic]),
        draw="r37core.figures.campbell_diagram.draw_interference",
        files={"campbell": CAMPBELL},
        label="interference",
        caption="Interference diagram of blade {blade} on its disc: frequencies over nodal diameter at rest (open) and at the "
        "highest speed (filled), 1B, 1T and 2B in the colours of all figures, all others grey. Engine orders at the "
        "highest speed rise and fall with their aliasing: the line's point at a nodal diameter is the order that excites it.",
        over_speed=False,
    ),
    Figure(
        rule="interactions_figure",
        name="interactions",
        draw="r37core.figures.interaction_map.draw_interactions",
        files={"campbell": ALL_CAMPBELL, "rms": RMS, "interactions": "<results>/summary.csv", "stress": _stress},
        offered=("further_runs",),
        label="interactions",
        caption="Which interactions are dangerous? A Campbell diagram of each scene: engine orders (grey, with their numbers), "
        "and 1B, 1T and 2B, bands over several blades; dashed: other modes, and combinations of two, that interactions on a "
        "bare casing are named by. A circle is a dangerous interaction, above yield in some revolution inside the model, "
        "at its peak speed and engine order; its area is the length of these speeds, or the rms of the motion "
        "without stress, never less than that of an open ring. Hatched diamonds are unknown, as the model is left first, "
        "open rings below yield. Lines along a mark: its dangerous and sustained speeds. Ranges without an engine order lie on "
        "a strip below 0. '>': the range goes on to an end of the speeds that were run. Red crosses: runs that diverged. "
        + _ROWS
        + " Of more than six scenes those with the longest lengths.",
    ),
    Figure(
        rule="response_figure",
        name="response_{blade}",
        runs=lambda sweep: of("blade", sweep.drawn["blade"]),
        draw="r37core.figures.response_curves.draw_response",
        files={"campbell": ALL_CAMPBELL, "rms": RMS, "stress": _stress},
        label="response",
        caption="Response of blade {blade} over speed in every scene. Above: root mean square of the leading edge's "
        "displacement over the last half of the run, normal to the casing and tangential. Below: largest von Mises stress "
        "before the run leaves the model, and of all revolutions (thin), tinted above yield. Dotted: crossings of 1B with "
        "engine orders; red crosses: runs that diverged. Open circles: the blade has cut itself free by the end of the run; "
        f"open triangles: its motion or the wear still grows there. {_ROWS}",
        arguments=lambda sweep: {"drawn": {"scene": sweep.drawn["scene"]}},
        offered=("motions", "further_runs"),
    ),
    Figure(
        rule="spectrum_figure",
        name="spectrum_{blade}__{scene}",
        runs=lambda sweep: run_keys(sweep.drawn_runs("spectrum")),
        draw="r37core.figures.maps.draw_spectral_map",
        files={"campbell": CAMPBELL, "maps": RESPONSE},
        label="spectrum",
        caption="Spectral map of blade {blade} in scene {scene}: amplitude of the leading edge's motion, normal to the casing "
        "(left) and tangential (right), over speed and engine order. Colours are decibels below the largest amplitude at the "
        "same speed, which stands above the map; order 0 does not count. Dashed: frequencies of 1B, 1T and 2B. Where they "
        "meet a bright row of a whole engine order, the blade interacts with the casing.",
    ),
    Figure(
        rule="wear_figure",
        name="wear_{blade}__{scene}",
        runs=lambda sweep: run_keys(sweep.drawn_runs("wear")),
        draw="r37core.figures.maps.draw_wear_map",
        files={"campbell": CAMPBELL, "maps": RESPONSE},
        label="wear",
        caption="Wear of the lining at the end of the run, over speed and the angle round the casing, for blade {blade} in "
        "scene {scene}. Dotted: crossings of 1B with engine orders; an interaction wears as many lobes as its engine order. "
        "White triangles: speeds at which the lining is worn through to the casing behind it.",
    ),
    Figure(
        rule="casing_figure",
        name="casing_{blade}__{scene}",
        runs=lambda sweep: run_keys(sweep.drawn_runs("casing")),
        draw="r37core.figures.maps.draw_casing_map",
        files={"maps": "<results>/casing.nc"},
        label="casing",
        caption="Waves round the elastic casing for blade {blade} in scene {scene}: rms of those with the rotor (left) and "
        "against it (right), over speed and nodal diameters. Below: mean energy of the casing over the last half of the run, "
        "and rms of all waves.",
    ),
    Figure(
        rule="fatigue_figure",
        name="fatigue_{blade}__{scene}",
        runs=lambda sweep: run_keys(sweep.drawn_runs("fatigue")),
        draw="r37core.figures.fatigue_map.draw_fatigue_map",
        over_speed=False,
        files={"mesh": MESH, "rom": Sweep.reduced_model, "response": RESPONSE},
        offered=("further_runs",),
        label="fatigue",
        caption="Share of the Goodman line on blade {blade} in scene {scene}, at the speed where it is largest. It is the "
        "alternating stress over the fatigue strength, plus the mean stress, with that of rotation, over the ultimate "
        "strength. Dots are the nodes where the stress of the first region is computed, each with its largest share of the "
        "later revolutions. Red: largest of all.",
    ),
    Figure(
        rule="comparison_figure",
        name="comparison_{scene}",
        runs=lambda sweep: of("scene", sweep.drawn["scene"]),
        draw="r37core.figures.comparison.draw_comparison",
        files={"campbell": ALL_CAMPBELL, "rms": RMS, "stress": _stress},
        offered=("further_runs",),
        label="around an interaction",
        caption="All blades in scene {scene} around the same interaction: 1B with the engine order that most of them meet. "
        "Over the speed above each blade's own crossing: rms of the leading edge, normal to the casing and tangential, and "
        "largest stress inside the model and of all revolutions (thin), tinted above yield. Contact stiffens a blade, "
        "so peaks lie above the crossing. Crosses at the upper edge: runs that diverged. Blades without a run near their own "
        f"crossing are named in the title. {_ROWS}",
        arguments=lambda sweep: {
            **{name: getattr(sweep.settings.config.interactions, name) for name in ("below", "above")},
            "drawn": {"blade": sweep.drawn["blade"]},
        },
    ),
    Figure(
        rule="ranking_figure",
        name="ranking",
        runs=lambda sweep: [{}] if "stress" in sweep.kinds else [],
        draw="r37core.figures.comparison.draw_ranking",
        over_speed=False,
        files={"ranking": "<results>/ranking.csv"},
        label="ranking",
        caption="Which blade? Length of the dangerous speeds of every blade (dark), and of the unknown ones, at which the "
        "model is left before yield is passed (hatched), scene by scene, by rank, with the limits that are left. Before each "
        "name: places that the blade may have, as blades whose brackets overlap cannot be told apart. Upright line: length "
        "above yield in most later revolutions. Lines: what the dark length is known to within; with members: "
        "the range that has nine tenths of them.",
        arguments=lambda sweep: {"scenes": sweep.drawn["scene"]},
    ),
)
