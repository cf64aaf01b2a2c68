# The study `readings`: what the benchmark leaves open, and its published numbers beside ours.
from r37core.studies.reading_list import READINGS
from r37core.studies.readings_plan import Readings

readings = Readings(settings)


rule reading:
    input:
        unpack(readings.model),
    output:
        paths.READING,
    log:
        "<logs>/studies/readings/{reading}_{place}.log",
    wildcard_constraints:
        reading="|".join(READINGS),
        place=r"[A-Za-z0-9]+_[a-z0-9]+",
    conda:
        ENVIRONMENT
    params:
        reading=readings.reading,
        place=readings.place,
        scene=readings.scene,
        described=readings.described,
        choice=readings.choice,
        material=readings.material,
        code=code("reading"),
    script:
        "../../scripts/reading.py"


rule reading_campbell:
    input:
        readings.campbell_model,
    output:
        paths.READING_CAMPBELL,
    log:
        "<logs>/studies/readings/campbell_{blade}_{mesh}.log",
    wildcard_constraints:
        mesh=r"level|\d+",
    conda:
        ENVIRONMENT
    params:
        campbell=si_fields(settings.campbell),
        maximum_speed=settings.structure.maximum_speed_rad_s,
        tip_line=settings.structure.boundary.tip_line,
        provenance=made.structure,
        code=code("campbell_of_blade"),
    script:
        "../../scripts/campbell_of_blade.py"


rule readings:
    input:
        geometry="<results>/Ref/geometry.nc",
        campbells=readings.campbell_files,
        runs=readings.run_files,
    output:
        validation="<results>/studies/validation.md",
        readings="<results>/studies/readings.md",
        picture="<results>/studies/figures/readings.png",
        reference="<results>/studies/figures/validation_reference.png",
        blades="<results>/studies/figures/validation_blades.png",
        stress="<results>/studies/figures/validation_stress.png",
        histories="<results>/studies/figures/validation_histories.png",
        spectrum_lined="<results>/studies/figures/validation_spectrum_lined.png",
        spectrum_direct="<results>/studies/figures/validation_spectrum_direct.png",
    log:
        "<logs>/studies/readings.log",
    conda:
        ENVIRONMENT
    params:
        yield_stress=readings.yield_stress,
        runs=readings.runs,
        campbells=readings.campbells,
        code=code("validation"),
    script:
        "../../scripts/validation.py"
