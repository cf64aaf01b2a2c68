"""What a whole sweep will cost: a sample of its runs, timed."""
