"""The range of what the members of a sample give, the same in all tables and datasets."""

ENDS = {"low": 0.05, "median": 0.5, "high": 0.95}
"""End of a column's name -> quantile of the members: nine tenths of them lie between the outer two."""
