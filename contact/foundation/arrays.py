"""The type of the arrays that the library computes with."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""An array of double precision, of any shape."""
