"""Runs of one blade next to the sweep, each with a model, scene or time integration of its own, and what they cost."""
