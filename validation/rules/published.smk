# What the paper publishes, next to ours (docs/validation.md), and our counterpart of its figures (docs/gallery.md).
from evidence import published_windows as windows


# the published time step, about the published interactions
module paper:
    snakefile:
        "../../Snakefile"
    config:
        run("paper", fidelity="paper", **windows.speeds(windows.fine, ["direct"], 2.0))


use rule * from paper as paper_*


# each choice that the paper leaves open, varied once
module choices:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "choices",
            scenes_file="validation/scenes.yaml",
            scenes="all",
            **windows.speeds(
                windows.narrow, [f"direct_{name}" for name in windows.CHOICES if name not in windows.OF_LINING], 4.0
            ),
        )


use rule * from choices as choices_*


module inside:
    snakefile:
        "../../Snakefile"
    config:
        run("inside", structure={"boundary": {"corners": False}}, **windows.speeds(windows.narrow, ["direct"], 4.0))


use rule * from inside as inside_*


# members whose friction, lining and clearance differ by percents
module ranges:
    snakefile:
        "../../Snakefile"
    config:
        run(
            "ranges",
            tolerances={"members": windows.MEMBERS, "of_scenes": windows.TOLERANCES},
            **windows.speeds(windows.wide, ["direct"], 4.0),
        )


use rule * from ranges as ranges_*


def source_behind_engine(wildcards):
    """Files of a source, once the numbers of the engine are known."""
    checkpoints.engine_numbers.get()
    return windows.source(wildcards.of).files


def histories(*sources):
    """Files with the stress of every revolution."""
    return [windows.histories_of(name) for name in sources]


# the stress of every revolution is a result of a sweep only at speeds that a scene names
use rule evidence as published_histories with:
    input:
        source_behind_engine,
    output:
        file=windows.histories_of("{of}"),
    log:
        "logs/validation/histories_{of}.log",
    wildcard_constraints:
        of="paper|standard|(choice|member)_[a-z0-9_]+",
    params:
        **evidence("published_runs.histories"),
        of="{of}",


use rule evidence as published_checks with:
    input:
        unpack(
            behind_engine(
                *histories("paper", "standard"),
                campbells=[f"results/runs/campaign/{blade}/campbell.nc" for blade in windows.BLADES],
                geometry=f"results/runs/campaign/{windows.REFERENCE}/geometry.nc",
            )
        ),
    output:
        table=f"{TABLES}/validation_checks.csv",
        differences=f"{TABLES}/validation_differences.csv",
        kinds=f"{TABLES}/validation_kinds.csv",
        summary=f"{TABLES}/published_summary.csv",
    log:
        "logs/validation/published_checks.log",
    params:
        **evidence("published_tables.checks"),


use rule evidence as published_choices with:
    input:
        unpack(behind_engine(*histories("standard", *windows.ALL_CHOICES))),
    output:
        table=f"{TABLES}/modelling_choices.csv",
        short=f"{TABLES}/modelling_choices_short.csv",
    log:
        "logs/validation/published_choices.log",
    params:
        **evidence("published_tables.choices"),


use rule evidence as published_ranges with:
    input:
        unpack(behind_engine(*histories("paper", "standard", *windows.ALL_MEMBERS))),
    output:
        table=f"{TABLES}/validation_ranges.csv",
        short=f"{TABLES}/validation_ranges_short.csv",
        counts=f"{TABLES}/validation_ranges_counts.csv",
    log:
        "logs/validation/published_ranges.log",
    params:
        **evidence("published_tables.ranges"),


use rule evidence as gallery_charts with:
    input:
        unpack(
            behind_engine(
                *histories("standard"),
                model=f"results/runs/campaign/{windows.REFERENCE}/rom_pressure_edge.nc",
                campbell=f"results/runs/campaign/{windows.REFERENCE}/campbell.nc",
            )
        ),
    output:
        **{name: f"docs/gallery/{name}.png" for name in windows.CHARTS},
    log:
        "logs/validation/gallery_charts.log",
    params:
        **evidence("gallery.charts"),


use rule evidence as gallery_shapes with:
    input:
        unpack(
            behind_engine(
                mesh=f"results/{windows.REFERENCE}/mesh.vtu",
                modes=f"results/exports/{windows.REFERENCE}/modes",
            )
        ),
    output:
        **{name: f"docs/gallery/{name}.png" for name in ("modes", "mesh")},
    log:
        "logs/validation/gallery_shapes.log",
    params:
        **evidence("gallery.shapes"),


# what the main job computes of the reference blade, on the first page
use rule evidence as overview with:
    input:
        unpack(
            behind_engine(
                modes=f"results/exports/{windows.REFERENCE}/modes",
                lined=f"results/{windows.REFERENCE}/abradable/response.nc",
                direct=f"results/{windows.REFERENCE}/direct/response.nc",
                campbell=f"results/{windows.REFERENCE}/campbell.nc",
            )
        ),
    output:
        picture="docs/overview.png",
    log:
        "logs/validation/overview.log",
    params:
        **evidence("overview.draw"),
