# Density of the mesh, meshes of another program, and elements of other libraries (docs/structure.md, docs/your_blade.md).
REMESHED = ("Ref", "S50", "CS100")


use rule evidence as mesh_density with:
    output:
        table=f"{TABLES}/mesh_density.csv",
    log:
        "logs/validation/mesh_density.log",
    params:
        **evidence("meshes.density"),


use rule evidence as remeshed_blade with:
    input:
        unpack(behind_engine()),
    output:
        "results/validation/remeshed/{blade}.json",
    log:
        "logs/validation/remeshed_{blade}.log",
    params:
        **evidence("meshes.of_blade"),
        blade=lambda wildcards: wildcards.blade,


use rule evidence as remeshed with:
    input:
        unpack(behind_engine(*[f"results/validation/remeshed/{blade}.json" for blade in REMESHED])),
    output:
        table=f"{TABLES}/remeshed.csv",
    log:
        "logs/validation/remeshed.log",
    params:
        **evidence("meshes.remeshed"),


# needs two libraries: pip install scikit-fem felupe
use rule evidence as element_libraries with:
    output:
        table=f"{TABLES}/element_libraries.csv",
    log:
        "logs/validation/element_libraries.log",
    params:
        **evidence("element_libraries.table"),
