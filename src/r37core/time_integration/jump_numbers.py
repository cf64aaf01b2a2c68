"""Numbers that the plan of jumps over free flight and the steps that take them agree on."""

COARSE = 8
"""Steps between which a jump may begin; the casing's nearest position is kept for each such interval."""

STRIDES = 9
"""Lengths of jumps: what is left of a block after whole intervals, then intervals doubled up to 1024 steps."""

U_FROM_U, U_FROM_D, D_FROM_U, D_FROM_D, LOSS_UU, LOSS_UD, LOSS_DD, BEYOND = range(8)
"""Rows of the numbers of a jump: its map of displacement u and increment d less the identity, its loss as a quadratic form,
and how far a mode of unit amplitude gets beyond its tangent (fast modes: from zero)."""

NEVER = 2**60
"""More steps than there are: the length of a jump that is not to be had."""
