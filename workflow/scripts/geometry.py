"""Build one blade. Params: definition, edges. Output: geometry.nc."""

from job import run

from r37core.blade.definition import BladeDefinition
from r37core.blade.geometry_file import write_geometry
from r37core.plain import from_plain


def main(snakemake):
    definition = from_plain(BladeDefinition, snakemake.params.definition)
    blade = definition.build(round_edges=snakemake.params.edges == "round")
    write_geometry(blade, snakemake.output[0], snakemake.params.provenance)


run(snakemake, main)
