"""Discrete Mesh Optimization: see how good the cells of a mesh are, and move its vertices so that the worst gets as good as it can.

    import dmoscope
    mesh = dmoscope.read("coast.14")
    better = dmoscope.smooth(mesh, until_converged=True)
    print(better.sentence, mesh.statistics()["minimum"], better.mesh.statistics()["minimum"])
    better.mesh.write("better.14")

Meshes of meshio and PyVista are taken wherever a mesh is, and smooth() gives the same kind back. Results have the bits of the program's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _dmoscope
from ._dmoscope import Error, InputError, Iteration, OutputError, UsageError, __version__
from ._mesh import BoundaryLoop, Group, Mesh, _from_bytes, mesh_of, read
from ._smooth import Held, Smoothed, Trace, TraceLevel, smooth, trace

__all__ = ["BoundaryLoop", "Error", "Group", "Held", "InputError", "Iteration", "Mesh", "Metric", "OutputError", "Smoothed", "Trace", "TraceLevel",
           "UsageError", "metrics", "read", "render", "smooth", "trace", "__version__"]


@dataclass(frozen=True)
class Metric:
    """A metric: 1 for the ideal cell, 0 or less for one that is inverted."""

    name: str  # name to pass to functions: "mean-ratio"
    title: str  # title for people: "Mean ratio"
    lowest: float  # least value
    highest: float  # greatest value
    formula: str  # plain text
    doc: str  # one line: its meaning and its source


def metrics() -> Dict[str, Metric]:
    """All metrics by their names."""
    return {name: Metric(name, *rest) for name, rest in _dmoscope.metrics().items()}


def render(mesh: Any, size: Tuple[int, int] = (1280, 800), *, metric: str = "mean-ratio", range: Optional[Tuple[float, float]] = None,
           colormap: str = "beacon", transparent: bool = False, edges: bool = True, colour_bar: bool = True, clip: str = "",
           clip_mode: str = "crinkle", view: str = "iso") -> npt.NDArray[np.uint8]:
    """Draw the mesh coloured by quality, inverted cells magenta.

    Parameters
    ----------
    mesh : Mesh, meshio.Mesh or pyvista.UnstructuredGrid
    size : (int, int), default (1280, 800)
        Width and height, pixels.
    metric : str, default "mean-ratio"
        Metric of the colours: a name of metrics(), or a formula.
    range : (float, float), optional
        Qualities at the ends of the colours. Default: the mesh's own, rounded outwards.
    colormap : str, default "beacon"
        Name of the colours; an error lists them.
    transparent : bool, default False
        Leave the background without colour.
    edges, colour_bar : bool, default True
        Draw the edges of cells, and the colour bar.
    clip : str, default ""
        Plane that cuts a volume open: "x", "-y:0.3", "NX,NY,NZ:OFFSET".
    clip_mode : {"crinkle", "cut"}, default "crinkle"
        Leave whole cells, or cut them.
    view : str, default "iso"
        Direction of a look at a volume: "iso", "+x", "-z" ...

    Returns
    -------
    numpy.ndarray
        Height x width x 4 bytes: red, green, blue, opacity.

    Raises
    ------
    RuntimeError
        Where there is no OpenGL (EGL). No screen is needed.
    """
    try:
        from . import _render
    except ImportError as missing:
        raise RuntimeError("pictures need the package python3-dmoscope-render, and OpenGL's libraries") from missing
    inner = mesh_of(mesh)._mesh
    width, height = size
    return _render.render(inner.points, inner.kinds, inner.offsets, inner.connectivity, metric, (width, height), colormap, range, transparent,
                          edges, colour_bar, clip, clip_mode, view)
