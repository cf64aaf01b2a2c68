"""Whole rotors as an extension."""

from r37core.plans.extension import Extension, Panel

from .plan import joined_dataset, remarks, targets

EXTENSION = Extension(
    name="rotors",
    targets=targets,
    remarks=remarks,
    captions={
        "rotor": (
            "Blade {blade} in scene {scene}, a whole rotor on one lining. Above: motion of every blade's leading edge, normal "
            "and tangential together, over speed, and the largest stress of any blade; red crosses: the blade that diverged "
            "first. Below: growth of all blades at the speed of the largest motion, and nodal diameters there."
        ),
    },
    closing="rotors.dataset.closing",
    panel=Panel(joined_dataset, "rotors.panel.rotor_contents", "rotors/panel.js"),
)
