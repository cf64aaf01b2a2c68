"""Single runs next to the sweep, in three presets: accuracy over cost, extremes, and a sample of the sweep for its cost."""
