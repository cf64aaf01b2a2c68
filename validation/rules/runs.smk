# Runs of the product that more than one subject reads, each with its results in results/runs/NAME.


def run(name, *changes, **keys):
    """Configuration of a run: overlays of config/, then keys."""
    return overlay(ROOT, *changes, **keys, run={"name": name, "engine": "validation/engine_numbers.json"})


# all blades with lining and without at every 1 rad/s
module campaign:
    snakefile:
        "../../Snakefile"
    config:
        run("campaign", speeds=[{"start": 750, "stop": 2000, "step": 1}])


use rule * from campaign as campaign_*


onstart:
    campaign.onstart()


onsuccess:
    campaign.onsuccess()


onerror:
    campaign.onerror()
