# What module.cpp defines; dmoscope/__init__.py makes it pleasant.
from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np

__version__: str

class Error(RuntimeError): ...

class InputError(Error):
    file: str
    line: int

class OutputError(Error): ...
class UsageError(Error, ValueError): ...

class Mesh:
    points: np.ndarray
    kinds: np.ndarray
    offsets: np.ndarray
    connectivity: np.ndarray
    boundary: np.ndarray
    cell_data: Dict[str, np.ndarray]
    point_data: Dict[str, np.ndarray]
    cell_groups: Dict[str, np.ndarray]
    is_volume: bool
    in_degrees: bool
    is_surface: bool
    def __init__(self, points: np.ndarray, kinds: np.ndarray, offsets: np.ndarray, connectivity: np.ndarray, cell_data: Dict[str, np.ndarray],
                 point_data: Dict[str, np.ndarray]) -> None: ...
    @staticmethod
    def read(path: str) -> "Mesh": ...
    def write(self, path: str) -> List[str]: ...
    def to_bytes(self) -> bytes: ...
    @staticmethod
    def from_bytes(bytes: bytes) -> "Mesh": ...
    def with_points(self, points: np.ndarray) -> "Mesh": ...
    def with_materials(self, names: list[str]) -> "Mesh": ...
    def with_degrees(self, degrees: bool) -> "Mesh": ...

class Iteration:
    number: int
    moved: int
    seconds: float
    minimum: float
    mean: float
    movable_minimum: float
    inverted: int

class Options:
    def __init__(self, iterations: Optional[int], until_converged: bool, threads: int, fixed: List[int], words: Dict[str, str]) -> None: ...

def smooth(mesh: Mesh, options: Options, callback: Optional[Callable[[Iteration], Optional[bool]]]) -> Tuple[Any, ...]: ...
def trace(mesh: Mesh, vertex: int, options: Options) -> Dict[str, Any]: ...
def quality(mesh: Mesh, metric: str, threads: int) -> np.ndarray: ...
def statistics(mesh: Mesh, metric: str, threads: int) -> Dict[str, Any]: ...
def metrics() -> Dict[str, Tuple[str, float, float, str, str]]: ...
