"""Anderson's method for a fixed point of fields, in its form for maps that are almost affine."""

from dataclasses import dataclass, field

import numpy as np

from roughfilm.contact.foundation.arrays import Array


@dataclass(kw_only=True)
class Renewals:
    """The last points x and images g(x) of a fixed point, vectors of one length.

    Attributes
    ----------
    remembered : number of earlier points from which the next one is extrapolated.
    points, images : x and g(x), the last one at the end.
    """

    remembered: int
    points: list[Array] = field(default_factory=list)
    images: list[Array] = field(default_factory=list)

    def following(self, point: Array, image: Array) -> Array:
        """The combination of the images, with factors of sum 1, whose difference from that of the points is least.

        For an affine g it lowers the error as GMRES does for (1 - g') x = g(0): whatever part of it few slow modes
        make is gone after as many steps, while g is not changed.

        Source: Walker and Ni 2011, doi:10.1137/10078356X.
        """
        self.points = [*self.points[-self.remembered :], point]
        self.images = [*self.images[-self.remembered :], image]
        if len(self.points) == 1:
            return image
        rests = [after - before for before, after in zip(self.points, self.images, strict=True)]
        changes = np.column_stack([rests[-1] - rest for rest in rests[:-1]])
        shares = np.linalg.lstsq(changes, rests[-1], rcond=None)[0]
        return np.asarray(image - np.column_stack([image - other for other in self.images[:-1]]) @ shares)
