# What the rules of the study `readings` share.
from r37core.studies.published import BLADES as PUBLISHED_BLADES
from r37core.studies.reading_list import READINGS
from r37core.studies.reading_places import places

READING_SETTINGS = settings.studies.readings
READING_PLACES = {name: places(reading, plain(READING_SETTINGS.speed_steps_rad_s)) for name, reading in READINGS.items()}
READING_RUNS = [(reading, place) for reading, found in READING_PLACES.items() for place in found]
READING_MESHES = [10000, 40000]
READING_CAMPBELLS = [(blade, "level") for blade in PUBLISHED_BLADES] + [("Ref", str(nodes)) for nodes in READING_MESHES]


def same_structure(level):
    """Whether a fidelity level has the mesh and reduction of this run."""
    parts = ("mesh", "reduction")
    entry = known("readings.base", level, settings.levels)
    return all(getattr(entry, part) == getattr(settings.fidelity, part) for part in parts)


def reading_structure(blade, changes):
    """Files of the model that a reading needs: this run's own where that is the same."""
    known("readings", blade, settings.blades)
    if not changes and same_structure(READING_SETTINGS.base):
        line = settings.structure.boundary.tip_line
        return {"rom": f"results/{blade}/rom_{line}.nc", "contact": f"results/{blade}/contact_{line}.npz"}
    files = study_model_files(blade, model_of_level(READING_SETTINGS.base, **changes))
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
    return plain(known(f"readings.{key}", getattr(READING_SETTINGS, key), settings.scene_entries))


def reading_campbell(blade, mesh="level"):
    """Campbell diagram of a blade with the mesh of the readings' level, or one of so many nodes."""
    return f"results/studies/readings/campbell/{blade}_{mesh}.nc"
