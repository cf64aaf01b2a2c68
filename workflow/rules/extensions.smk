# Rules of each extension, and one more that makes all of it and nothing else: snakemake run_ups
from r37core.product.extensions import EXTENSIONS, FOLDERS

for folder in FOLDERS:

    include: f"{folder}.smk"


for extension in EXTENSIONS:

    rule:
        name:
            extension.name
        input:
            paths.filled(extension.all_targets(sweep)),
