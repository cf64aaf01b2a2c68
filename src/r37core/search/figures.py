"""stub"""

import matplotlib.pyplot as plt


def draw_designs(search):
    return plt.figure()


def draw_slices(search):
    return plt.figure()
