"""What is raised and said about meshes and matrices from other programs."""


class ImportRefused(ValueError):
    """A mesh or a set of matrices that cannot be used; the message names the file, what was found and what helps."""


class MeshWarning(UserWarning):
    """Something in an imported mesh that works but that the user should know."""
