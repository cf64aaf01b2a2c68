"""Measurements beside the simulation, and numbers that nobody knows fitted to them."""
