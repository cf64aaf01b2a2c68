# The study `readings`: what the benchmark leaves open, and its published numbers beside ours.


rule reading:
    input:
        unpack(reading_model),
    output:
        "results/studies/readings/{reading}/{place}.nc",
    log:
        "logs/studies/readings/{reading}_{place}.log",
    wildcard_constraints:
        reading="|".join(READINGS),
        place=r"[A-Za-z0-9]+_[a-z0-9]+",
    conda:
        ENVIRONMENT
    params:
        reading=lambda wildcards: asdict(READINGS[wildcards.reading]),
        place=lambda wildcards: asdict(reading_place(wildcards)),
        entry=reading_entry,
        choice=lambda wildcards: study_choice(READING_SETTINGS.base),
        material=lambda wildcards: asdict(settings.blades[reading_place(wildcards).blade].material),
        code=code("contact/*.*", "march/*.*", "studies/readings.py"),
    script:
        "../scripts/reading.py"


rule reading_campbell:
    input:
        lambda wildcards: reading_structure(
            wildcards.blade, {} if wildcards.mesh == "level" else {"nodes": int(wildcards.mesh)}
        )["rom"],
    output:
        "results/studies/readings/campbell/{blade}_{mesh}.nc",
    log:
        "logs/studies/readings/campbell_{blade}_{mesh}.log",
    wildcard_constraints:
        mesh=r"level|\d+",
    conda:
        ENVIRONMENT
    params:
        campbell=plain(settings.campbell),
        maximum_speed=settings.structure.maximum_speed_rad_s,
        tip_line=settings.structure.boundary.tip_line,
        provenance=structure_provenance,
        code=code("io.py", "dataset_file.py", "rom/*.py", "results/campbell*.py"),
    script:
        "../scripts/campbell_of_blade.py"


rule readings:
    input:
        geometry="results/Ref/geometry.nc",
        campbells=[reading_campbell(blade, mesh) for blade, mesh in READING_CAMPBELLS],
        runs=[f"results/studies/readings/{reading}/{place}.nc" for reading, place in READING_RUNS],
    output:
        validation="results/studies/validation.md",
        readings="results/studies/readings.md",
        picture="results/studies/figures/readings.png",
        reference="results/studies/figures/validation_reference.png",
        blades="results/studies/figures/validation_blades.png",
        stress="results/studies/figures/validation_stress.png",
        histories="results/studies/figures/validation_histories.png",
        spectrum_lined="results/studies/figures/validation_spectrum_lined.png",
        spectrum_rigid="results/studies/figures/validation_spectrum_rigid.png",
    log:
        "logs/studies/readings.log",
    conda:
        ENVIRONMENT
    params:
        yield_stress=lambda wildcards: known("readings", "Ref", settings.blades).material.yield_stress,
        runs=READING_RUNS,
        campbells=READING_CAMPBELLS,
        meshes=READING_MESHES,
        code=code("studies/*.py", "figures/style.py", "figures/maps.py", "figures/readings.py", "figures/validation.py"),
    script:
        "../scripts/validation.py"
