# Studies of the model itself: what a sweep will cost, what accuracy costs. None is part of all_blades.


rule estimate_sample:
    input:
        rom=lambda wildcards: f"results/{wildcards.blade}/rom_{settings.scenes[wildcards.scene].tip_line}.nc",
        model=contact_model_file,
        prepared="results/{blade}/{scene}/march.stamp",
    output:
        "results/studies/estimate/{blade}_{scene}.json",
    log:
        "logs/studies/estimate_{blade}_{scene}.log",
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
        stress_instants=settings.fidelity["march"]["stress_instants"],
        material=lambda wildcards: asdict(settings.blades[wildcards.blade].material),
        described=sweep_provenance,
        code=code("contact/*.*", "march/*.*", "results/response.py", "studies/estimate.py"),
    script:
        "../scripts/estimate_sample.py"


rule estimate:
    input:
        expand("results/studies/estimate/{blade}_{scene}.json", blade=settings.blades, scene=settings.scenes),
    output:
        json="results/studies/estimate.json",
        table="results/studies/estimate.md",
    log:
        "logs/studies/estimate.log",
    conda:
        ENVIRONMENT
    params:
        workflow_s_per_job=settings.studies["estimate"]["workflow_s_per_job"],
        cores=settings.studies["estimate"]["cores"],
        fidelity=settings.fidelity_name,
        code=code("studies/estimate.py"),
    script:
        "../scripts/estimate.py"
