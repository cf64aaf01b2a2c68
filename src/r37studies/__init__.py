"""Studies: optional capabilities, one folder each. r37core finds them by the registry."""
