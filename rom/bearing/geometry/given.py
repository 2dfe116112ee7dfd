"""Films whose thickness is given by points in a file."""

from functools import lru_cache
from pathlib import Path
from typing import Literal, Self

import numpy as np
import scipy
from pydantic import model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length, ScenePath
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.reading.regular import file_size
from roughfilm.contact.surfaces.files import has_header, read_surface
from roughfilm.rom.bearing.geometry.pad import Pad
from roughfilm.rom.bearing.geometry.texture import pocketed
from roughfilm.rom.cavitation.shape import CELLS_PER_FEATURE, Shape
from roughfilm.rom.parts.surface_geometry import PLAIN_FORMATS, digest_of


class Given(Pad):
    """A film over a rectangle, bilinear between given points, and shifted to the minimum thickness ``film``.

    The outermost points lie on the edges of the rectangle.

    Attributes
    ----------
    thickness : path of a file: NPY, an array [x, y] in m, or CSV, a line for each y and a column for each x, in m or in
        the unit of its header (``# spacing: 1 mm, 1 mm; heights: um``; the spacing has no effect).
    digest : digest of the numbers in the file; a file that has changed since is rejected.
    """

    shape: Literal["given"]
    width: Length
    thickness: ScenePath
    digest: str | None = None

    @model_validator(mode="after")
    def _can_be_read(self) -> Self:
        try:
            digest = self._read()[1]
        except InputError as error:
            raise ValueError(f"thickness: in {error}") from None
        if self.digest not in (None, digest):
            raise ValueError(
                f"digest: got {self.digest!r:.40}, but the numbers in {self.thickness} now have {digest!r}; leave the "
                "digest out to accept them"
            )
        return self.model_copy(update={"digest": digest})

    def _read(self) -> tuple[Array, str]:
        """The thickness above its minimum, m, shape (nx, ny), and the digest of the file."""
        path = Path(self.thickness).expanduser()
        if path.suffix.lower() not in PLAIN_FORMATS:
            raise InputError(f"{path}: is neither NPY nor CSV; save the film thickness as one of them")
        size = file_size(path, "name a file of film thickness")
        return _above_minimum(str(path), path.stat().st_mtime_ns, size)

    def film_shape(self) -> Shape:
        """The shape of the film, with its texture."""
        above = self._read()[0]
        pixels = tuple(side / (count - 1) for side, count in zip((self.length, self.width), above.shape, strict=True))

        def thickness(x: Array, y: Array) -> Array:
            places = np.array(np.broadcast_arrays(x / pixels[0], y / pixels[1]))
            return np.asarray(self.thinnest + scipy.ndimage.map_coordinates(above, places, order=1, mode="nearest"))

        smooth = Shape(
            thickness=thickness,
            breaks=(0.0, self.length),
            across=(0.0, self.width),
            wide=False,
            finest=(CELLS_PER_FEATURE * pixels[0], CELLS_PER_FEATURE * pixels[1]),  # one cell for each point
        )
        return smooth if self.texture is None else pocketed(smooth, self.texture)


@lru_cache(maxsize=4)
def _above_minimum(name: str, _modified: int, _size: int) -> tuple[Array, str]:
    path = Path(name)
    surface = read_surface(path, spacing=(1.0, 1.0), height_unit=None if has_header(path) else "m", lists=False)
    if surface.invalid.any():
        i, j = np.argwhere(surface.invalid)[0]
        raise InputError(f"{path}: has no number at x {i}, y {j}; fill the gap")
    return surface.heights - surface.heights.min(), digest_of(surface)
