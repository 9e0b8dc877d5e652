"""Discrete Mesh Optimization: see how good the cells of a mesh are, and move its vertices so that the worst gets as good as it can.

    import dmoscope
    mesh = dmoscope.read("coast.14")
    better = dmoscope.smooth(mesh, until_converged=True)
    print(better.sentence, mesh.statistics()["minimum"], better.mesh.statistics()["minimum"])
    better.mesh.write("better.14")

Meshes of meshio and PyVista are taken wherever a mesh is, and smooth() gives the same kind back. Results have the bits of the program's.
"""

import copy
import operator
import os
import warnings
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Optional

import numpy as np

from . import _dmoscope
from ._dmoscope import Error, InputError, Iteration, OutputError, UsageError, __version__

__all__ = ["BoundaryLoop", "Error", "InputError", "Iteration", "Mesh", "Metric", "OutputError", "Smoothed", "Trace", "TraceLevel", "UsageError",
           "metrics", "read", "render", "smooth", "trace", "__version__"]

# Kinds in the order of the library's CellKind: meshio's name, VTK's number, corners.
_KINDS = (("triangle", 5, 3), ("quad", 9, 4), ("tetra", 10, 4), ("hexahedron", 12, 8), ("wedge", 13, 6), ("pyramid", 14, 5))
_MOST = 0xFFFFFFFF  # the greatest number that the library takes
_KIND_BY_NAME = {name: kind for kind, (name, _, _) in enumerate(_KINDS)}
_KIND_BY_VTK = {number: kind for kind, (_, number, _) in enumerate(_KINDS)}


@dataclass(frozen=True)
class BoundaryLoop:
    """A closed curve of the boundary. vertices: in order, with the mesh to the left. area: that it encloses; of a loop that is not planar, of its shadow where that is largest. part: parts[part] is what it bounds. outer: in a planar mesh, whether it goes around its part."""
    vertices: np.ndarray
    length: float
    area: float
    part: int
    outer: bool


def _points(points):
    """n x 3 doubles; of n x 2, z is 0."""
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise ValueError(f"points must be an array of n x 2 or n x 3, not {points.shape}")
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    return np.ascontiguousarray(points)


def _indices(array, what="cells"):
    array = np.asarray(array)
    if array.size and (array.dtype.kind not in "iu" or array.min() < 0 or array.max() > 0xFFFFFFFF):
        raise ValueError(f"{what} must be whole numbers from 0 on")
    return array.astype(np.uint32)


def _whole(name, value, most):
    """The whole number that an argument is."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be a whole number, not {value!r}") from None
    if number < 0:
        raise UsageError(f"{name} must be a whole number from 0 on, not {number}")
    return min(number, most)


def _numbers(data, things):
    """{"name": n numbers or n rows of them, ...}; (n, 1) is n."""
    arrays = {}
    for name, values in (data or {}).items():
        values = np.asarray(values)
        if not _are_numbers(values):
            raise ValueError(f"the data {name!r} must be one number of each of the {things}, or a row, not {values.dtype} of {values.shape}")
        arrays[str(name)] = _columns(values)
    return arrays


def _labels(groups, cells):
    """A number for each cell that tells which of the groups it belongs to."""
    belongs = np.zeros((cells, len(groups)), dtype=bool)
    for column, members in enumerate(groups):
        belongs[members, column] = True
    return np.unique(belongs, axis=0, return_inverse=True)[1].ravel()


def _cell_arrays(cells):
    """Kinds, offsets and connectivity of cells in meshio's form: {"triangle": m x 3, ...}, or a list of such pairs or blocks."""
    blocks = list(cells.items()) if isinstance(cells, dict) else [(b.type, b.data) if hasattr(b, "type") else b for b in cells]
    kinds, corners, connectivity = [], [], []
    for name, data in blocks:
        if name not in _KIND_BY_NAME:
            raise ValueError(f"cells of kind {name!r}: dmoscope has {', '.join(_KIND_BY_NAME)}")
        kind = _KIND_BY_NAME[name]
        data = np.asarray(data)
        if data.ndim != 2 or data.shape[1] != _KINDS[kind][2]:
            raise ValueError(f"cells of kind {name!r} must be an array of m x {_KINDS[kind][2]}, not {data.shape}")
        kinds.append(np.full(len(data), kind, dtype=np.uint8))
        corners.append(np.full(len(data), data.shape[1], dtype=np.int64))
        connectivity.append(_indices(data).ravel())
    if not kinds:
        raise ValueError("a mesh needs cells")
    offsets = np.concatenate([[0], np.cumsum(np.concatenate(corners))])
    return np.concatenate(kinds), _indices(offsets), np.concatenate(connectivity)


class Mesh:
    """A mesh of triangles and quadrilaterals, or of tetrahedra, hexahedra, wedges and pyramids. It does not change.

    points: n x 3 (or n x 2) numbers in mesh units. cells: {"triangle": m x 3 vertices from 0 on, "quad": ..., "tetra": ...,
    "hexahedron": ..., "wedge": ..., "pyramid": ...}, corners in VTK's order, or a list of such pairs.
    cell_data: {"material": m numbers, ...}. What lies between cells of different materials ("material", "region", "gmsh:physical" ...) stays.
    point_data: {"depth": n numbers, "wind": n x k, ...}.
    Raises InputError for a mesh that cannot be, ValueError for arrays of another form.
    """

    def __init__(self, points, cells, cell_data=None, point_data=None):
        self._mesh = _dmoscope.Mesh(_points(points), *_cell_arrays(cells), _numbers(cell_data, "cells"), _numbers(point_data, "points"))

    @classmethod
    def _of(cls, inner):
        mesh = cls.__new__(cls)
        mesh._mesh = inner
        return mesh

    @property
    def points(self) -> np.ndarray:
        """Where the vertices are: n x 3 doubles, mesh units; a view, without a copy, that cannot be written."""
        return self._mesh.points

    def _blocks(self):
        """(first, end) of the cells of one kind, one after the other."""
        kinds = self._mesh.kinds
        starts = np.concatenate([[0], np.flatnonzero(np.diff(kinds)) + 1, [len(kinds)]])
        return list(zip(starts[:-1], starts[1:]))

    @property
    def cells(self):
        """The cells as a list of (kind, m x corners array), in their order: a new pair wherever the kind changes."""
        kinds, offsets, connectivity = self._mesh.kinds, self._mesh.offsets, self._mesh.connectivity
        return [(_KINDS[kinds[a]][0], connectivity[offsets[a]:offsets[b]].reshape(b - a, -1)) for a, b in self._blocks()]

    @property
    def cell_data(self) -> Dict[str, np.ndarray]:
        """Numbers of the cells by name, m or m x k: what was given, or what the file held. Copies."""
        return self._mesh.cell_data

    @property
    def point_data(self) -> Dict[str, np.ndarray]:
        """Numbers of the points by name, n or n x k, likewise."""
        return self._mesh.point_data

    @property
    def cell_groups(self) -> Dict[str, np.ndarray]:
        """Cells that the file names: by name, their numbers."""
        return self._mesh.cell_groups

    @property
    def boundary_loops(self) -> List[BoundaryLoop]:
        """The closed curves of the boundary of a planar or surface mesh, as fix="loop:1" knows them; of a volume mesh none."""
        return [BoundaryLoop(*loop) for loop in self._mesh.boundary_loops]

    @property
    def parts(self) -> List[np.ndarray]:
        """Cells connected across edges, as fix="part:1" knows them; of a volume mesh none."""
        return self._mesh.parts

    def ring(self, vertex: int) -> np.ndarray:
        """The neighbours of a vertex across edges in order, counter-clockwise; on the boundary from edge to edge."""
        return self._mesh.ring(_whole("vertex", vertex, _MOST))

    @property
    def boundary(self) -> np.ndarray:
        """n booleans: vertices on the boundary."""
        return self._mesh.boundary.view(np.bool_)

    @property
    def in_degrees(self) -> bool:
        """Are x and y longitude and latitude, so that the mesh is judged and smoothed on the Earth? with_degrees() says so, or not."""
        return self._mesh.in_degrees

    def with_degrees(self, degrees: bool = True) -> "Mesh":
        """The mesh with x and y taken for longitude and latitude in degrees, or as they stand. Raises InputError for what cannot be degrees."""
        return Mesh._of(self._mesh.with_degrees(bool(degrees)))

    @property
    def thin(self) -> bool:
        """Is it a mesh of hexahedra and wedges one cell thick, judged and smoothed as the 2-D mesh of its front? with_thin() says so, or not."""
        return self._mesh.thin

    def with_thin(self, thin: bool = True) -> "Mesh":
        """The mesh taken for the 2-D mesh of its front, which the back follows, or with its cells counting. Raises InputError for what is not one cell thick."""
        return Mesh._of(self._mesh.with_thin(bool(thin)))

    @property
    def is_volume(self) -> bool:
        return self._mesh.is_volume

    @property
    def is_surface(self) -> bool:
        """Planar cells that lie in no plane."""
        return self._mesh.is_surface

    def quality(self, metric: str = "mean-ratio", threads: int = 0) -> np.ndarray:
        """Of each cell: 1 is ideal, 0 or less inverted; NaN where the metric is not defined for the kind. See metrics()."""
        return _dmoscope.quality(self._mesh, metric, _whole("threads", threads, _MOST))

    def statistics(self, metric: str = "mean-ratio", threads: int = 0) -> Dict[str, Any]:
        """minimum, mean, movable_minimum (of cells with a corner off the boundary), inverted (how many), worst_cell."""
        return _dmoscope.statistics(self._mesh, metric, _whole("threads", threads, _MOST))

    def with_points(self, points) -> "Mesh":
        """The same cells with the vertices elsewhere: n x 3, copied."""
        return Mesh._of(self._mesh.with_points(_points(points)))

    def with_materials(self, names) -> "Mesh":
        """The same mesh, in which the cell data of this name (or these names) name materials; (): those of known names alone."""
        return Mesh._of(self._mesh.with_materials([names] if isinstance(names, str) else list(names)))

    def write(self, path) -> None:
        """Writes a file by its extension, whole or not at all. What the format cannot carry is a warning."""
        for sentence in self._mesh.write(os.fspath(path)):
            warnings.warn(f"{path}: {sentence}", stacklevel=2)

    def to_meshio(self):
        """A meshio.Mesh, with the data of points and cells, and the groups of cells as its cell_sets."""
        import meshio

        blocks = self._blocks()
        return meshio.Mesh(np.array(self.points), [(kind, _in_meshio_order(kind, data).astype(np.int64)) for kind, data in self.cells],
                           point_data=self.point_data, cell_data={name: [values[a:b] for a, b in blocks] for name, values in self.cell_data.items()},
                           cell_sets={name: [cells[(cells >= a) & (cells < b)].astype(np.int64) - a for a, b in blocks]
                                      for name, cells in self.cell_groups.items()})

    def to_pyvista(self):
        """A pyvista.UnstructuredGrid, with the data of points and cells; "group" tells cells of different groups apart."""
        import pyvista

        kinds = self._mesh.kinds
        offsets = self._mesh.offsets.astype(np.int64)
        counts = np.diff(offsets)
        cells = np.insert(self._mesh.connectivity.astype(np.int64), offsets[:-1], counts)
        types = np.array([number for _, number, _ in _KINDS], dtype=np.uint8)[kinds]
        grid = pyvista.UnstructuredGrid(cells, types, np.array(self.points))
        groups = list(self.cell_groups.values())
        for name, values in {**({"group": _labels(groups, len(counts))} if groups else {}), **self.cell_data}.items():
            grid.cell_data[name] = values
        for name, values in self.point_data.items():
            grid.point_data[name] = values
        return grid

    def __copy__(self):
        return self

    def __deepcopy__(self, memo):
        return self

    def __reduce__(self):
        return (_from_bytes, (self._mesh.to_bytes(),))

    def __repr__(self):
        counts = np.bincount(self._mesh.kinds, minlength=len(_KINDS))
        cells = ", ".join(f"{count} {_KINDS[kind][0]}" for kind, count in enumerate(counts) if count)
        return f"<dmoscope.Mesh: {len(self.points)} points, {cells}>"


def _from_bytes(data) -> Mesh:
    return Mesh._of(_dmoscope.Mesh.from_bytes(data))


def _in_meshio_order(kind, cells):
    """From VTK's order to meshio's or back: they differ for wedges, as Gmsh's does."""
    cells = np.asarray(cells)
    return cells[:, [0, 2, 1, 3, 5, 4]] if kind == "wedge" else cells


def _is_pyvista(mesh):
    return all(hasattr(mesh, name) for name in ("points", "celltypes", "cell_connectivity", "offset"))


def _is_meshio(mesh):
    return all(hasattr(mesh, name) for name in ("points", "cells", "point_data", "cell_data"))


_POINTS_AND_LINES = {"vertex", "line", "line3"}
_VTK_POINTS_AND_LINES = {1, 2, 3, 4, 21}
_PLANAR = {"triangle", "quad"}


def _columns(values):
    """(n, 1) as n, which legacy VTK's scalars are to meshio."""
    values = np.asarray(values)
    return values[:, 0] if values.ndim == 2 and values.shape[1] == 1 else values


def _are_numbers(values):
    return values.ndim in (1, 2) and 0 not in values.shape and values.dtype.kind in "iufb"


def _point_data(mesh):
    data = {str(name): _columns(values) for name, values in dict(getattr(mesh, "point_data", {})).items()}
    return {name: values for name, values in data.items() if _are_numbers(values)}


def _from_meshio(mesh) -> Mesh:
    """Points and lines are left out, and faces where there are solids: they mark boundaries. Data go along, and sets of cells as a number."""
    blocks = [(b.type, b.data) if hasattr(b, "type") else tuple(b) for b in mesh.cells]
    solid = any(kind in _KIND_BY_NAME and kind not in _PLANAR for kind, _ in blocks)
    kept = [i for i, (kind, _) in enumerate(blocks) if kind not in _POINTS_AND_LINES and not (solid and kind in _PLANAR)]
    counts = [len(blocks[i][1]) for i in kept]
    data = {}
    # Gmsh's own sets name entities and no cells.
    sets = [[parts[i] for i in kept] for name, parts in getattr(mesh, "cell_sets", {}).items() if not name.startswith("gmsh:")]
    if sets:
        starts = np.cumsum([0] + counts)
        data["group"] = _labels([np.concatenate([np.zeros(0, dtype=np.int64)] + [np.asarray(part, dtype=np.int64) + start
                                                 for part, start in zip(parts, starts) if part is not None]) for parts in sets], starts[-1])
    for name, parts in mesh.cell_data.items():
        parts = [_columns(parts[i]) for i in kept]
        if parts and all(_are_numbers(part) and part.shape[1:] == parts[0].shape[1:] for part in parts):
            data[name] = np.concatenate(parts)
    return Mesh(mesh.points, [(blocks[i][0], _in_meshio_order(*blocks[i])) for i in kept], data, _point_data(mesh))


def _from_pyvista(grid) -> Mesh:
    """Likewise."""
    types, offsets, corners = np.asarray(grid.celltypes), np.asarray(grid.offset), np.asarray(grid.cell_connectivity)
    left_out = np.isin(types, list(_VTK_POINTS_AND_LINES))
    if np.isin(types, [10, 12, 13, 14]).any():
        left_out |= np.isin(types, [5, 9])
    unknown = sorted(set(np.unique(types[~left_out]).tolist()) - set(_KIND_BY_VTK))
    if unknown:
        raise ValueError(f"cells of VTK's kind {unknown[0]}: dmoscope has {', '.join(_KIND_BY_NAME)}")
    table = np.zeros(256, dtype=np.uint8)
    for number, kind in _KIND_BY_VTK.items():
        table[number] = kind
    counts = np.diff(offsets)
    connectivity = corners[np.repeat(~left_out, counts)]
    data = {}
    for name, values in dict(getattr(grid, "cell_data", {})).items():
        values = _columns(values)
        if _are_numbers(values):
            data[str(name)] = values[~left_out]
    ends = np.concatenate([[0], np.cumsum(counts[~left_out])])
    return Mesh._of(_dmoscope.Mesh(_points(grid.points), table[types[~left_out]], _indices(ends), _indices(connectivity), data,
                                   _point_data(grid)))


def _mesh_of(mesh) -> Mesh:
    if isinstance(mesh, Mesh):
        return mesh
    if _is_pyvista(mesh):  # tested first: a PyVista mesh has most attributes of a meshio one
        return _from_pyvista(mesh)
    if _is_meshio(mesh):
        return _from_meshio(mesh)
    raise TypeError(f"{type(mesh).__name__} is no mesh: dmoscope takes its own, meshio's and PyVista's unstructured grids")


def _given_back(original, mesh: Mesh):
    """The mesh as the kind that the original is, with the original's data, but for point data that belong to places."""
    if isinstance(original, Mesh):
        return mesh
    given = original.copy() if hasattr(original, "copy") else copy.deepcopy(original)
    given.points = np.array(mesh.points[:, : np.shape(original.points)[1]])
    for name, values in mesh.point_data.items():
        if name not in given.point_data:
            continue
        before = np.asarray(given.point_data[name])
        if not np.array_equal(_columns(before), values, equal_nan=before.dtype.kind == "f"):
            given.point_data[name] = values.reshape(before.shape).astype(before.dtype)
    return given


def read(path) -> Mesh:
    """Reads a mesh of any format that the program reads, such as .14, .msh, .su2, .vtk, .vtu, .mesh, .off. Raises InputError."""
    return Mesh._of(_dmoscope.Mesh.read(os.fspath(path)))


@dataclass(frozen=True)
class Metric:
    """A metric: 1 for the ideal cell, 0 or less for one that is inverted."""

    name: str
    title: str
    lowest: float
    highest: float
    formula: str
    doc: str


def metrics() -> Dict[str, Metric]:
    """All metrics by their names."""
    return {name: Metric(name, *rest) for name, rest in _dmoscope.metrics().items()}


@dataclass
class Smoothed:
    """What smooth() gives back."""

    mesh: Any  # mesh of the class that was given
    history: Dict[str, np.ndarray] = field(repr=False)  # by iteration, 0 the input: iteration, minimum, mean, movable_minimum, inverted, moved, seconds
    iteration: int  # number of the iteration whose end is `mesh`
    converged: bool
    cancelled: bool  # by the callback or Ctrl+C; `mesh` is the result until then
    sentence: str  # reason for the end
    warnings: List[str] = field(repr=False)
    fields: str = field(default="", repr=False)  # changes of the point data


def _options(iterations, until_converged, threads, fixed, points, words):
    if fixed is None:
        fixed = []
    else:
        fixed = np.asarray(fixed)
        if fixed.dtype == np.bool_:
            if fixed.shape != (points,):
                raise ValueError(f"fixed must be {points} booleans or numbers of vertices, not an array of {fixed.shape}")
            fixed = np.flatnonzero(fixed)
        fixed = _indices(fixed, "fixed").tolist()
    as_text = {True: "on", False: "off"}
    words = {name.replace("_", "-"): as_text[value] if isinstance(value, bool) else str(value) for name, value in words.items() if value is not None}
    iterations = None if iterations is None else _whole("iterations", iterations, 2**64 - 1)
    return _dmoscope.Options(iterations, until_converged, _whole("threads", threads, _MOST), fixed, words)


def smooth(mesh, iterations: Optional[int] = None, *, until_converged: bool = False, metric: Optional[str] = None, fixed=None,
           callback: Optional[Callable[[Iteration], Optional[bool]]] = None, threads: int = 0, raise_on_interrupt: bool = False,
           **options) -> Smoothed:
    """Moves vertices so that the worst cell becomes as good as it can. Cells and boundary stay.

    mesh: a Mesh, or one of meshio or PyVista. iterations: 20 unless given; a recipe goes on until it has converged. fixed: vertices that stay besides the boundary, as n booleans or as numbers.
    callback(iteration): after each one, on this thread, with number, minimum, mean, movable_minimum, inverted, moved, seconds; False ends the run.
    options: the long options of `dmoscope smooth`: method="joint", boundary="slide", then="mean", combine="mean-ratio:0.7:min-angle" ...
    Ctrl+C ends the run, too: what there is then is given back, with a warning; with raise_on_interrupt KeyboardInterrupt is raised instead.
    The result does not depend on the number of threads.
    Raises UsageError (a ValueError) for what does not fit the mesh.
    """
    if iterations is not None and until_converged:
        raise UsageError("iterations and until_converged: only one of them")
    prepared = _mesh_of(mesh)
    asked = _options(iterations, until_converged, threads, fixed, len(prepared.points), {"metric": metric, **options})
    inner, history, iteration, converged, cancelled, interrupted, sentence, told, fields = _dmoscope.smooth(prepared._mesh, asked, callback)
    if interrupted and raise_on_interrupt:
        raise KeyboardInterrupt
    if interrupted:
        warnings.warn(f"interrupted after iteration {iteration}; the mesh is what there was then", RuntimeWarning, stacklevel=2)
    return Smoothed(_given_back(mesh, Mesh._of(inner)), history, iteration, converged, cancelled, sentence, told, fields)


@dataclass
class TraceLevel:
    """A level of the search, from coarse to fine. p candidates per axis, d = 2 axes in a plane and 3 in space."""

    candidates: np.ndarray = field(repr=False)  # p x p (x p) x 3: places, mesh units
    values: np.ndarray = field(repr=False)  # p x p (x p): the numbers that the search compared; more is better
    quality: np.ndarray = field(repr=False)  # p x p (x p): quality of the worst cell of the star with the vertex there
    best: Optional[int]  # the chosen candidate, an index into values.ravel(); None: none is better than the one found before


@dataclass
class Trace:
    """What trace() gives back."""

    start: np.ndarray  # place before: 3 coordinates, mesh units
    end: np.ndarray  # place after: 3 coordinates, mesh units
    before: float  # quality of the worst cell of its star
    after: float
    levels: List[TraceLevel] = field(repr=False)
    value: str  # name of the number in `values`
    sentence: str


def trace(mesh, vertex: int, *, metric: Optional[str] = None, fixed=None, **options) -> Trace:
    """What the first visit of dmo would do to a vertex: all candidates that the search looks at. Options as in smooth()."""
    prepared = _mesh_of(mesh)
    asked = _options(0, False, 1, fixed, len(prepared.points), {"metric": metric, **options})
    found = _dmoscope.trace(prepared._mesh, _whole("vertex", vertex, _MOST), asked)
    found["levels"] = [TraceLevel(**level) for level in found["levels"]]
    return Trace(**found)


def render(mesh, size=(1280, 800), *, metric: str = "mean-ratio", range=None, colormap: str = "beacon", transparent: bool = False,
           edges: bool = True, colour_bar: bool = True, clip: str = "", clip_mode: str = "crinkle", view: str = "iso") -> np.ndarray:
    """A picture of the mesh coloured by quality, inverted cells magenta: height x width x 4 bytes (red, green, blue, opacity).

    size: (width, height) in pixels. range: (low, high), the qualities at the ends of the colours; None: the mesh's own, rounded outwards.
    Of volumes also: clip ("x", "-y:0.3", "NX,NY,NZ:OFFSET"), clip_mode ("crinkle" or "cut"), view ("iso", "+x", "-z" ...).
    Needs OpenGL (EGL), but no screen; raises RuntimeError where there is none.
    """
    try:
        from . import _render
    except ImportError as missing:
        raise RuntimeError("pictures need the package python3-dmoscope-render, and OpenGL's libraries") from missing
    inner = _mesh_of(mesh)._mesh
    return _render.render(inner.points, inner.kinds, inner.offsets, inner.connectivity, metric, tuple(size), colormap, range, transparent,
                          edges, colour_bar, clip, clip_mode, view)
