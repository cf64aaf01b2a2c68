"""A blade with a massless boundary, the form in which NLstep takes one, and a run of an installed copy of it in GNU Octave.

NLstep (Krack and Gross; GPL) is another group's program for contact: its folder is named by the environment variable NLSTEP.
"""

import os
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from scipy.io import loadmat, savemat

from r37core.contact.casing import rise_rate

HERE = Path(__file__).resolve().parent


def massless_boundary(blade, kept):
    """Mass, damping and stiffness matrices of a blade (equations_of_motion.Blade) whose contact nodes have no mass.

    The lowest `kept` modes move, all others follow the contact forces statically: q_b = Phi_b q_i + F lambda with their
    residual flexibility F (MacNeal, Computers & Structures 1 (1971); Monjaraz-Tec, Gross and Krack, ibid. 260 (2022)). First
    the boundary: normal, tangential and meridional coordinate of each node; the normal one opens the gap.
    """
    boundary = boundary_rows(blade)
    moving, static = boundary[:, :kept], boundary[:, kept:]
    squares, count = blade.frequencies**2, len(boundary)
    stiff = np.linalg.inv((static / squares[kept:]) @ static.T)
    across = -stiff @ moving
    stiffness = np.block([[stiff, across], [across.T, np.diag(squares[:kept]) - moving.T @ across]])
    damping = 2.0 * blade.scene.damping_ratio * blade.frequencies[:kept]
    mass, damped = np.zeros_like(stiffness), np.zeros_like(stiffness)
    mass[count:, count:], damped[count:, count:] = np.eye(kept), np.diag(damping)
    return mass, damped, stiffness


def boundary_rows(blade):
    """Displacement of the boundary's coordinates, shape (3 nodes, modes)."""
    normal, tangential, meridional = np.split(blade.rows, 3)
    return np.stack([-normal, tangential, meridional], axis=1).reshape(-1, len(blade.frequencies))


def run_nlstep(blade, kept, steps_per_sample, samples_per_revolution, samples):
    """Normal displacement (m) of the contact nodes in NLstep, shape (nodes, samples).

    RuntimeError where it does not converge.
    """
    mass, damping, stiffness = massless_boundary(blade, kept)
    casing = blade.scene.casing
    step = 2.0 * np.pi / blade.speed / samples_per_revolution / steps_per_sample
    case = {
        "M": mass,
        "D": damping,
        "K": stiffness,
        "theta": blade.theta,
        "radius": blade.radius,
        "speed": blade.speed,
        "clearance": casing.clearance,
        "height": casing.lobe_height,
        "width": casing.width,
        "period": 2.0 * np.pi / casing.lobes,
        "rise_rate": rise_rate(casing.rise_fraction * blade.duration),
        "friction": blade.scene.friction.coefficient,
        "step": step,
        "steps": float(steps_per_sample * samples),
        "steps_per_sample": float(steps_per_sample),
    }
    with tempfile.TemporaryDirectory() as folder:
        case_file, out = Path(folder) / "case.mat", Path(folder) / "found.mat"
        savemat(case_file, case)
        program = Path(os.environ["NLSTEP"]).resolve()
        call = f"addpath('{HERE / 'nlstep'}'); run_nlstep('{program}', '{case_file}', '{out}')"
        # Octave 7 may fail while it ends, with all done, and leaves a file where it is
        run = subprocess.run(["octave-cli", "--norc", "--quiet", "--eval", call], cwd=folder, capture_output=True, text=True)
        if not out.exists():
            raise RuntimeError(run.stderr)
        results = loadmat(out)
    if results["not_converged"].item():
        raise RuntimeError(f"contact not solved in {results['not_converged'].item():.0f} of the steps kept")
    return -results["coordinates"][: 3 * blade.nodes : 3]
