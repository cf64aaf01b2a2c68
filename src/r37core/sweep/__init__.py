"""Driver of runs: the speeds of one blade in one scene, adaptive rounds included, by whoever needs them."""
