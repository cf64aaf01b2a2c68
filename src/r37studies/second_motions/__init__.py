"""Motions that a start from rest does not show: sweeps up and down, how long motions last, and periodic ones."""
