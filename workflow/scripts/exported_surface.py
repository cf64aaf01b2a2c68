"""Write a blade's surface. Input: geometry.nc. Output: STEP."""

from job import run

from r37core.blade.geometry_file import read_geometry
from r37core.exports.step import write_step


def main(snakemake):
    write_step(read_geometry(snakemake.input[0]), snakemake.output[0])


run(snakemake, main)
