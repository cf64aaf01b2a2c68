# r37: blade shape in; Campbell diagrams, vibration, stress and wear maps out. Reads like a table of contents.
import os

# one thread per job: Snakemake runs jobs side by side, and results must not depend on the number of cores
for library in ("OPENBLAS", "OMP", "MKL"):
    os.environ[f"{library}_NUM_THREADS"] = "1"


configfile: "config/config.yaml"


include: "workflow/rules/common.smk"
include: "workflow/rules/structure.smk"
include: "workflow/rules/figures.smk"


rule campbell:
    default_target: True
    input:
        "results/campbell.nc",
        expand("results/{blade}/mesh.{format}", blade=settings.blades, format=["msh", "inp"]),
        expand("results/figures/campbell_{blade}.png", blade=settings.blades),
        "results/figures/campbell.png",
        "results/figures/blades.png",
