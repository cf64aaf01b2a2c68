# Rules of each extension and its figures, and one more that makes all of it and nothing else: snakemake run_ups
from r37core.product.extensions import EXTENSIONS

for extension in EXTENSIONS:

    include: f"{extension.name}.smk"

    for figure in extension.figures:
        category = figure.category or ("{blade}" if "{blade}" in figure.name else TOGETHER)
        subcategory = "{scene}" if "{scene}" in figure.name else EVERY_SCENE

        # a variant of `figure` cannot be named by a variable
        rule:
            name:
                figure.rule
            input:
                **figure.files,
                **(offered(figure.offered, sweep) if figure.offered else {}),
            output:
                **pictures(figure.name, category, subcategory, figure.label),
            log:
                f"<logs>/figures/{figure.name}.log",
            wildcard_constraints:
                **figure.constraints(sweep),
            conda:
                ENVIRONMENT
            resources:
                mem_mb=500,
            params:
                **drawing(figure.draw, figure.rule, **figure.arguments(sweep)),
            script:
                "../scripts/step.py"

    rule:
        name:
            extension.name
        input:
            paths.filled(extension.all_targets(sweep)),
