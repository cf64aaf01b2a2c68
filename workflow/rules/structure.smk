# Blade shape -> mesh -> matrices -> reduced model -> Campbell diagram, for each blade.
CAMPBELL_TIP_LINE = settings.structure.boundary.tip_line


rule geometry:
    output:
        "results/{blade}/geometry.nc",
    log:
        "logs/{blade}/geometry.log",
    # an impossible shape should stop the run before any long work
    priority: 10
    conda:
        ENVIRONMENT
    params:
        definition=lambda wildcards: settings.blades[wildcards.blade].definition,
        edges=settings.structure.edges,
        provenance=shape_provenance,
        code=code("io.py", "dataset_file.py", "blade/*.py"),
    script:
        "../scripts/geometry.py"


rule mesh:
    input:
        "results/{blade}/geometry.nc",
    output:
        msh="results/{blade}/mesh.msh",
        vtu="results/{blade}/mesh.vtu",
    log:
        "logs/{blade}/mesh.log",
    # a mesh or model that fails should do so before the first simulation
    priority: 2
    conda:
        ENVIRONMENT
    params:
        mesh=plain(settings.fidelity.mesh),
        code=code("blade/*.py", "mesh/*.py", "fem/wedge15.py", "fem/mesh_quality.py"),
    script:
        "../scripts/mesh.py"


rule abaqus_deck:
    input:
        "results/{blade}/mesh.vtu",
    output:
        "results/{blade}/mesh.inp",
    log:
        "logs/{blade}/abaqus_deck.log",
    conda:
        ENVIRONMENT
    params:
        material=lambda wildcards: asdict(settings.blades[wildcards.blade].material),
        code=code("mesh/*.py"),
    script:
        "../scripts/abaqus_deck.py"


rule matrices:
    input:
        "results/{blade}/mesh.vtu",
    output:
        "results/{blade}/matrices.npz",
    log:
        "logs/{blade}/matrices.log",
    priority: 2
    conda:
        ENVIRONMENT
    params:
        material=lambda wildcards: asdict(settings.blades[wildcards.blade].material),
        code=code("mesh/wedge_mesh.py", "mesh/mesh_files.py", "fem/*.py"),
    script:
        "../scripts/matrices.py"


rule reduced_model:
    input:
        mesh="results/{blade}/mesh.vtu",
        matrices="results/{blade}/matrices.npz",
    output:
        "results/{blade}/rom_{tip_line}.nc",
    log:
        "logs/{blade}/reduced_model_{tip_line}.log",
    priority: 2
    conda:
        ENVIRONMENT
    params:
        reduction=lambda wildcards: asdict(settings.reduction_choice(wildcards.tip_line)),
        provenance=structure_provenance,
        code=code("io.py", "dataset_file.py", "mesh/wedge_mesh.py", "fem/matrices.py", "fem/solver.py", "rom/*.py"),
    script:
        "../scripts/reduced_model.py"


rule campbell_of_blade:
    input:
        f"results/{{blade}}/rom_{CAMPBELL_TIP_LINE}.nc",
    output:
        "results/{blade}/campbell.nc",
    log:
        "logs/{blade}/campbell.log",
    conda:
        ENVIRONMENT
    params:
        campbell=plain(settings.campbell),
        maximum_speed=settings.structure.maximum_speed_rad_s,
        tip_line=CAMPBELL_TIP_LINE,
        provenance=structure_provenance,
        code=code("io.py", "dataset_file.py", "rom/*.py", "results/campbell*.py"),
    script:
        "../scripts/campbell_of_blade.py"


rule campbell_of_all:
    input:
        expand("results/{blade}/campbell.nc", blade=settings.blades),
    output:
        "results/campbell.nc",
    log:
        "logs/campbell_of_all.log",
    conda:
        ENVIRONMENT
    params:
        blades=list(settings.blades),
        fidelity=settings.fidelity_name,
        code=code("io.py", "dataset_file.py", "results/gather.py"),
    script:
        "../scripts/campbell_of_all.py"


rule campbell:
    input:
        "results/campbell.nc",
        expand("results/{blade}/mesh.{format}", blade=settings.blades, format=["msh", "inp"]),
        expand("results/figures/campbell_{blade}.png", blade=settings.blades),
        "results/figures/campbell.png",
        "results/figures/blades.png",
