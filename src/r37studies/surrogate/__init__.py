"""Surrogates of what designs give, and designs proposed by them: for a search and for a calibration."""
