"""Smoothing, and traces of the search of a vertex."""

from __future__ import annotations

import inspect
import warnings
from dataclasses import dataclass, field
from typing import AbstractSet, Any, Callable, Dict, Generic, List, Literal, Optional, Tuple, TypeVar, Union

import numpy as np
import numpy.typing as npt

from . import _dmoscope
from ._dmoscope import Iteration
from ._mesh import MOST, Array, Mesh, given_back, indices, mesh_of, whole

AnyMesh = TypeVar("AnyMesh")
Selection = Union[npt.ArrayLike, AbstractSet[int], None]  # numbers, booleans, or names
_VERTICES = ("fixed", "slide", "corners", "no_corners")
_EDGES = ("features", "no_features")


@dataclass
class Held:
    """Reason why the worst cell gets no better. In a mesh one cell thick, numbers are those of its front."""

    cell: int  # the worst cell, or the worst that can move
    quality: float  # its quality
    by: str  # main reason: "boundary", "interface", "corner", "hand", "neighbours" ...; "free": none
    vertices: Dict[int, str]  # reason of each of its corners
    change: str  # option and value that would free it: "boundary slide"; "": none is known
    certified: bool  # whether it is proved that no joint move raises the minimum, to first order
    sentence: str = field(repr=False)  # all of that for people


@dataclass
class Smoothed(Generic[AnyMesh]):
    """Result of smooth()."""

    mesh: AnyMesh  # mesh of the class that was given
    history: Dict[str, Array] = field(repr=False)  # by iteration, 0 the input: iteration, minimum, mean, movable_minimum, inverted, moved, seconds
    iteration: int  # number of the iteration whose end is `mesh`
    converged: bool  # whether until_converged was reached
    cancelled: bool  # whether the callback or Ctrl+C ended it; `mesh` is the result until then
    sentence: str  # reason for the end
    warnings: List[str] = field(repr=False)  # sentences for people
    fields: str = field(default="", repr=False)  # changes of the point data
    held: Optional[Held] = None  # what holds the minimum, if that was to be explained


def _names_and_numbers(given: Any) -> Tuple[List[str], Any]:
    """Names and numbers of what is selected: a name, several, or numbers as a set or anything like an array."""
    if given is None:
        return [], []
    if isinstance(given, str):
        return [given], []
    if isinstance(given, (set, frozenset)):
        given = list(given)
    if isinstance(given, (list, tuple)) and given and all(isinstance(one, str) for one in given):
        return list(given), []
    return [], given


def _vertices(name: str, given: Any, points: int) -> Tuple[List[str], List[int]]:
    names, numbers = _names_and_numbers(given)
    array = np.asarray(numbers)
    if array.dtype == np.bool_:
        if array.shape != (points,):
            raise ValueError(f"{name} must be {points} booleans or numbers of vertices, not an array of {array.shape}")
        array = np.flatnonzero(array)
    if array.ndim != 1:
        raise ValueError(f"{name} must be a list of vertices, not an array of {array.shape}")
    return names, indices(array, name).tolist()


def _edges(name: str, given: Any) -> Tuple[List[str], List[Tuple[int, int]]]:
    names, numbers = _names_and_numbers(given)
    array = indices(numbers, name)
    if array.size and (array.ndim != 2 or array.shape[1] != 2):
        raise ValueError(f"{name} must be k x 2 vertices, the ends of k edges, not an array of {array.shape}")
    return names, [(a, b) for a, b in array.tolist()]


def _text(name: str, value: Any, usual: Any) -> str:
    """The value as the program's words. Its type is that of the usual one."""
    if isinstance(usual, bool):
        return "on" if value else "off"
    if isinstance(usual, int) or name == "iterations":
        return str(whole(name, value))
    if isinstance(usual, float):
        try:
            number = float(value)
        except (TypeError, ValueError):
            raise TypeError(f"{name} must be a number, not {value!r}") from None
        return "off" if name == "fit" and number == 0.0 else repr(number)
    if not isinstance(value, str):
        raise TypeError(f"{name} must be a string, not {value!r}")
    return value


def _options(mesh: Mesh, given: Dict[str, Any]) -> _dmoscope.Options:
    """Options from keywords of smooth(). Those that are None or usual are left out."""
    usual = {name: one.default for name, one in inspect.signature(smooth).parameters.items()}
    unknown = sorted(set(given) - set(usual))
    if unknown:
        raise TypeError(f"got an unexpected keyword argument {unknown[0]!r}")
    special = {"mesh", "surface", "callback", "raise_on_interrupt", *_VERTICES, *_EDGES}
    if "guard" in given and given["guard"] is None:
        given = {**given, "guard": "off"}
    words = [(name, _text(name, value, usual[name])) for name, value in given.items() if name not in special and value is not None]
    words = [(name, text) for name, text in words if usual[name] is None or text != _text(name, usual[name], usual[name])]
    surface = given.get("surface")
    return _dmoscope.Options(words, {name: _vertices(name, given.get(name), len(mesh.points)) for name in _VERTICES},
                             {name: _edges(name, given.get(name)) for name in _EDGES}, None if surface is None else mesh_of(surface)._mesh)


def smooth(mesh: AnyMesh, iterations: Optional[int] = None, *, until_converged: bool = False, patience: int = 200,
           max_iterations: int = 10000, threads: int = 0, explain: bool = False, fixed: Selection = None, slide: Selection = None, corners: Selection = None,
           no_corners: Selection = None, features: Selection = None, no_features: Selection = None, surface: Any = None,
           method: Literal["dmo", "laplace", "smart-laplace", "angle-based", "dvr", "pattern-search", "active-set", "joint"] = "dmo",
           metric: str = "mean-ratio", target: Optional[str] = None, combine: Optional[str] = None, size_function: Optional[str] = None,
           then: Optional[str] = None, recipe: Optional[Literal["best", "hex", "minimum", "mean", "paper"]] = None, grid: int = 8,
           levels: int = 3, omega: float = 0.5, precision: Literal["float", "double"] = "float",
           simd: Literal["auto", "baseline", "avx2", "avx512"] = "auto", relaxation: float = 1.0,
           directions: Literal["random", "axes"] = "random", seed: int = 1, guard: Optional[str] = "mean-ratio:input",
           order: str = "natural", interfaces: Literal["fixed", "free", "slide"] = "fixed", layers: Literal["keep", "free"] = "keep",
           boundary: Literal["fixed", "slide"] = "fixed", corner_angle: float = 20.0, feature_angle: float = 40.0,
           max_deviation: float = 1e-3, fit: float = 0.0, joint_gap: float = 2e-4, fields: str = "place",
           backend: Literal["auto", "cpu", "cuda"] = "auto", callback: Optional[Callable[[Iteration], Optional[bool]]] = None,
           raise_on_interrupt: bool = False) -> Smoothed[AnyMesh]:
    """Move vertices so that the worst cell becomes as good as it can. Cells stay, and the boundary unless it is to slide.

    The result does not depend on the number of threads and has the bits of `dmoscope smooth`. Ctrl+C ends the run: what there is then is
    returned, with a RuntimeWarning.

    Parameters
    ----------
    mesh : Mesh, meshio.Mesh or pyvista.UnstructuredGrid
        Mesh to smooth. It does not change.
    iterations : int, optional
        Number of iterations, each of which visits every free vertex once: 0 to 1e9. Default: 20, but a recipe goes on until converged.
    until_converged : bool, default False
        Go on until no vertex moves or the minimum no longer rises, and return the best iteration. Excludes `iterations`.
    patience : int, default 200
        Number of iterations without a rise of 1e-6 that count as converged: 1 to 1e9. For until_converged and recipes.
    max_iterations : int, default 10000
        Limit for the iterations of until_converged and recipes: 0 to 1e9.
    threads : int, default 0
        Number of threads: 0 to 1024; 0: one for each processor.
    explain : bool, default False
        Find what holds the minimum once the run is over: Smoothed.held. May take as long as the run.
    fixed : array_like of int or bool, set of int, str or list of str, optional
        Vertices that stay in place besides those of the boundary: by number, as n booleans, or by names as of Mesh.vertices(), such as
        "group:wall".
    slide : vertices as `fixed`, optional
        Vertices of the boundary that slide, while the rest of the boundary stays.
    corners : vertices as `fixed`, optional
        Vertices that stay where others slide.
    no_corners : vertices as `fixed`, optional
        Vertices that slide however much their curve turns there.
    features : array_like of int, k x 2, str or list of str, optional
        Edges that nothing crosses, and along which their vertices slide: by their ends, or by names: "3-4,4-9", "group:rim" (its lines, or
        the border of its faces), "chain:3-4" (feature edges from 3-4 on, both ways up to the next corner).
    no_features : edges as `features`, optional
        Edges that are smooth however much the surface folds there.
    surface : Mesh, meshio.Mesh or pyvista.UnstructuredGrid, optional
        Another mesh, of a curved surface or of a volume: vertices slide on its surface and along its feature edges instead of those of
        `mesh`. Not for planar meshes.
    method : str, default "dmo"
        "dmo" (discrete mesh optimization), "laplace", "smart-laplace", "angle-based" (not for volumes), "dvr" (directional vertex
        relaxation), "pattern-search", "active-set" or "joint" (clusters of vertices together).
    metric : str, default "mean-ratio"
        Metric that is raised: a name of metrics(), a formula ("formula:2*det/norm^2"), or one with a target ("mean-ratio@input").
    target : str, optional
        Shape that cells are to have instead of the ideal one: "input", "field:NAME", "aspect:RATIO:DEGREES"; for groups "GROUP:SHAPE",
        joined by "+".
    combine : str, optional
        Two aims, "FIRST:THRESHOLD:SECOND": the metric FIRST up to the threshold, above 0 and below 1, and beyond it SECOND: another metric,
        or "density", which adapts the sizes of the cells of a planar mesh. Excludes `metric`.
    size_function : str, optional
        Size that cells are to have, for `combine` with density: "h1:X,Y" (grows with the distance from a point), "h2:X,Y" (falls with it),
        "constant", "field:NAME" (point data). Default: constant.
    then : str, optional
        Phases after the minimum has converged: "joint" (joint moves, which raise it further), "mean" (raise the harmonic mean without
        lowering the minimum), "arithmetic-mean", "geometric-mean", "inverse-square-mean", or "joint," and a mean. Needs until_converged.
    recipe : str, optional
        Method and phases under one name, instead of `method`, `combine` and `then`: "best" (recommended: a minimum within 0.3 % of what can
        be reached, then the best mean that keeps it), "hex" (for hexahedra), "minimum", "mean" or "paper".
    grid : int, default 8
        Candidates per axis of the search grid: 2 to 64. Read by dmo.
    levels : int, default 3
        Grids per visit, each finer than the one before: 1 to 16. Read by dmo.
    omega : float, default 0.5
        Size of the first grid in bounding boxes of the neighbouring vertices: above 0, up to 2. Read by dmo.
    precision : str, default "float"
        Scalar of the search, "float" or "double"; moves are always confirmed in double. Read by dmo.
    simd : str, default "auto"
        Vector instructions: "auto", "baseline", "avx2" or "avx512". The result is the same for any. Read by dmo.
    relaxation : float, default 1.0
        Share of the way to its new place that a vertex goes: above 0, up to 1. Read by laplace, smart-laplace, angle-based.
    directions : str, default "random"
        Directions of the lines along which vertices move, one an iteration: "random", or the "axes" in turn. Read by dvr.
    seed : int, default 1
        Seed of the random directions: from 0 on. Read by dvr.
    guard : str or None, default "mean-ratio:input"
        Metric whose least value falls neither below that of the input ("METRIC:input") or a value ("METRIC:VALUE") nor, where it is below
        that, any further, whatever metric is raised. None: off.
    order : str, default "natural"
        Order of the visits: "natural" or "shuffle:SEED".
    interfaces : str, default "fixed"
        Vertices between groups or materials, and on inner lines and strings that the file names: "fixed", "free" or "slide" (those between
        materials, along themselves).
    layers : str, default "keep"
        Vertices of boundary layers (stacks of at least 3 flat cells that grow from the boundary): "keep" or "free".
    boundary : str, default "fixed"
        Vertices of the boundary: "fixed", or "slide" along the boundary of the input.
    corner_angle : float, default 20.0
        Turn of a curve, degrees, above which a vertex is a corner, which stays where others slide: above 0, up to 180.
    feature_angle : float, default 40.0
        Fold of a surface, degrees, above which an edge is a feature edge, which vertices slide along and not across: above 0, up to 180.
    max_deviation : float, default 0.001
        Greatest distance of a sliding boundary from that of the input, as a share of the diagonal of the mesh's box: above 0, up to 1.
    fit : float, default 0.0
        Distance from `surface`, mesh units, within which vertices are drawn to it first; the boundary slides then. 0: off.
    joint_gap : float, default 0.0002
        Distance of a cluster's minimum from its greatest possible value at which joint moves end, as a share: above 0, up to 0.5. Recipes
        have their own.
    fields : str, default "place"
        Point data of vertices that move: "place" (the input's value at the new place), "carry", or either by name: "depth=carry,wind=place".
    backend : str, default "auto"
        "auto" and "cpu" are the processor; "cuda" is refused by the module.
    callback : callable, optional
        Called as callback(iteration) after each iteration, on this thread; the iteration has number, minimum, mean, movable_minimum,
        inverted, moved and seconds. If it returns False, the run ends with the result so far.
    raise_on_interrupt : bool, default False
        Raise KeyboardInterrupt at Ctrl+C instead of returning the result so far.

    Returns
    -------
    Smoothed
        The mesh, of the class that was given, and how the run went.

    Raises
    ------
    UsageError
        (a ValueError) Begins with the argument's name: a value out of range, an unknown name, a vertex that does not exist, arguments that
        do not fit each other or the mesh.
    TypeError
        An argument of another type.

    Examples
    --------
    >>> points = [[0, 0], [1, 0], [2, 0], [0, 1], [0.2, 0.3], [2, 1], [0, 2], [1, 2], [2, 2]]
    >>> ring = [0, 1, 2, 5, 8, 7, 6, 3]
    >>> mesh = dmoscope.Mesh(points, {"triangle": [[4, a, b] for a, b in zip(ring, ring[1:] + ring[:1])]})
    >>> result = dmoscope.smooth(mesh)
    >>> round(mesh.statistics()["minimum"], 2), round(result.mesh.statistics()["minimum"], 2)
    (0.16, 0.87)
    """
    given = dict(locals())
    prepared = mesh_of(mesh)
    inner, history, iteration, converged, cancelled, interrupted, sentence, told, changed, held = _dmoscope.smooth(
        prepared._mesh, _options(prepared, given), callback)
    if interrupted and raise_on_interrupt:
        raise KeyboardInterrupt
    if interrupted:
        warnings.warn(f"interrupted after iteration {iteration}; the mesh is what there was then", RuntimeWarning, stacklevel=2)
    return Smoothed(given_back(mesh, Mesh._of(inner)), history, iteration, converged, cancelled, sentence, told, changed,
                    None if held is None else Held(*held))


@dataclass
class TraceLevel:
    """A level of the search, from coarse to fine. p candidates per axis, d = 2 axes in a plane and 3 in space."""

    candidates: Array = field(repr=False)  # p x p (x p) x 3: places, mesh units
    values: Array = field(repr=False)  # p x p (x p): the numbers that the search compared; more is better
    quality: Array = field(repr=False)  # p x p (x p): quality of the worst cell of the star with the vertex there
    best: Optional[int]  # the chosen candidate, an index into values.ravel(); None: none is better than the one found before


@dataclass
class Trace:
    """Result of trace()."""

    start: Array  # place before: 3 coordinates, mesh units
    end: Array  # place after: 3 coordinates, mesh units
    before: float  # quality of the worst cell of its star
    after: float
    levels: List[TraceLevel] = field(repr=False)  # empty if the vertex may not move
    value: str  # name of the number in `values`
    sentence: str  # the outcome


def trace(mesh: Any, vertex: int, **options: Any) -> Trace:
    """Find what the first visit of dmo would do to a vertex: all candidates that the search looks at.

    Parameters
    ----------
    mesh : Mesh, meshio.Mesh or pyvista.UnstructuredGrid
        Planar or volume mesh.
    vertex : int
        Number of the vertex, from 0 on.
    **options
        Keywords of smooth(); of these count the aim, the search grid, and what holds vertices in place.

    Raises
    ------
    UsageError
        (a ValueError) As of smooth(); also for a vertex that does not exist, and a mesh of a curved surface.
    """
    prepared = mesh_of(mesh)
    found = _dmoscope.trace(prepared._mesh, min(whole("vertex", vertex), MOST), _options(prepared, options))
    found["levels"] = [TraceLevel(**level) for level in found["levels"]]
    return Trace(**found)
