"""TIFF images of heights: each page of one number for a point is a channel; they hold no spacing and no unit."""

from typing import Any

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError

SIGNATURES = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
"""First bytes of a TIFF of either order of bytes, and of a BigTIFF."""


def read_tiff(path: str, channel: str | None, most: int) -> tuple[str, Array]:
    """The name of a page, its number from 1 on, and its heights, a column for each y, shape (nx, ny).

    Raises
    ------
    InputError
        If the file has no page of heights or no such page, holds several and none is named, claims more points than
        ``most``, or is compressed and the package imagecodecs is not there.
    """
    import tifffile  # which SurfaceTopography needs

    with tifffile.TiffFile(path) as file:
        pages: dict[str, Any] = {
            str(number): page
            for number, page in enumerate(file.pages, 1)
            if len(page.shape) == 2 and page.dtype is not None and page.dtype.kind in "fiu"
        }
        if not pages:
            raise InputError("is an image without a page of heights, one number for each point; export the heights")
        names = ", ".join(f"{name!r} ({' x '.join(map(str, page.shape[::-1]))})" for name, page in pages.items())
        if channel is None and len(pages) > 1:
            raise InputError(f"holds {len(pages)} pages: {names}; name one, as in read.channel={next(iter(pages))}")
        name = next(iter(pages)) if channel is None else channel
        if name not in pages:
            raise InputError(f"has no channel {name!r}; its pages are {names}")
        points = pages[name].shape[::-1]
        if points[0] * points[1] > most:
            raise InputError(f"claims {points[0]} x {points[1]} points; at most {most} fit a file of its length")
        try:
            return name, np.asarray(pages[name].asarray(), dtype=np.float64).T
        except ValueError as error:
            if "imagecodecs" not in str(error):
                raise
            how = pages[name].compression.name
            raise InputError(f"is compressed by {how}, which is not read here; save it without compression") from None
