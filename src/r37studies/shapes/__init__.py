"""Shapes: pictures of modes and of the worst instants of interactions, and the files that they are drawn from."""
