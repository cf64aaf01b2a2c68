# Each wing's rules, and one more that makes all of it and nothing else: snakemake run_ups
from r37core.product.wings import WINGS

for wing in WINGS:

    include: f"{wing.name}.smk"

    rule:
        name:
            wing.name
        input:
            files_of(wing, sweep),
