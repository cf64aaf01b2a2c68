"""boundary.csv next to a blade's matrices: the nodes at the tip, and the rows of the matrices that they have."""

COLUMNS = ("x", "y", "z", "dof_x", "dof_y", "dof_z")
TIP_LENGTH = "tip_length"  # a column that may follow, of patches
