"""Build one blade. Params: definition, edges. Output: geometry.nc."""

from job import run

from r37core.blade.geometry_file import write_geometry


def main(snakemake):
    blade = snakemake.params.definition.build(round_edges=snakemake.params.edges == "round")
    write_geometry(blade, snakemake.output[0], snakemake.params.provenance)


run(snakemake, main)
