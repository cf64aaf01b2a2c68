# Rules of the optional packages, and one more for each extension that makes all of it and nothing else: snakemake run_ups
from r37core.base.packages import registered
from r37core.product.extensions import EXTENSIONS

for file in registered("RULES").values():

    include: file


for extension in EXTENSIONS:

    rule:
        name:
            extension.name
        input:
            paths.filled(extension.all_targets(sweep)),
