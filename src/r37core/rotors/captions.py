"""What is seen in each figure of whole rotors."""

CAPTIONS = {
    "rotor": (
        "Blade {blade} in scene {scene}, a whole rotor on one lining: rms of the leading edge's normal displacement of every "
        "blade over speed; the largest stress of any blade, and how many are above yield; growth of the blades at the speed "
        "of the largest motion; nodal diameters of the blades' motion there."
    ),
}
