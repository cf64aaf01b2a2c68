# Runs of the product that more than one subject reads: the main job in results/, each other in results/runs/NAME.


def run(name, *changes, **keys):
    """Configuration of a run: overlays of config/, then keys."""
    return overlay(ROOT, *changes, **keys, run={"name": name, "engine": "validation/engine_numbers.json"})


# of runs whose overlay decides by large displacements: their pages show linear blades
LINEAR = {"kinematics": "linear"}


# the main job as shipped: `make all_blades` makes the same files
module sweep:
    snakefile:
        "../../Snakefile"
    config:
        overlay(ROOT, run={"engine": "validation/engine_numbers.json"})


use rule * from sweep as sweep_*


# all blades with lining and without at every 1 rad/s
module campaign:
    snakefile:
        "../../Snakefile"
    config:
        run("campaign", speeds=[{"start": 750, "stop": 2000, "step": 1}])


use rule * from campaign as campaign_*


# the same speeds as the main job, in contact on patches as all blades but the benchmark's own have it
module patches:
    snakefile:
        "../../Snakefile"
    config:
        run("patches", "patches")


use rule * from patches as patches_*


onstart:
    campaign.onstart()
