"""Steps of the workflow (docs/architecture.md): a blade's mesh."""

from typing import Any

import numpy as np

from r37core.base.io import JOB_LOG, atomic_write
from r37core.base.plain import from_plain
from r37core.blade.geometry_file import read_geometry
from r37core.mesh.disc import Disc
from r37core.mesh.generate import generate_mesh
from r37core.mesh.mesh_files import write_vtu

from .disc_mesh import mesh_disc
from .mesh_quality import check_quality, mesh_quality


def mesh(input: Any, output: Any, params: Any) -> None:
    """Mesh a blade, and a sector of the disc under it. Input: geometry. Outputs: msh, of the blade alone, vtu.

    Params: mesh, of the fidelity level; disc, or None; locations (of the keys). Raises ValueError for poor quality.
    """
    level = params.mesh
    with atomic_write(output.msh) as msh_file:
        made = generate_mesh(read_geometry(input.geometry), level["nodes"], level["layers"], level["tip_elements"], msh_file)
        if params.disc:
            made = mesh_disc(made, from_plain(Disc, params.disc), params.locations["disc"])
        quality = mesh_quality(made)
        JOB_LOG.debug(f"{len(made.points)} nodes, {len(quality)} wedges")
        JOB_LOG.debug(f"scaled Jacobian: minimum {np.min(quality):.3f}, 1% quantile {np.quantile(quality, 0.01):.3f}")
        check_quality(made, quality, level["minimum_scaled_jacobian"])
    write_vtu(made, output.vtu, quality)
