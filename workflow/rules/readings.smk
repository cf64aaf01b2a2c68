# The study `readings`: what the benchmark leaves open, and its published numbers beside ours.
from r37core.studies.published import BLADES as PUBLISHED_BLADES
from r37core.studies.reading_list import READINGS
from r37core.studies.reading_places import places

READING_SETTINGS = settings.studies["readings"]
READING_PLACES = {name: places(reading, READING_SETTINGS["speed_steps_rad_s"]) for name, reading in READINGS.items()}
READING_RUNS = [(reading, place) for reading, found in READING_PLACES.items() for place in found]
READING_MESHES = [10000, 40000]
READING_CAMPBELLS = [(blade, "level") for blade in PUBLISHED_BLADES] + [("Ref", str(nodes)) for nodes in READING_MESHES]


def same_structure(level):
    """Whether a fidelity level has the mesh and reduction of this run."""
    parts = ("mesh", "reduction")
    return all(known("readings.base", level, settings.levels)[part] == settings.fidelity[part] for part in parts)


def reading_structure(blade, changes):
    """Files of the model that a reading needs: this run's own where that is the same."""
    known("readings", blade, settings.blades)
    if not changes and same_structure(READING_SETTINGS["base"]):
        line = settings.structure["boundary"]["tip_line"]
        return {"rom": f"results/{blade}/rom_{line}.nc", "contact": f"results/{blade}/contact_{line}.npz"}
    files = study_model_files(blade, model_of_level(READING_SETTINGS["base"], **changes))
    return {name: files[name] for name in ("rom", "contact")}


def reading_place(wildcards):
    """Where a reading is run."""
    return READING_PLACES[wildcards.reading][wildcards.place]


def reading_model(wildcards):
    """Files of the model that a reading needs."""
    return reading_structure(reading_place(wildcards).blade, READINGS[wildcards.reading].model)


def reading_entry(wildcards):
    """The scene's entry of scenes.yaml that a reading starts from."""
    key = f"{reading_place(wildcards).kind}_scene"
    return known(f"readings.{key}", READING_SETTINGS[key], settings.scene_entries)


def reading_campbell(blade, mesh="level"):
    """Campbell diagram of a blade with the mesh of the readings' level, or one of so many nodes."""
    return f"results/studies/readings/campbell/{blade}_{mesh}.nc"


rule reading:
    input:
        unpack(reading_model),
    output:
        "results/studies/readings/{reading}/{place}.nc",
    log:
        "logs/studies/readings/{reading}_{place}.log",
    wildcard_constraints:
        reading="|".join(READINGS),
        place=r"[A-Za-z0-9]+_[a-z0-9]+",
    conda:
        ENVIRONMENT
    params:
        reading=lambda wildcards: asdict(READINGS[wildcards.reading]),
        place=lambda wildcards: asdict(reading_place(wildcards)),
        entry=reading_entry,
        choice=lambda wildcards: study_choice(READING_SETTINGS["base"]),
        schemas=str(ROOT / "config" / "schemas"),
        material=lambda wildcards: asdict(settings.blades[reading_place(wildcards).blade].material),
        code=code("contact/*.*", "march/*.*", "studies/readings.py"),
    script:
        "../scripts/reading.py"


rule reading_campbell:
    input:
        lambda wildcards: reading_structure(
            wildcards.blade, {} if wildcards.mesh == "level" else {"nodes": int(wildcards.mesh)}
        )["rom"],
    output:
        "results/studies/readings/campbell/{blade}_{mesh}.nc",
    log:
        "logs/studies/readings/campbell_{blade}_{mesh}.log",
    wildcard_constraints:
        mesh=r"level|\d+",
    conda:
        ENVIRONMENT
    params:
        campbell=settings.campbell,
        maximum_speed=settings.structure["maximum_speed_rad_s"],
        tip_line=settings.structure["boundary"]["tip_line"],
        provenance=structure_provenance,
        code=code("io.py", "dataset_file.py", "rom/*.py", "results/campbell*.py"),
    script:
        "../scripts/campbell_of_blade.py"


rule readings:
    input:
        geometry="results/Ref/geometry.nc",
        campbells=[reading_campbell(blade, mesh) for blade, mesh in READING_CAMPBELLS],
        runs=[f"results/studies/readings/{reading}/{place}.nc" for reading, place in READING_RUNS],
    output:
        validation="results/studies/validation.md",
        readings="results/studies/readings.md",
        picture="results/studies/figures/readings.png",
        reference="results/studies/figures/validation_reference.png",
        blades="results/studies/figures/validation_blades.png",
        stress="results/studies/figures/validation_stress.png",
        histories="results/studies/figures/validation_histories.png",
        spectrum_lined="results/studies/figures/validation_spectrum_lined.png",
        spectrum_rigid="results/studies/figures/validation_spectrum_rigid.png",
    log:
        "logs/studies/readings.log",
    conda:
        ENVIRONMENT
    params:
        yield_stress=lambda wildcards: known("readings", "Ref", settings.blades).material.yield_stress,
        runs=READING_RUNS,
        campbells=READING_CAMPBELLS,
        meshes=READING_MESHES,
        code=code("studies/*.py", "figures/style.py", "figures/maps.py", "figures/readings.py", "figures/validation.py"),
    script:
        "../scripts/validation.py"
