"""Blade-tip rubbing: blade shape, finite elements, reduced model and post-processing, usable without Snakemake."""

__version__ = "0.3.0"
