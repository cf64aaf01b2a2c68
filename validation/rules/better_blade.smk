# Searches for a better blade: by surrogates with three seeds, and by plain sampling, whose first designs are those of the seed's
# surrogate, too (docs/better_blade.md).
WORDS = {"surrogate": "surrogate", "quasi_random": "plain sampling"}
SEARCHES = {
    "search": {"method": "surrogate", "seed": 1},
    "search_surrogate_2": {"method": "surrogate", "seed": 2},
    "search_surrogate_3": {"method": "surrogate", "seed": 3},
    "search_quasi_random_1": {"method": "quasi_random", "seed": 1},
    "search_quasi_random_2": {"method": "quasi_random", "seed": 2},
}
SEARCHED = {
    f"results/runs/{name}/search.nc": f"{WORDS[changes['method']]}, seed {changes['seed']}"
    for name, changes in SEARCHES.items()
}

for searched, changes in SEARCHES.items():

    module:
        name: searched
        snakefile:
            "../../Snakefile"
        config:
            run(searched, "search", structure=LINEAR, search=changes)

    rules_of_search = f"{searched}_"

    use rule * from searched as rules_of_search*


# the best designs of two searches beside their start, at another level; as rotors at the level of the searches
CHECKED = {"Free": "Free", "Better": "best of seed 2", "Thicker": "best of seed 3"}


module checked_best:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "search_best",
            "search_best",
            structure=LINEAR,
            blades_file="validation/better_blades.yaml",
            blades=list(CHECKED),
            scenes=["material_abradable", "direct"],
            # fewer speeds than the overlay
            speeds=[{"start": 750, "stop": 2000, "step": 40}],
            second_motions={"step_rad_s": 20},
        )


use rule * from checked_best as checked_best_*


module checked_rotor:
    snakefile:
        "../../Snakefile"
    config:
        overlay(
            ROOT,
            blades_file="validation/better_blades.yaml",
            blades=list(CHECKED),
            scenes=["rotor_abradable"],
            fidelity="draft",
            speeds=[{"start": 750, "stop": 2000, "step": 40}],
            run={"name": "search_rotor", "engine": "validation/engine_numbers.json"},
        )


use rule * from checked_rotor as checked_rotor_*


use rule evidence as better_blade_searches with:
    input:
        # the responses of the designs lie beside them
        unpack(behind_engine(searches=list(SEARCHED))),
    output:
        table=f"{TABLES}/better_blade.csv",
    log:
        "logs/validation/better_blade_searches.log",
    params:
        **evidence("better_blade.searches"),
        searches=SEARCHED,


use rule evidence as better_blade_designs with:
    input:
        unpack(behind_engine(searches=list(SEARCHED))),
    output:
        table=f"{TABLES}/better_blade_designs.csv",
        picture="docs/search_designs.png",
    log:
        "logs/validation/better_blade_designs.log",
    params:
        **evidence("better_blade.designs"),
        searches=SEARCHED,


use rule evidence as better_blade_checks with:
    input:
        # the responses of the members lie beside these
        unpack(
            behind_engine(
                members="results/runs/search_best/tolerances.nc",
                motions="results/runs/search_best/second_motions.nc",
                rotors=[f"results/runs/search_rotor/{blade}/rotor_abradable/rotor.nc" for blade in CHECKED],
            )
        ),
    output:
        table=f"{TABLES}/better_blade_checks.csv",
    log:
        "logs/validation/better_blade_checks.log",
    params:
        **evidence("better_blade.checks"),
        folder="results/runs/search_best",
        blades=CHECKED,
