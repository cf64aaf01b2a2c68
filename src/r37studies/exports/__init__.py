"""Results for other programs: mesh, surface, modes, worst stress, matrices."""
