"""Constants of the benchmark as config/ has them, and whether the paper prints them (docs/validation.md)."""

from pathlib import Path
from typing import Any

from published import REFERENCE

from .configuration import settings_of
from .tables import write_table

PRINTED = "printed in the paper"


def table(input: Any, output: Any, params: Any) -> None:
    """Table of all constants of the scenes with lining and without."""
    settings = settings_of(Path.cwd(), fidelity="paper")
    scene: Any = settings.scenes["abradable"].scene
    bare = settings.scenes["direct"].scene
    material, level = settings.blades[REFERENCE].material, settings.fidelity
    casing, lining, run = scene.casing, scene.lining, level.time_integration
    giga = [f"{1e-9 * value:g}" for value in (material.youngs_modulus, lining.elastic_modulus, lining.plastic_modulus)]
    lobes = f"{casing.lobes} of {1e3 * casing.height:g} mm, width {casing.width:g}, after {casing.rise_fraction:.0%} of the run"
    lined, direct = ("vector" if each.friction.vector else "constant" for each in (scene, bare))
    rows = [
        ["blade: moduli", f"{giga[0]} GPa, Poisson's ratio {material.poissons_ratio:g}", PRINTED],
        ["blade: density", f"{material.density:g} kg/m3", PRINTED],
        ["blade: yield stress", f"{1e-9 * material.yield_stress:g} GPa", PRINTED],
        ["damping ratio", f"{scene.damping_ratio:g}", PRINTED],
        ["clearance", f"{1e3 * casing.clearance:g} mm", PRINTED],
        ["lobes of the casing", lobes, PRINTED],
        ["shape of the casing", "cone of the tip" if casing.cone_angle is None else "cylinder", "assumed, varied: a cylinder"],
        ["lining: thickness", f"{1e3 * lining.thickness:g} mm", PRINTED],
        ["lining: elastic and plastic modulus", f"{giga[1]} and {giga[2]} GPa", PRINTED],
        ["lining: yield stress", f"{lining.yield_stress:g} Pa", "printed; assumed to be no misprint, varied: 1.5 MPa"],
        ["lining: bars", f"{lining.bars}", PRINTED],
        ["lining: width of a bar", f"{1e3 * lining.bar_width:g} mm", "not printed: assumed, varied: 0.8 and 1.25 mm"],
        ["friction: coefficient", f"{scene.friction.coefficient:g}", PRINTED],
        ["friction: form", f"{lined} with lining, {direct} on the bare casing", "assumed, varied: the other form"],
        ["time step", f"{run.time_step_s:g} s", PRINTED],
        ["revolutions", f"{run.revolutions}", PRINTED],
        ["fixed-interface modes", f"{level.reduction.fixed_interface_modes} at each of three speeds", PRINTED],
        ["nodes of the mesh", f"{level.mesh.nodes}", "the paper's has 20,657"],
    ]
    write_table(["constant", "value", "source"], rows, output.table)
