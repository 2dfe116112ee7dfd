"""Type names of the NumPy arrays that every package uses."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""An array of floating-point numbers, of any shape."""

Mask = NDArray[np.bool_]
"""An array of truth values, of any shape."""
