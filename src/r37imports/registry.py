"""Additions of r37imports to r37core, by dotted names (r37core.base.packages)."""

BLADE_ENTRIES = {
    "mesh": "r37imports.imported_entry.MeshEntry",
    "matrices": "r37imports.imported_entry.MatricesEntry",
    "sections": "r37imports.sections_entry.SectionsEntry",
}
"""Key of an entry of blades.yaml -> its model, a BladeKind."""

SHAPES = {"sections": "r37imports.sections.definition.SectionsDefinition"}
"""Field of a plain definition -> class of that Shape."""

GEOMETRIES = {"section_point": "r37imports.sections.section_blade.section_blade"}
"""Variable of geometry.nc -> function that reads the blade from its dataset."""

STAGES = {"imports": "r37imports.stages.import_stages"}
"""Function of a Structure, which gives further stages."""

RULES = {"imports": "imports/blades.smk"}
"""File in workflow/rules."""
