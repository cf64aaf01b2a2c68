# Reduced model -> one simulation per blade, scene and speed -> all speeds of a blade and scene.


def speed_file(blade, scene, speed):
    return f"results/{blade}/{scene}/speed_{speed:.10g}.npz"


def speed_files(wildcards):
    """The simulations of one blade and scene, by ascending speed."""
    blade, scene = wildcards.blade, wildcards.scene
    return [speed_file(blade, scene, speed) for speed in settings.speeds[blade, scene]]


def sweep_provenance(wildcards):
    """What the results of one blade and scene say about their making."""
    chosen = settings.scenes[wildcards.scene]
    return structure_provenance(wildcards) | {
        "scene": wildcards.scene,
        "scene_parameters": repr(chosen.scene),
        "revolutions": chosen.revolutions,
        "largest_time_step": settings.fidelity["march"]["time_step_s"],
    }


rule contact_model:
    input:
        "results/{blade}/rom_{tip_line}.nc",
    output:
        "results/{blade}/contact_{tip_line}.npz",
    log:
        "logs/{blade}/contact_model_{tip_line}.log",
    conda:
        ENVIRONMENT
    params:
        code=code("io.py", "rom/reduced_model.py", "rom/contact_*.py"),
    script:
        "../scripts/contact_model.py"


rule warm_kernels:
    output:
        touch("results/kernels/{scene}.stamp"),
    log:
        "logs/warm_kernels_{scene}.log",
    priority: 20
    conda:
        ENVIRONMENT
    # alone: jobs that compile side by side could spoil numba's cache
    threads: workflow.cores
    params:
        # only what makes another version of the kernel, so that a changed number re-compiles nothing
        parts=lambda wildcards: settings.kernel_parts(wildcards.scene),
        code=code("contact/*.py", "march/*.py"),
    script:
        "../scripts/warm_kernels.py"


rule simulate:
    input:
        model=lambda wildcards: f"results/{wildcards.blade}/contact_{settings.scenes[wildcards.scene].tip_line}.npz",
        kernels="results/kernels/{scene}.stamp",
    output:
        "results/{blade}/{scene}/speed_{speed}.npz",
    log:
        "logs/{blade}/{scene}/speed_{speed}.log",
    conda:
        ENVIRONMENT
    params:
        scene=lambda wildcards: settings.scenes[wildcards.scene].scene,
        choice=lambda wildcards: asdict(settings.march_choice(wildcards.scene, float(wildcards.speed))),
        results=lambda wildcards: settings.scenes[wildcards.scene].results,
        kept={
            key: settings.fidelity["march"][key]
            for key in ("spectrum_highest_order", "signal_revolutions", "wear_angles")
        },
        provenance=sweep_provenance,
        code=code("io.py", "contact/*.py", "march/*.py", "rom/contact_model.py"),
    script:
        "../scripts/simulate.py"


rule response:
    input:
        rom=lambda wildcards: f"results/{wildcards.blade}/rom_{settings.scenes[wildcards.scene].tip_line}.nc",
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
        stress_instants=settings.fidelity["march"]["stress_instants"],
        material=lambda wildcards: asdict(settings.blades[wildcards.blade].material),
        provenance=sweep_provenance,
        code=code(
            "io.py",
            "fem/stress.py",
            "fem/wedge15.py",
            "results/response.py",
            "results/stress.py",
            "results/variables.py",
        ),
    script:
        "../scripts/response.py"
