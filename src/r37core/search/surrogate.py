"""stub"""

from types import SimpleNamespace

import numpy as np


def slices(variables, evaluated, at, points):
    v = np.array([np.linspace(x.lowest, x.highest, points) for x in variables])
    n = len(evaluated[0].objectives)
    return SimpleNamespace(
        values=v, mean=np.zeros((n, len(variables), points)), deviation=np.zeros((n, len(variables), points))
    )


def sensitivity(variables, evaluated, seed):
    n = len(evaluated[0].objectives)
    z = np.zeros((n, len(variables)))
    return SimpleNamespace(first=z, total=z, q2=np.zeros(n))
