# What the rules of the studies share.
from r37core.studies.stability_cases import extremes

TRADEOFF = settings.studies.tradeoff
TRADEOFF_BLADE = TRADEOFF.blade
TRADEOFF_SCENES = list(settings.scenes) if TRADEOFF.scenes == "all" else TRADEOFF.scenes


def known(key, name, entries):
    """The entry of this name; a study may name what this run leaves out, which matters only when the study is asked for."""
    if name not in entries:
        raise WorkflowError(f"config.yaml: studies.{key}: found '{name}'; allowed: {', '.join(entries)}")
    return entries[name]


def study_material(wildcards):
    """Material of a study's blade."""
    return asdict(known("*.blade", wildcards.blade, settings.blades).material)


def study_scene(key, name):
    """Contact scene of a study."""
    return known(key, name, settings.scenes).scene


def text_of(value):
    """A knob's value as it stands in file names."""
    return value if isinstance(value, str) else exact_text(value)


TRADEOFF_VALUES = {knob: [text_of(value) for value in entry.values] for knob, entry in TRADEOFF.knobs.given().items()}
TRADEOFF_REFERENCES = {knob: text_of(entry.reference) for knob, entry in TRADEOFF.knobs.given().items()}


def model_of_level(level, **changes):
    """Name of the model of a fidelity level, with something changed: see model_choice."""
    entry = known("*.base", level, settings.levels)
    parts = {
        "nodes": entry.mesh.nodes,
        "boundary_nodes": settings.structure.boundary.nodes,
        "fixed_interface_modes": entry.reduction.fixed_interface_modes,
        "region": "submesh",
        "line": settings.structure.boundary.tip_line,
        "ends": "corners" if settings.structure.boundary.corners else "inside",
    } | changes
    return "{nodes}_{boundary_nodes}_{fixed_interface_modes}_{region}_{line}_{ends}".format(**parts)


def model_choice(wildcards):
    """What a model's name says."""
    return {
        "nodes": int(wildcards.nodes),
        "boundary_nodes": int(wildcards.boundary_nodes),
        "fixed_interface_modes": int(wildcards.fixed_interface_modes),
        "whole_blade_stress": wildcards.region == "whole",
        "tip_line": wildcards.line,
        "corners": wildcards.ends == "corners",
    }


def study_model_files(blade, model):
    """The files of a study's model."""
    known("*.blade", blade, settings.blades)
    stem = f"results/studies/models/{blade}/{model}"
    return {"rom": f"{stem}_rom.nc", "contact": f"{stem}_contact.npz", "cost": f"{stem}_cost.json"}


def tradeoff_model(wildcards):
    """Files of the model that a knob's value needs."""
    knob, value = wildcards.knob, wildcards.value
    model_knobs = {
        "mesh_nodes": "nodes",
        "boundary_nodes": "boundary_nodes",
        "fixed_interface_modes": "fixed_interface_modes",
    }
    if knob == "level":
        model = model_of_level(value)
    elif knob == "stress_region":
        model = model_of_level(TRADEOFF.base, region=value)
    elif knob in model_knobs:
        model = model_of_level(TRADEOFF.base, **{model_knobs[knob]: int(value)})
    else:
        model = model_of_level(TRADEOFF.base)
    return study_model_files(wildcards.blade, model)


def study_choice(level):
    """The march of a fidelity level, with the stress of the last revolution and the energy balance."""
    return asdict(known("*.base", level, settings.levels).march.choice())


def tradeoff_choices(wildcards):
    """The march of every scene, before the knob is turned."""
    level = wildcards.value if wildcards.knob == "level" else TRADEOFF.base
    return {scene: study_choice(level) for scene in TRADEOFF_SCENES}


STABILITY = settings.studies.stability
EXTREMES = {extreme.name: extreme for extreme in extremes(STABILITY.lined_scene, STABILITY.rigid_scene)}


def stability_model(wildcards):
    """Contact model of an extreme."""
    changes = EXTREMES[wildcards.extreme].model
    return study_model_files(STABILITY.blade, model_of_level(STABILITY.base, **changes))["contact"]
