"""Meshes, and those of meshio and PyVista as such."""

from __future__ import annotations

import copy
import importlib
import operator
import os
import warnings
from dataclasses import dataclass
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _dmoscope
from ._dmoscope import UsageError

Array = npt.NDArray[Any]

# Kinds in the order of the library's CellKind: meshio's name, VTK's number, corners.
_KINDS = (("triangle", 5, 3), ("quad", 9, 4), ("tetra", 10, 4), ("hexahedron", 12, 8), ("wedge", 13, 6), ("pyramid", 14, 5))
MOST = 0xFFFFFFFF  # the greatest number that the library takes
_KIND_BY_NAME = {name: kind for kind, (name, _, _) in enumerate(_KINDS)}
_KIND_BY_VTK = {number: kind for kind, (_, number, _) in enumerate(_KINDS)}


@dataclass(frozen=True)
class BoundaryLoop:
    """A closed curve of the boundary of a planar or surface mesh."""

    vertices: Array  # in order, with the mesh to the left
    length: float  # mesh units
    area: float  # enclosed, square mesh units; of a loop that is not planar: the largest area of its projections
    part: int  # the part that it bounds: parts[part]
    outer: bool  # in a planar mesh: whether it goes around its part


@dataclass(frozen=True)
class Group:
    """Points, lines, faces or cells that a file names."""

    name: str
    kind: str  # the file's own word: "physical group", "marker", "land boundary"
    members: str  # "points", "lines", "faces" (of a volume mesh) or "cells"
    number: Optional[int]  # number that the file gives the group
    cells: Array  # the cells of a group of cells
    vertices: Array  # all vertices of the group, ascending


def _points(points: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """n x 3 doubles; of n x 2, z is 0."""
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise ValueError(f"points must be an array of n x 2 or n x 3, not {points.shape}")
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    return np.ascontiguousarray(points)


def indices(array: npt.ArrayLike, what: str = "cells") -> npt.NDArray[np.uint32]:
    array = np.asarray(array)
    if array.size and (array.dtype.kind not in "iu" or array.min() < 0 or array.max() > 0xFFFFFFFF):
        raise ValueError(f"{what} must be whole numbers from 0 on")
    return array.astype(np.uint32)


def whole(name: str, value: Any) -> int:
    """The whole number that an argument is."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be a whole number, not {value!r}") from None
    if number < 0:
        raise UsageError(f"{name} must be a whole number from 0 on, not {number}")
    return number


def _numbers(data: Optional[Mapping[str, npt.ArrayLike]], things: str) -> Dict[str, Array]:
    """{"name": n numbers or n rows of them, ...}; (n, 1) is n."""
    arrays: Dict[str, Array] = {}
    for name, values in (data or {}).items():
        values = np.asarray(values)
        if not _are_numbers(values):
            raise ValueError(f"the data {name!r} must be one number of each of the {things}, or a row, not {values.dtype} of {values.shape}")
        arrays[str(name)] = _columns(values)
    return arrays


def _labels(groups: Sequence[Array], cells: int) -> Array:
    """A number for each cell that tells which of the groups it belongs to."""
    belongs = np.zeros((cells, len(groups)), dtype=bool)
    for column, members in enumerate(groups):
        belongs[members, column] = True
    labels: Array = np.unique(belongs, axis=0, return_inverse=True)[1].ravel()
    return labels


def _cell_arrays(cells: Any) -> Tuple[Array, Array, Array]:
    """Kinds, offsets and connectivity of cells in meshio's form: {"triangle": m x 3, ...}, or a list of such pairs or blocks."""
    blocks = list(cells.items()) if isinstance(cells, dict) else [(b.type, b.data) if hasattr(b, "type") else b for b in cells]
    kinds: List[Array] = []
    corners: List[Array] = []
    connectivity: List[Array] = []
    for name, data in blocks:
        if name not in _KIND_BY_NAME:
            raise ValueError(f"cells of kind {name!r}: dmoscope has {', '.join(_KIND_BY_NAME)}")
        kind = _KIND_BY_NAME[name]
        data = np.asarray(data)
        if data.ndim != 2 or data.shape[1] != _KINDS[kind][2]:
            raise ValueError(f"cells of kind {name!r} must be an array of m x {_KINDS[kind][2]}, not {data.shape}")
        kinds.append(np.full(len(data), kind, dtype=np.uint8))
        corners.append(np.full(len(data), data.shape[1], dtype=np.int64))
        connectivity.append(indices(data).ravel())
    if not kinds:
        raise ValueError("a mesh needs cells")
    offsets = np.concatenate([[0], np.cumsum(np.concatenate(corners))])
    return np.concatenate(kinds), indices(offsets), np.concatenate(connectivity)


class Mesh:
    """Mesh of triangles and quadrilaterals, or of tetrahedra, hexahedra, wedges and pyramids. It does not change.

    Parameters
    ----------
    points : array_like of float, n x 3 or n x 2
        Positions of the vertices, mesh units; finite.
    cells : mapping or list
        {"triangle": m x 3, "quad": m x 4, "tetra": m x 4, "hexahedron": m x 8, "wedge": m x 6, "pyramid": m x 5}: vertices from 0 on,
        corners in VTK's order; or a list of such pairs, or of meshio's blocks.
    cell_data : mapping of str to array_like, optional
        One number, or a row of them, for each cell. What lies between cells of different "material", "region", "gmsh:physical" ... stays.
    point_data : mapping of str to array_like, optional
        One number, or a row of them, for each point.

    Raises
    ------
    InputError
        For a mesh that cannot be: corners that do not exist or repeat, coordinates that are not finite, planar and volume cells mixed.
    ValueError
        For arrays of another form. InputError is one, too.
    """

    def __init__(self, points: npt.ArrayLike, cells: Any, cell_data: Optional[Mapping[str, npt.ArrayLike]] = None,
                 point_data: Optional[Mapping[str, npt.ArrayLike]] = None) -> None:
        self._mesh = _dmoscope.Mesh(_points(points), *_cell_arrays(cells), _numbers(cell_data, "cells"), _numbers(point_data, "points"))

    @classmethod
    def _of(cls, inner: _dmoscope.Mesh) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._mesh = inner
        return mesh

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """Positions of the vertices: n x 3 doubles, mesh units; a view, without a copy, that cannot be written."""
        return self._mesh.points

    def _blocks(self) -> List[Tuple[int, int]]:
        """(first, end) of the cells of one kind, one after the other."""
        kinds = self._mesh.kinds
        starts = np.concatenate([[0], np.flatnonzero(np.diff(kinds)) + 1, [len(kinds)]])
        return list(zip(starts[:-1], starts[1:]))

    @property
    def cells(self) -> List[Tuple[str, Array]]:
        """The cells as a list of (kind, m x corners array), in their order: a new pair wherever the kind changes."""
        kinds, offsets, connectivity = self._mesh.kinds, self._mesh.offsets, self._mesh.connectivity
        return [(_KINDS[kinds[a]][0], connectivity[offsets[a]:offsets[b]].reshape(b - a, -1)) for a, b in self._blocks()]

    @property
    def cells_dict(self) -> Dict[str, Array]:
        """The cells of each kind together, m x corners, as meshio has them."""
        cells = self.cells
        return {kind: np.concatenate([data for other, data in cells if other == kind]) for kind in dict(cells)}

    @property
    def cell_data(self) -> Dict[str, Array]:
        """Numbers of the cells by name, m or m x k: what was given, or what the file held. Copies."""
        return self._mesh.cell_data

    @property
    def point_data(self) -> Dict[str, Array]:
        """Numbers of the points by name, n or n x k: what was given, or what the file held. Copies."""
        return self._mesh.point_data

    @property
    def groups(self) -> List[Group]:
        """Points, lines, faces and cells that the file names."""
        return [Group(*group) for group in self._mesh.groups]

    @property
    def cell_groups(self) -> Dict[str, Array]:
        """Cells that the file names: by name, their numbers."""
        return {group.name: group.cells for group in self.groups if group.members == "cells"}

    def vertices(self, name: str) -> Array:
        """Numbers of the vertices that a name names, ascending.

        Parameters
        ----------
        name : str
            "group:wall" or "wall" (a group of the file), "material=3" (data of points or cells), "box:X0,Y0,X1,Y1" (closed ranges; six
            numbers in space), "loop:1" (see boundary_loops), "part:1" (see parts), "3,7-9".

        Raises
        ------
        UsageError
            For a name that means nothing here, with a list of what there is.
        """
        return self._mesh.vertices(name)

    @property
    def boundary_loops(self) -> List[BoundaryLoop]:
        """The closed curves of the boundary of a planar or surface mesh, as fixed="loop:1" knows them; of a volume mesh none."""
        return [BoundaryLoop(*loop) for loop in self._mesh.boundary_loops]

    @property
    def parts(self) -> List[Array]:
        """Cells connected across edges, as fixed="part:1" knows them; of a volume mesh none."""
        return self._mesh.parts

    def ring(self, vertex: int) -> Array:
        """The neighbours of a vertex across edges in order, counter-clockwise; on the boundary from edge to edge."""
        return self._mesh.ring(whole("vertex", vertex))

    @property
    def boundary(self) -> npt.NDArray[np.bool_]:
        """n booleans: vertices on the boundary."""
        return self._mesh.boundary.view(np.bool_)

    @property
    def in_degrees(self) -> bool:
        """Whether x and y are longitude and latitude, so that the mesh is judged and smoothed on the Earth. with_degrees() sets it."""
        return self._mesh.in_degrees

    def with_degrees(self, degrees: bool = True) -> Mesh:
        """The mesh with x and y taken for longitude and latitude in degrees, or as they stand. Raises InputError for what cannot be degrees."""
        return Mesh._of(self._mesh.with_degrees(bool(degrees)))

    @property
    def thin(self) -> bool:
        """Whether it is a mesh of hexahedra and wedges one cell thick, judged and smoothed as the 2-D mesh of its front. with_thin() sets it."""
        return self._mesh.thin

    def with_thin(self, thin: bool = True) -> Mesh:
        """The mesh taken for the 2-D mesh of its front, which the back follows, or for one of its cells. Raises InputError for what is not
        one cell thick."""
        return Mesh._of(self._mesh.with_thin(bool(thin)))

    @property
    def is_volume(self) -> bool:
        """Whether it has volume cells."""
        return self._mesh.is_volume

    @property
    def is_surface(self) -> bool:
        """Whether it is curved: its cells are planar and do not lie in one plane."""
        return self._mesh.is_surface

    def quality(self, metric: str = "mean-ratio", threads: int = 0) -> npt.NDArray[np.float64]:
        """Quality of each cell: 1 is ideal, 0 or less inverted; NaN where the metric is not defined for the kind.

        Parameters
        ----------
        metric : str, default "mean-ratio"
            A name of metrics(), or a formula: "formula:2*det/norm^2".
        threads : int, 0 to 1024, default 0
            Number of threads; 0: one for each processor. The values do not depend on it.

        Raises
        ------
        UsageError
            For an unknown metric, or too many threads.
        """
        return _dmoscope.quality(self._mesh, metric, min(whole("threads", threads), MOST))

    def statistics(self, metric: str = "mean-ratio", threads: int = 0) -> Dict[str, Any]:
        """Statistics of the quality of all cells; parameters as of quality().

        Returns
        -------
        dict
            "minimum", "mean", "movable_minimum" (of cells with a corner off the boundary), "inverted" (number of cells), "worst_cell".
        """
        return _dmoscope.statistics(self._mesh, metric, min(whole("threads", threads), MOST))

    def with_points(self, points: npt.ArrayLike) -> Mesh:
        """The same cells with other positions: n x 3 (or n x 2), mesh units, copied. Raises ValueError for another number of points."""
        return Mesh._of(self._mesh.with_points(_points(points)))

    def with_materials(self, names: Union[str, Iterable[str]]) -> Mesh:
        """The same mesh, in which the cell data of this name (or these names) name materials; (): those of known names alone."""
        return Mesh._of(self._mesh.with_materials([names] if isinstance(names, str) else list(names)))

    def write(self, path: Union[str, os.PathLike[str]]) -> None:
        """Write a file by its extension, whole or not at all. What the format cannot carry is a warning. Raises OutputError, UsageError."""
        for sentence in self._mesh.write(os.fspath(path)):
            warnings.warn(f"{path}: {sentence}", stacklevel=2)

    def to_meshio(self) -> Any:
        """A meshio.Mesh, with the data of points and cells, and the groups of cells as its cell_sets."""
        meshio = importlib.import_module("meshio")

        blocks = self._blocks()
        return meshio.Mesh(np.array(self.points), [(kind, _in_meshio_order(kind, data).astype(np.int64)) for kind, data in self.cells],
                           point_data=self.point_data, cell_data={name: [values[a:b] for a, b in blocks] for name, values in self.cell_data.items()},
                           cell_sets={name: [cells[(cells >= a) & (cells < b)].astype(np.int64) - a for a, b in blocks]
                                      for name, cells in self.cell_groups.items()})

    def to_pyvista(self) -> Any:
        """A pyvista.UnstructuredGrid, with the data of points and cells; "group" tells cells of different groups apart."""
        pyvista = importlib.import_module("pyvista")

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

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: Any) -> Mesh:
        return self

    def __reduce__(self) -> Tuple[Any, ...]:
        return (_from_bytes, (self._mesh.to_bytes(),))

    def __repr__(self) -> str:
        counts = np.bincount(self._mesh.kinds, minlength=len(_KINDS))
        cells = ", ".join(f"{count} {_KINDS[kind][0]}" for kind, count in enumerate(counts) if count)
        return f"<dmoscope.Mesh: {len(self.points)} points, {cells}>"


def _from_bytes(data: bytes) -> Mesh:
    return Mesh._of(_dmoscope.Mesh.from_bytes(data))


def _in_meshio_order(kind: str, cells: npt.ArrayLike) -> Array:
    """From VTK's order to meshio's or back: they differ for wedges, as Gmsh's does."""
    corners = np.asarray(cells)
    return corners[:, [0, 2, 1, 3, 5, 4]] if kind == "wedge" else corners


def _is_pyvista(mesh: Any) -> bool:
    return all(hasattr(mesh, name) for name in ("points", "celltypes", "cell_connectivity", "offset"))


def _is_meshio(mesh: Any) -> bool:
    return all(hasattr(mesh, name) for name in ("points", "cells", "point_data", "cell_data"))


_POINTS_AND_LINES = {"vertex", "line", "line3"}
_VTK_POINTS_AND_LINES = {1, 2, 3, 4, 21}
_PLANAR = {"triangle", "quad"}


def _columns(values: npt.ArrayLike) -> Array:
    """(n, 1) as n, which legacy VTK's scalars are to meshio."""
    array = np.asarray(values)
    return array[:, 0] if array.ndim == 2 and array.shape[1] == 1 else array


def _are_numbers(values: Array) -> bool:
    return values.ndim in (1, 2) and 0 not in values.shape and values.dtype.kind in "iufb"


def _point_data(mesh: Any) -> Dict[str, Array]:
    data = {str(name): _columns(values) for name, values in dict(getattr(mesh, "point_data", {})).items()}
    return {name: values for name, values in data.items() if _are_numbers(values)}


def _from_meshio(mesh: Any) -> Mesh:
    """Points and lines are left out, and faces where there are solids: they mark boundaries. Data go along, and sets of cells as a number."""
    blocks = [(b.type, b.data) if hasattr(b, "type") else tuple(b) for b in mesh.cells]
    solid = any(kind in _KIND_BY_NAME and kind not in _PLANAR for kind, _ in blocks)
    kept = [i for i, (kind, _) in enumerate(blocks) if kind not in _POINTS_AND_LINES and not (solid and kind in _PLANAR)]
    counts = [len(blocks[i][1]) for i in kept]
    data: Dict[str, Array] = {}
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


def _from_pyvista(grid: Any) -> Mesh:
    """Points and lines are left out, and faces where there are solids; data go along."""
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
    data: Dict[str, Array] = {}
    for name, values in dict(getattr(grid, "cell_data", {})).items():
        values = _columns(values)
        if _are_numbers(values):
            data[str(name)] = values[~left_out]
    ends = np.concatenate([[0], np.cumsum(counts[~left_out])])
    return Mesh._of(_dmoscope.Mesh(_points(grid.points), table[types[~left_out]], indices(ends), indices(connectivity), data,
                                   _point_data(grid)))


def mesh_of(mesh: Any) -> Mesh:
    """The mesh, or that of meshio or PyVista as one. Raises TypeError."""
    if isinstance(mesh, Mesh):
        return mesh
    if _is_pyvista(mesh):  # tested first: a PyVista mesh has most attributes of a meshio one
        return _from_pyvista(mesh)
    if _is_meshio(mesh):
        return _from_meshio(mesh)
    raise TypeError(f"{type(mesh).__name__} is no mesh: dmoscope takes its own, meshio's and PyVista's unstructured grids")


def given_back(original: Any, mesh: Mesh) -> Any:
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


def read(path: Union[str, os.PathLike[str]]) -> Mesh:
    """Read a mesh of any format that the program reads, such as .14, .msh, .su2, .vtk, .vtu, .mesh, .off.

    Parameters
    ----------
    path : str or path-like
        The file; its content tells the format.

    Raises
    ------
    InputError
        For a file that is missing or wrong; its attributes `file` and `line` say where.
    """
    return Mesh._of(_dmoscope.Mesh.read(os.fspath(path)))
