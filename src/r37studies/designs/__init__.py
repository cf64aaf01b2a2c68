"""Families of designs compared: what each is, and how robust."""
