# A search for a better blade (docs/better_blade.md).
module search:
    snakefile:
        "../../Snakefile"
    config:
        # fewer designs than the overlay
        run("search", "search", search={"designs": 20, "first": 8, "best": 4})


use rule * from search as search_*


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
