"""What is seen in each figure: the one text that stands in the file itself, in the report and in the gallery."""

from __future__ import annotations

CAPTIONS = {
    "campbell": (
        "Campbell diagram of blade {blade}. Left: natural frequencies of the reduced model over speed, engine orders as "
        "grey lines, their crossings as dots. Right: change of the clearance at the leading edge, normal to the casing, "
        "while the blade swings freely in its first bending (1B) and first torsion mode (1T), over the tangential "
        "displacement; below zero the gap closes."
    ),
    "campbell_overview": (
        "Frequencies of the first bending (1B), first torsion (1T) and second bending mode (2B) of all blades over speed, "
        "with engine orders as grey lines."
    ),
    "blades": (
        "Meshes of the blades, seen from the side; the colour is the scaled Jacobian of the elements, 1 for an ideal shape."
    ),
    "response": (
        "Response of blade {blade} over speed in every scene: root mean square of the leading edge's displacement over "
        "the last half of the run, normal to the casing and tangential, and the largest von Mises stress of the last "
        "revolution with the yield stress (dashed). Dotted lines and numbers: crossings of 1B with engine orders; red "
        "crosses: runs that diverged."
    ),
    "response_overview": (
        "Response of all blades over speed in every scene: root mean square of the leading edge's displacement over the "
        "last half of the run, normal to the casing (left) and tangential (right), each column on one scale; red crosses: "
        "runs that diverged."
    ),
    "spectrum": (
        "Spectral map of blade {blade} in scene {scene}: amplitude of the leading edge's motion, normal to the casing "
        "(left) and tangential (right), over speed and engine order. Dashed: frequencies of 1B, 1T and 2B; where they "
        "meet a bright row of a whole engine order, the blade interacts with the casing."
    ),
    "wear": (
        "Wear of the lining at the end of the run, over speed and the angle round the casing, for blade {blade} in scene "
        "{scene}. Dotted: crossings of 1B with engine orders; an interaction wears as many lobes as its engine order."
    ),
    "waterfall": (
        "Waterfall of blade {blade} in scene {scene}: spectra of the leading edge's motion, normal to the casing (left) "
        "and tangential (right), one above the other by speed; of each stretch of speeds the one with the largest "
        "amplitude. Heights are logarithmic over three decades below the largest. Dotted: engine orders; dashed: "
        "frequencies of 1B, 1T and 2B."
    ),
    "comparison": (
        "All blades in scene {scene} around the same interaction, 1B with the engine order that most of them meet within "
        "the speeds: rms of the leading edge normal to the casing and tangential, and largest stress with the yield "
        "stress (dashed), over the speed above each blade's own crossing, in percent of it. Contact stiffens a blade, so "
        "peaks lie above the crossing."
    ),
    "designs": (
        "Family {family}: what each design is and how robust, over what varies. Frequencies, largest loss of clearance as "
        "the tip swings along free modes, speeds above yield, largest stress, and where interactions lie."
    ),
}


def caption(figure: str, **names: str) -> str:
    """The caption of a kind of figure, with the names (blade, scene, family) of the one at hand."""
    return CAPTIONS[figure].format(**names)
