# Reduced model -> one simulation per blade, scene and speed -> all speeds of a blade and scene.


rule contact_model:
    input:
        "results/{blade}/rom_{tip_line}.nc",
    output:
        "results/{blade}/contact_{tip_line}.npz",
    log:
        "logs/{blade}/contact_model_{tip_line}.log",
    priority: 2
    conda:
        ENVIRONMENT
    params:
        code=code("io.py", "rom/reduced_model.py", "rom/contact_*.py"),
    script:
        "../scripts/contact_model.py"


rule prepare_march:
    input:
        contact_model_file,
    output:
        touch("results/{blade}/{scene}/march.stamp"),
    log:
        "logs/{blade}/{scene}/prepare_march.log",
    # the sweep's jobs find the march compiled; one message before the sweep instead of one from each of its jobs
    priority: 15
    conda:
        ENVIRONMENT
    params:
        scene=lambda wildcards: settings.scenes[wildcards.scene].scene,
        described=lambda wildcards: repr(settings.scenes[wildcards.scene].scene),
        speeds=lambda wildcards: extreme_speeds(wildcards.blade, wildcards.scene),
        choice=lambda wildcards: asdict(settings.march_choice(wildcards.scene, settings.structure.maximum_speed_rad_s)),
        code=code("alignment.py", "lanes.py", "native.py", "contact/*.py", "march/*.py"),
    script:
        "../scripts/prepare_march.py"


rule simulate:
    input:
        prepared="results/{blade}/{scene}/march.stamp",
        model=contact_model_file,
    output:
        "results/{blade}/{scene}/speed_{speed}.npz",
    log:
        "logs/{blade}/{scene}/speed_{speed}.log",
    priority: blade_by_blade
    conda:
        ENVIRONMENT
    params:
        task=task_of_a_run,
        python=PYTHON,
        script=SCRIPTS / "simulate.py",
        code=code(
            "io.py",
            "alignment.py",
            "lanes.py",
            "native.py",
            "contact/*.py",
            "march/*.py",
            "rom/contact_model.py",
            "simulate.py",
        ),
    # not `script:`, whose preamble imports Snakemake into each of thousands of jobs
    shell:
        "{params.python} {params.script} {input.model} {wildcards.speed} {output} {log} {params.task:q}"


rule response:
    input:
        unpack(recovery_file),
        speeds=speed_files,
    output:
        "results/{blade}/{scene}/response.nc",
    log:
        "logs/{blade}/{scene}/response.log",
    priority: 5
    conda:
        ENVIRONMENT
    params:
        speeds=lambda wildcards: settings.speeds[wildcards.blade, wildcards.scene],
        stress=lambda wildcards: "stress" in settings.scenes[wildcards.scene].results,
        stress_history_speeds=lambda wildcards: settings.scenes[wildcards.scene].stress_history_speeds,
        stress_instants=settings.fidelity.march.stress_instants,
        material=lambda wildcards: asdict(settings.blades[wildcards.blade].material),
        provenance=sweep_provenance,
        code=code(
            "io.py",
            "fem/stress.py",
            "fem/wedge15.py",
            "results/netcdf.py",
            "results/response.py",
            "results/stress.py",
            "results/variables.py",
        ),
    script:
        "../scripts/response.py"
