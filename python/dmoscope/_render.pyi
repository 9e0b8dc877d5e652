# Types of render.cpp, which render() wraps for users.
from typing import Any, Optional, Tuple

import numpy as np
import numpy.typing as npt

def render(points: npt.NDArray[Any], kinds: npt.NDArray[Any], offsets: npt.NDArray[Any], connectivity: npt.NDArray[Any], metric: str,
           size: Tuple[int, int], colormap: str, range: Optional[Tuple[float, float]], transparent: bool, edges: bool, colour_bar: bool,
           clip: str, clip_mode: str, view: str) -> npt.NDArray[np.uint8]: ...
