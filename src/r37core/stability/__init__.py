"""Extremes of the configuration: each is run with its own step and with half of it."""
