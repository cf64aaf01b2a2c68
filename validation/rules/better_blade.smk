# Searches for a better blade, by surrogates and by plain sampling, each with three seeds (docs/better_blade.md).
SEARCHES = {
    f"search{'' if (method, seed) == ('surrogate', 1) else f'_{method}_{seed}'}": {"method": method, "seed": seed}
    for method in ("surrogate", "quasi_random")
    for seed in (1, 2, 3)
}
SEARCHED = [f"results/runs/{name}/search.nc" for name in SEARCHES]

for searched, changes in SEARCHES.items():

    module:
        name: searched
        snakefile:
            "../../Snakefile"
        config:
            run(searched, "search", search=changes)

    rules_of_search = f"{searched}_"

    use rule * from searched as rules_of_search*


use rule evidence as better_blade_designs with:
    input:
        # the responses of the designs lie beside it
        unpack(behind_engine(search="results/runs/search/search.nc")),
    output:
        best=f"{TABLES}/better_blade.csv",
        variables=f"{TABLES}/better_blade_variables.csv",
        all=f"{TABLES}/better_blade_designs.csv",
    log:
        "logs/validation/better_blade_designs.log",
    params:
        **evidence("better_blade.designs"),


use rule evidence as better_blade_depends with:
    input:
        unpack(behind_engine(search="results/runs/search/search.nc")),
    output:
        table=f"{TABLES}/better_blade_depends.csv",
    log:
        "logs/validation/better_blade_depends.log",
    params:
        **evidence("better_blade.depends"),
