"""What is seen in each figure of whole rotors."""

CAPTIONS = {
    "rotor": (
        "Blade {blade} in scene {scene}, a whole rotor on one lining. Above: rms of every blade's leading edge over speed, "
        "and the largest stress of any blade. Below: growth of all blades at the speed of the largest motion, and nodal "
        "diameters there."
    ),
}
