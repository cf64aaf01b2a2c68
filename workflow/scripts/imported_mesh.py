"""Import the mesh of another program. Input: mesh file. Params: source, places. Outputs: mesh.msh, mesh.vtu."""

import sys

from job import run, warnings_told

from r37core.exchange.importing.import_mesh import import_mesh, told_size
from r37core.exchange.importing.source import MeshSource
from r37core.exchange.refusal import placed
from r37core.exchange.write_mesh import write_mesh
from r37core.mesh.mesh_files import write_vtu
from r37core.plain import from_plain


def main(snakemake):
    params = snakemake.params
    with placed(params.places), warnings_told(params.places["mesh"]):
        mesh, quality = import_mesh(from_plain(MeshSource, params.source), params.folder["folder"])
    print(f"{len(mesh.points)} nodes, " + ", ".join(f"{len(nodes)} {name}" for name, nodes in mesh.blocks.items()))
    print(f"root: {len(mesh.node_set('root'))} nodes, tip: {len(mesh.node_set('tip'))} nodes")
    # what shows a wrong unit
    print(size := f"{params.places['mesh']}: {told_size(mesh)}")
    print(size, file=sys.__stderr__)
    print(f"scaled Jacobian: minimum {quality.min():.3f}")
    write_mesh(mesh, snakemake.output.msh)
    write_vtu(mesh, snakemake.output.vtu, quality)


run(snakemake, main)
