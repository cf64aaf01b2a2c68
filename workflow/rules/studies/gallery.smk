# The gallery: our counterpart of every result figure of the paper, and what agrees. Not part of all_blades: snakemake gallery
from r37core.studies.gallery_plan import PAGE, Gallery, modes_file

in_gallery = Gallery(sweep)


rule gallery_run:
    input:
        unpack(sweep.recovery),
        model=sweep.contact_model,
        prepared=paths.INTEGRATION_STAMP,
        rms="<results>/rms.nc",
    output:
        paths.GALLERY_RUN,
    log:
        "<logs>/studies/gallery/{blade}__{scene}.log",
    conda:
        ENVIRONMENT
    params:
        scene=sweep.scene,
        described=sweep.described,
        choice=in_gallery.choice,
        lined=in_gallery.lined,
        material=structure.material,
        code=code("gallery_run"),
    script:
        "../../scripts/gallery_run.py"


rule gallery:
    input:
        unpack(in_gallery.inputs),
    output:
        page=PAGE,
        pictures=in_gallery.pictures,
    log:
        "<logs>/studies/gallery.log",
    conda:
        ENVIRONMENT
    params:
        scenes=in_gallery.scenes,
        runs=in_gallery.runs,
        submesh=in_gallery.submesh,
        yield_stress=in_gallery.yield_stress,
        fidelity=settings.fidelity_name,
        code=code("gallery"),
    script:
        "../../scripts/gallery.py"
