"""Density of the mesh (docs/structure.md)."""

from evidence.plan import Item, table

# the numbers are those of the shipped configuration
SOURCES = ["config/blades.yaml", "config/config.yaml", "config/fidelity.yaml", "config/scenes.yaml"]

EVIDENCE = [
    # the model of the finest mesh takes 3 GB
    Item("evidence.meshes.density", {"table": table("mesh_density")}, sources=SOURCES, memory_mb=3600)
]
