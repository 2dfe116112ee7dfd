"""A film whose thickness is given point by point, in a file beside the scene."""

from functools import lru_cache
from pathlib import Path
from typing import Annotated, Literal, Self

import numpy as np
import scipy
from pydantic import Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Length
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.rom.bearing.pad import Pad
from roughfilm.rom.bearing.texture import pocketed
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.parts.surface_geometry import PLAIN_FORMATS, digest_of

FEWEST = 8
"""Cells to the shortest feature; here each point of the file is to have one."""


class Given(Pad):
    """h over a rectangle by points, those at its edges included, bilinear between; shifted to be ``film`` at the least.

    ``thickness`` names a file: NPY, an array [x, y] in m, or CSV, a line for each y and a column for each x, in m too
    or as a header says (``# spacing: 1 mm, 1 mm; heights: um``; the points lie over length and width all the same).
    ``digest`` is that of the numbers in it: a scene that was written back is not read over others.
    """

    shape: Literal["given"]
    width: Length
    thickness: Annotated[str, Field(min_length=1)]
    digest: str | None = None

    @model_validator(mode="after")
    def _is_there(self) -> Self:
        try:
            found = self._read()[1]
        except InputError as error:
            raise ValueError(f"thickness: in {error}") from None
        if self.digest not in (None, found):
            raise ValueError(
                f"digest: got {self.digest!r:.40}, but {self.thickness} holds other numbers by now, {found!r}; leave "
                "the digest out to take them"
            )
        return self.model_copy(update={"digest": found})

    def _read(self) -> tuple[Array, str]:
        """The numbers above the least of them, m, shape (nx, ny), and their digest."""
        path = Path(self.thickness).expanduser()
        if path.suffix.lower() not in PLAIN_FORMATS:
            raise InputError(f"{path}: is neither NPY nor CSV; save the film thickness as one of them")
        try:
            state = path.stat()
        except OSError as error:
            told = "no such file" if isinstance(error, FileNotFoundError) else f"cannot be read ({error.strerror})"
            raise InputError(f"{path}: {told}; name a file of film thickness") from None
        return _above_least(str(path), state.st_mtime_ns, state.st_size)

    def film_shape(self) -> Shape:
        """The film."""
        above = self._read()[0]
        pixels = tuple(side / (count - 1) for side, count in zip((self.length, self.width), above.shape, strict=True))

        def thickness(x: Array, y: Array) -> Array:
            places = np.array(np.broadcast_arrays(x / pixels[0], y / pixels[1]))
            return np.asarray(self.film + scipy.ndimage.map_coordinates(above, places, order=1, mode="nearest"))

        smooth = Shape(
            thickness=thickness,
            breaks=(0.0, self.length),
            across=(0.0, self.width),
            wide=False,
            finest=(FEWEST * pixels[0], FEWEST * pixels[1]),
        )
        return smooth if self.texture is None else pocketed(smooth, self.texture)


@lru_cache(maxsize=4)
def _above_least(name: str, _modified: int, _size: int) -> tuple[Array, str]:
    path = Path(name)
    told = path.suffix.lower() == ".csv" and path.read_bytes()[:16].lstrip().startswith(b"#")
    surface = read_surface(path, spacing=(1.0, 1.0), height_unit=None if told else "m")
    if surface.invalid.any():
        i, j = np.argwhere(surface.invalid)[0]
        raise InputError(f"{path}: has no number at x {i}, y {j}; fill it in")
    return surface.heights - surface.heights.min(), digest_of(surface)
