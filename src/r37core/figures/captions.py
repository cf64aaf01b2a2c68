"""Captions of the figures: the one text that stands in the file itself, in the report and in the gallery."""

CAPTIONS = {
    "campbell": (
        "Campbell diagram of blade {blade}. Left: natural frequencies of the reduced model over speed, each mode in its "
        "colour, with its crossings with engine orders (grey) as dots. Right: change of the clearance at the leading edge, "
        "normal to the casing, over the tangential displacement. The blade swings freely in its first bending (1B) or "
        "first torsion mode (1T); below zero the gap closes. With an elastic casing: its waves as seen from the rotor "
        "(thin), and where a named mode meets one (diamonds)."
    ),
    "campbell_overview": (
        "Frequencies of the first bending (1B), first torsion (1T) and second bending mode (2B) of all blades over speed, "
        "with engine orders as grey lines."
    ),
    "blades": (
        "The blades, seen from the side, each in its colour of all figures. The arrow shows the rotation, LE the leading edge."
    ),
    "response": (
        "Response of blade {blade} over speed in every scene. Above: root mean square of the leading edge's displacement "
        "over the last half of the run, normal to the casing and tangential. Below: largest von Mises stress of the last "
        "revolution; where it is above yield (tinted) it is outside the linear model. Dotted: crossings of 1B with engine "
        "orders; red crosses: runs that diverged. Open circles: the blade has cut itself free by the end of the run; open "
        "triangles: its motion or the wear still grows there."
    ),
    "response_overview": (
        "Response of all blades over speed in every scene: root mean square of the leading edge's displacement over the "
        "last half of the run. Left: normal to the casing; right: tangential, each column on one scale. Red crosses: runs "
        "that diverged; open circles: cut free, and open triangles: growing at the end of the run."
    ),
    "spectrum": (
        "Spectral map of blade {blade} in scene {scene}: amplitude of the leading edge's motion, normal to the casing "
        "(left) and tangential (right), over speed and engine order. Colours are decibels below the largest amplitude at "
        "the same speed, which stands above the map; order 0 does not count. Dashed: frequencies of 1B, 1T and 2B. Where "
        "they meet a bright row of a whole engine order, the blade interacts with the casing."
    ),
    "casing": (
        "Waves round the elastic casing for blade {blade} in scene {scene}: rms of those with the rotor (left) and against it "
        "(right), over speed and nodal diameters. Below: mean energy of the casing over the last half of the run, and rms of "
        "all waves."
    ),
    "fatigue": (
        "Share of the Goodman line on blade {blade} in scene {scene}, at the speed where it is largest. It is the alternating "
        "stress over the fatigue strength, plus the mean stress, with that of rotation, over the ultimate strength. Dots are "
        "nodes, each with its largest share of the later revolutions. Red: largest of all; grey: outside the region of the "
        "stress."
    ),
    "wear": (
        "Wear of the lining at the end of the run, over speed and the angle round the casing, for blade {blade} in scene "
        "{scene}. Dotted: crossings of 1B with engine orders; an interaction wears as many lobes as its engine order. White "
        "triangles: speeds at which the lining is worn through to the casing behind it."
    ),
    "waterfall": (
        "Waterfall of blade {blade} in scene {scene}: spectra of the leading edge's motion, normal to the casing (left) "
        "and tangential (right), one above the other by speed. Speeds with the largest amplitudes are drawn, as far as "
        "they lie apart. All heights have one logarithmic scale, 60 dB below the largest amplitude. Dotted: engine orders; "
        "dashed: frequencies of 1B, 1T and 2B."
    ),
    "comparison": (
        "All blades in scene {scene} around the same interaction: 1B with the engine order that most of them meet. Over "
        "the speed above each blade's own crossing: rms of the leading edge, normal to the casing and tangential, and "
        "largest stress, tinted above yield. Contact stiffens a blade, so peaks lie above the crossing. Crosses at the upper "
        "edge: runs that diverged."
    ),
    "clearance": (
        "Clearance of the round casing over speed, of all blades in scene {scene}, at the first contact node (leading "
        "edge) and the last one (trailing edge). It is what the casing leaves less what rotation brings the blade nearer "
        "to it, before anything vibrates."
    ),
    "ranking": (
        "Which blade? Length of the speeds above yield of every blade, scene by scene, in the order of the first scene. Dark: "
        "in more than half of the revolutions in a run's second half; light: in more than a twentieth of them. Lines: standard "
        "deviation by chance, on the bare casing; with members: the range that contains nine tenths of them."
    ),
}
