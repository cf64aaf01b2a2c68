"""Cost of a whole sweep: a sample of its runs, timed."""
