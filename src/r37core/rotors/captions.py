"""What is seen in each figure of whole rotors."""

CAPTIONS = {
    "rotor": (
        "Blade {blade} in scene {scene}, a whole rotor on one lining. Above: motion of every blade's leading edge, normal and "
        "tangential together, over speed, and the largest stress of any blade; red crosses: the blade that diverged first. "
        "Below: growth of all blades at the speed of the largest motion, and nodal diameters there."
    ),
}
