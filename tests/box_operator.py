"""The stress in the paper's box, which is evaluated at all of its nodes."""

from r37core.stress.recovery import stress_operators


def box_operator(model, material):
    return stress_operators(model, material)["box"]
