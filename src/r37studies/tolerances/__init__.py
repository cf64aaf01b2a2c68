"""Tolerances: numbers that are never known exactly, and what their spread does to a blade that rubs."""
