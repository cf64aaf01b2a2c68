"""A search over designs: in rounds, each of a batch that is proposed from all results so far."""
