"""Blades of other programs: meshes, sections and matrices. r37core finds them by the registry."""
