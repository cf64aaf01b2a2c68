"""Mesh one blade. Input: geometry.nc. Params: mesh (of the fidelity level). Outputs: mesh.msh, mesh.vtu."""

from job import run

from r37core.blade.geometry_file import read_geometry
from r37core.fem.mesh_quality import mesh_quality
from r37core.io import atomic_write
from r37core.mesh.generate import generate_mesh
from r37core.mesh.mesh_files import write_vtu


def main(snakemake):
    level = snakemake.params.mesh
    with atomic_write(snakemake.output.msh) as msh_file:
        mesh = generate_mesh(
            read_geometry(snakemake.input[0]), level["nodes"], level["layers"], level["tip_elements"], msh_file
        )
        quality = mesh_quality(mesh)
        print(f"{len(mesh.points)} nodes, {mesh.element_count} wedges")
        print(f"scaled Jacobian: minimum {quality.minimum:.3f}, 1% quantile {quality.one_percent_quantile:.3f}")
        quality.check(level["minimum_scaled_jacobian"])
    write_vtu(mesh, snakemake.output.vtu, quality.per_element)


run(snakemake, main)
