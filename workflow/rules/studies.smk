# Studies of the model itself: what a sweep will cost, what accuracy costs. None is part of all_blades.


rule estimate_sample:
    input:
        unpack(recovery_file),
        model=contact_model_file,
        prepared="results/{blade}/{scene}/march.stamp",
    output:
        "results/studies/estimate/{blade}__{scene}.json",
    log:
        "logs/studies/estimate_{blade}__{scene}.log",
    conda:
        ENVIRONMENT
    params:
        scene=lambda wildcards: settings.scenes[wildcards.scene].scene,
        choices=lambda wildcards: {
            speed: asdict(settings.march_choice(wildcards.scene, speed))
            for speed in sample_of_sweep(wildcards.blade, wildcards.scene)
        },
        number=lambda wildcards: len(settings.speeds[wildcards.blade, wildcards.scene]),
        results=lambda wildcards: settings.scenes[wildcards.scene].results,
        kept=kept_of_a_run(),
        stress_instants=settings.fidelity.march.stress_instants,
        material=lambda wildcards: asdict(settings.blades[wildcards.blade].material),
        described=sweep_provenance,
        code=code("contact/*.*", "march/*.*", "results/response.py", "studies/estimate.py"),
    script:
        "../scripts/estimate_sample.py"


rule estimate:
    input:
        expand("results/studies/estimate/{blade}__{scene}.json", blade=settings.blades, scene=settings.scenes),
    output:
        json="results/studies/estimate.json",
        table="results/studies/estimate.md",
    log:
        "logs/studies/estimate.log",
    conda:
        ENVIRONMENT
    params:
        workflow_s_per_job=settings.studies.estimate.workflow_s_per_job,
        cores=settings.studies.estimate.cores,
        fidelity=settings.fidelity_name,
        code=code("studies/estimate.py"),
    script:
        "../scripts/estimate.py"


rule study_model:
    input:
        "results/{blade}/geometry.nc",
    output:
        rom="results/studies/models/{blade}/{nodes}_{boundary_nodes}_{fixed_interface_modes}_{region}_{line}_{ends}_rom.nc",
        contact="results/studies/models/{blade}/{nodes}_{boundary_nodes}_{fixed_interface_modes}_{region}_{line}_{ends}_contact.npz",
        cost="results/studies/models/{blade}/{nodes}_{boundary_nodes}_{fixed_interface_modes}_{region}_{line}_{ends}_cost.json",
    log:
        "logs/studies/models/{blade}/{nodes}_{boundary_nodes}_{fixed_interface_modes}_{region}_{line}_{ends}.log",
    wildcard_constraints:
        nodes=r"\d+",
        boundary_nodes=r"\d+",
        fixed_interface_modes=r"\d+",
        region="submesh|whole",
        line="pressure_edge|camber|suction_edge",
        ends="corners|inside",
    priority: 2
    conda:
        ENVIRONMENT
    params:
        choice=model_choice,
        reduction=asdict(settings.reduction_choice()),
        material=study_material,
        provenance=structure_provenance,
        code=code("mesh/*.py", "fem/*.py", "rom/*.py", "studies/models.py"),
    script:
        "../scripts/study_model.py"


rule tradeoff_case:
    input:
        unpack(tradeoff_model),
        campbell="results/{blade}/campbell.nc",
    output:
        "results/studies/tradeoff/{blade}/{knob}/{value}.nc",
    log:
        "logs/studies/tradeoff/{blade}/{knob}/{value}.log",
    wildcard_constraints:
        knob="|".join(TRADEOFF_VALUES),
        value=r"[\w.+-]+",
    conda:
        ENVIRONMENT
    params:
        scenes=lambda wildcards: {scene: study_scene("tradeoff.scenes", scene) for scene in TRADEOFF_SCENES},
        described=lambda wildcards: [repr(study_scene("tradeoff.scenes", scene)) for scene in TRADEOFF_SCENES],
        choices=tradeoff_choices,
        places=plain(TRADEOFF.places),
        engine_order=TRADEOFF.engine_order,
        material=study_material,
        code=code("contact/*.*", "march/*.*", "studies/case.py", "studies/tradeoff.py"),
    script:
        "../scripts/tradeoff_case.py"


rule tradeoff:
    input:
        [
            f"results/studies/tradeoff/{TRADEOFF_BLADE}/{knob}/{value}.nc"
            for knob, values in TRADEOFF_VALUES.items()
            for value in values
        ],
    output:
        dataset="results/studies/tradeoff.nc",
        levels="results/studies/levels.md",
        table="results/studies/tradeoff.md",
        knobs=expand("results/studies/figures/tradeoff_{knob}.png", knob=TRADEOFF_VALUES),
        pareto="results/studies/figures/tradeoff_pareto.png",
    log:
        "logs/studies/tradeoff.log",
    conda:
        ENVIRONMENT
    params:
        knobs=list(TRADEOFF_VALUES),
        references=TRADEOFF_REFERENCES,
        tolerance=settings.tolerance,
        provenance={"blade": TRADEOFF_BLADE, "base_level": TRADEOFF.base},
        code=code("studies/tradeoff*.py", "figures/style.py", "figures/tradeoff.py"),
    script:
        "../scripts/tradeoff.py"


rule stability_case:
    input:
        contact=stability_model,
    output:
        "results/studies/stability/{extreme}.json",
    log:
        "logs/studies/stability/{extreme}.log",
    wildcard_constraints:
        extreme=r"[\w.+-]+",
    conda:
        ENVIRONMENT
    params:
        extreme=lambda wildcards: asdict(EXTREMES[wildcards.extreme]),
        entry=lambda wildcards: plain(
            known("stability.*_scene", EXTREMES[wildcards.extreme].scene, settings.scene_entries)
        ),
        choice=lambda wildcards: study_choice(STABILITY.base),
        code=code("contact/*.*", "march/*.*", "studies/case.py", "studies/stability.py"),
    script:
        "../scripts/stability_case.py"


rule stability:
    input:
        expand("results/studies/stability/{extreme}.json", extreme=EXTREMES),
    output:
        "results/studies/stability.md",
    log:
        "logs/studies/stability.log",
    conda:
        ENVIRONMENT
    params:
        code=code("studies/stability.py"),
    script:
        "../scripts/stability.py"


rule growth:
    input:
        "results/studies/tradeoff.nc",
    output:
        table="results/studies/growth.md",
        figure="results/studies/figures/growth.png",
    log:
        "logs/studies/growth.log",
    conda:
        ENVIRONMENT
    params:
        code=code("studies/growth.py", "figures/style.py", "figures/growth.py"),
    script:
        "../scripts/growth.py"
