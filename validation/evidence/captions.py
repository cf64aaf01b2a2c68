"""What is seen in each figure that only the gallery has."""

CAPTIONS = {
    "modes": (
        "The first three modes of blade {blade} at rest: first bending (1B), first torsion (1T) and second bending (2B). "
        "Each is moved by its shape from the blade at rest (lines); the colour is the size of the displacement."
    ),
    "mesh": ("Mesh of blade {blade}, and the part of it on which stress is recovered."),
    "reference": (
        "Response of blade {blade} over speed with lining and in direct contact. It is the root mean square of the leading "
        "edge's displacement over the last half of the run, normal to the casing and tangential. Dotted: published peaks."
    ),
    "revolution": (
        "Largest von Mises stress on the submesh of blade {blade} within the last revolution, with lining, at the "
        "published peak of 1B with order 4. Line: 248 instants; dots: the 62 of which the largest is kept for every speed."
    ),
    "histories": (
        "Largest von Mises stress of every revolution of blade {blade} in both scenes. Left to right: at the published "
        "peak of 1B with order 4, at that of direct contact, and where all is quiet. Dashed: yield stress."
    ),
    "stress": (
        "Largest von Mises stress of the last revolution of blade {blade} over speed, in both scenes. Dashed: yield "
        "stress; dotted: published peaks of the lined scene."
    ),
    "wear_content": (
        "Wear of the lining at the end of the run for blade {blade}: round the casing over speed (left), and the "
        "amplitude of each number of lobes in it (right)."
    ),
    "variants": ("Shapes of the variants, each in its colour over the reference blade in grey."),
    "variants_spectra": (
        "Spectral maps of the variants with lining: amplitude of the leading edge's motion normal to the casing over "
        "speed and engine order, on one scale. Dashed: frequency of 1B."
    ),
    "variants_response": (
        "Response of all blades with lining about 1B with order 4: root mean square of the leading edge's displacement, "
        "normal to the casing and tangential. Dotted: published peaks."
    ),
    "clearances": (
        "Dynamic clearance of all blades: change of the clearance at the leading edge, normal to the casing, as the tip "
        "swings along the free modes 1B and 1T."
    ),
    "peak_histories": (
        "Largest von Mises stress of every revolution of each blade with lining, at its own peak of 1B with order 4. "
        "Dashed: yield stress."
    ),
    "widths": (
        "Length of the range of speeds about 1B with order 4, with lining, whose last revolution is above yield, for "
        "every blade."
    ),
}
