"""Journal bearings whose bore consists of circular arcs: full, partial, multi-lobe and tilting-pad bearings."""

import math
from collections.abc import Iterator
from functools import partial
from typing import Annotated, Literal, Self

import numpy as np
import scipy
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, model_validator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.entries import Angle, InUnit, plain_number
from roughfilm.rom.bearing.geometry.journal import Ratio, Shaft
from roughfilm.rom.bearing.geometry.pad import known_film
from roughfilm.rom.bearing.geometry.rigid import MovingWall, RigidWall
from roughfilm.rom.bearing.geometry.ring import FITTING, Fraction
from roughfilm.rom.cavitation.shape import Shape

SAMPLES = 721
"""Number of angles at which the least film of a lobe is sought."""

JOINT = 1e-11
"""Distance of these angles from the ends of the lobe, rad."""

FARTHEST = 4.0
"""Eccentricity, over the clearance, at which a shaft that moves towards a bore has met it."""

MAX_LOBES = 24
"""Largest number of lobes."""

DOWN = -math.pi / 2
"""The direction of a load that points downwards, rad."""

Arc = Annotated[float, InUnit("rad")]
Signed = Annotated[float, BeforeValidator(plain_number)]


class Lobes(Shaft, MovingWall):
    """A shaft in a bore of equal arcs, in coordinates that are fixed to the bore.

    Angles θ count from the x axis towards the y axis, as the shaft turns at a positive speed; y points upwards, and x
    is the position R (θ - θ₀) from the beginning θ₀ of the first lobe. The film of the lobe k is

        h = c (1 - m cos(θ - θ_k)) - (e_x + a_x y) cos θ - (e_y + a_y y) sin θ - R δ_k sin(θ - θ_pk)

    with the clearance c of a lobe, its preload m, the angle θ_k at which a centred shaft is nearest to it, the position
    e of the shaft, its misalignment a, y from the middle of the width, and, of a tilting pad, its tilt δ_k about the
    pivot at θ_pk.

    Attributes
    ----------
    lobes : number of equal lobes, evenly spaced.
    arc : angle of a lobe, rad; by default the lobes fill the circle without grooves between them.
    first : angle of the middle of the first lobe from the x axis, rad; by default -90°, below the shaft.
    preload : distance of the centre of a lobe from that of the bearing, over the clearance.
    offset : position along a lobe, 0 to 1 in the direction of rotation, at which a centred shaft is nearest to it.
    pivot : position along a lobe, 0 to 1, of its pivot; with it the lobes are pads that tilt.
    eccentricity : position of the shaft along x and y over the clearance; without it a load determines it.
    misalignment : slopes of the axis of the shaft along x and y against that of the bore, rad.
    tilts : tilt of each pad, rad, positive if it closes behind the pivot; without them the pads are in equilibrium.
    """

    shape: Literal["lobes"]
    lobes: Annotated[int, Field(strict=True, ge=1, le=MAX_LOBES)] = 1
    arc: Arc | None = None
    first: Angle = DOWN
    preload: Ratio = 0.0
    offset: Fraction = 0.5
    pivot: Fraction | None = None
    eccentricity: tuple[Signed, Signed] | None = None
    misalignment: tuple[Angle, Angle] = (0.0, 0.0)
    tilts: tuple[Angle, ...] | None = None

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.arc is not None and self.arc > 2 * math.pi / self.lobes * (1 + FITTING):
            raise ValueError(
                f"arc: got {math.degrees(self.arc):.6g} degrees; {self.lobes} equal lobes have at most "
                f"{360 / self.lobes:.6g} degrees each"
            )
        if any(self.misalignment) and self.width is None:
            raise ValueError("misalignment: got one for an infinitely wide bearing; give it a width")
        if self.width is not None and not self.single:
            move = math.hypot(*self.misalignment) * self.width / 2
            if move >= self.clearance:
                raise ValueError(
                    f"misalignment: got slopes that move the ends of the shaft by {move:.3g} m; they must move by less "
                    f"than the clearance, {self.clearance:.3g} m"
                )
        if self.pivot is not None and self.joined:
            raise ValueError("pivot: got one for lobes without gaps between them; give an arc that leaves gaps")
        if self.tilts is not None and (self.pivot is None or len(self.tilts) != self.lobes):
            raise ValueError(f"tilts: got {len(self.tilts)}; give one for each of the lobes, which need a pivot")
        if self.eccentricity is not None and self.least_film <= 0:
            reached = f"reaches {-self.least_film:.3g} m into" if self.least_film < 0 else "touches"
            others = {"preload": self.preload, "misalignment": any(self.misalignment), "tilts": any(self.tilts or ())}
            lower = " or the ".join(["it", *(name for name, given in others.items() if given)])
            raise ValueError(
                f"eccentricity: got {list(self.eccentricity)}; the shaft {reached} the bore; lower {lower}"
            )
        return self

    @property
    def turn(self) -> float:
        """The angle of a lobe, rad."""
        return 2 * math.pi / self.lobes if self.arc is None else min(self.arc, 2 * math.pi / self.lobes)

    @property
    def joined(self) -> bool:
        """Whether the lobes fill the circle without gaps between them."""
        return self.turn >= 2 * math.pi / self.lobes * (1 - FITTING)

    @property
    def single(self) -> bool:
        """Whether the bore is one arc that does not close, whose film has an inlet and an outlet."""
        return self.lobes == 1 and not self.joined

    @property
    def length(self) -> float:
        """The length of the film along the circumference, m; with the gaps between several lobes."""
        return self.radius * (self.turn if self.single else 2 * math.pi)

    @property
    def start(self) -> float:
        """The angle θ₀ at which the first lobe begins, rad."""
        return self.first - self.turn / 2

    def begins(self, lobe: int) -> float:
        """The angle at which a lobe begins after the first one, rad."""
        return 2 * math.pi * lobe / self.lobes

    @property
    def pivots(self) -> Array:
        """The angles of the pivots of the pads, rad; none without pivots."""
        if self.pivot is None:
            return np.zeros(0)
        return self.start + self.pivot * self.turn + np.array([self.begins(lobe) for lobe in range(self.lobes)])

    @property
    def film(self) -> float | None:
        """The least film thickness, m; None if a load determines it."""
        return None if self.eccentricity is None else self.least_film

    @property
    def thinnest(self) -> float:
        """The least film thickness, m; InputError if a load determines it."""
        return known_film(self.film)

    @property
    def least_film(self) -> float:
        """The least film thickness at the eccentricity, m; negative where the shaft reaches into the bore."""
        return float(min(self.thickness(x, y).min() for x, y in self._samples()))

    def least_films(self, eccentricity: Array) -> Array:
        """The least film thickness, m, at positions of the shaft over the clearance, shape (2, n), without tilts."""
        along, up = self.clearance * eccentricity[..., None]
        return np.asarray(
            np.min(
                [
                    (self.bore(x, y) - along * np.cos(self.angle(x)) - up * np.sin(self.angle(x))).min(axis=-1)
                    for x, y in self._samples()
                ],
                axis=0,
            )
        )

    def _samples(self) -> Iterator[tuple[Array, Array]]:
        """Positions on both sides at which the least film is sought."""
        inside = np.linspace(JOINT, self.turn - JOINT, SAMPLES)
        x = self.radius * np.concatenate([self.begins(lobe) + inside for lobe in range(self.lobes)])
        for side in [0.0] if self.width is None else [0.0, self.width]:
            yield x, np.full_like(x, side)

    def at_film(self, film: float) -> Self:
        """The bearing with its shaft moved along its eccentricity, or down, to another least film thickness, m.

        Where this way leads out of an arc that does not close, the shaft moves towards the middle of the first lobe,
        or its pivot.
        """
        x, y = self.eccentricity or (0.0, -1.0)
        size = math.hypot(x, y) or 1.0
        along = (0.0, -1.0) if x == y == 0 else (x / size, y / size)

        def excess(ratio: float) -> float:
            return self._moved(ratio, along).least_film - film

        if excess(0.0) <= 0:
            return self._moved(0.0, along)
        if excess(FARTHEST) > 0:
            inside = self.first if self.pivot is None else float(self.pivots[0])
            along = (math.cos(inside), math.sin(inside))
        return self._moved(scipy.optimize.brentq(excess, 0.0, FARTHEST, xtol=1e-15, rtol=1e-14), along)

    def _moved(self, ratio: float, along: tuple[float, float]) -> Self:
        """The bearing with its shaft at an eccentricity over the clearance in a direction."""
        return self.model_copy(update={"eccentricity": (ratio * along[0], ratio * along[1])})

    def angle(self, x: Array) -> Array:
        """The angle θ at positions x, rad."""
        return np.asarray(self.start + x / self.radius)

    def lobe(self, x: Array) -> Array:
        """The number from 0 of the lobe at positions x; that before a gap inside it."""
        turned = np.mod(x / self.radius, 2 * math.pi) if not self.single else x / self.radius
        return np.asarray(np.clip(np.floor(turned * self.lobes / (2 * math.pi) + 1e-12), 0, self.lobes - 1))

    def in_gap(self, x: Array) -> NDArray[np.bool_]:
        """Whether positions x lie in a gap between lobes, or at the end of a lobe before or behind one."""
        along = self._from(x, 0.0)
        ends = (along <= JOINT) | (along >= self.turn - JOINT)
        return np.asarray(ends & (not self.joined and not self.single))

    def _from(self, x: Array, position: float) -> Array:
        """The angle from the given position, 0 to 1, along the lobe at positions x, rad."""
        return np.asarray(self.angle(x) - self.start - self.lobe(x) * 2 * math.pi / self.lobes - position * self.turn)

    def bore(self, x: Array, y: Array) -> Array:
        """The film thickness of a centred shaft with its misalignment, m."""
        clearance = self.clearance * (1 - self.preload * np.cos(self._from(x, self.offset)))
        angle, across = self.angle(x), y - (self.width or 0.0) / 2
        along_x, along_y = self.misalignment
        return np.asarray(clearance - across * (along_x * np.cos(angle) + along_y * np.sin(angle)))

    def thickness(self, x: Array, y: Array) -> Array:
        """The film thickness h, m."""
        wall = self.wall
        moved = sum(normal(x, y) * place for normal, place in zip(wall.normals, wall.place, strict=True))
        return np.asarray(self.bore(x, y) + moved)

    @property
    def wall(self) -> RigidWall:
        """The coordinates of the shaft, m, and of the pads, rad."""
        pads = 0 if self.pivot is None else self.lobes

        def tilted(lobe: int, x: Array, y: Array) -> Array:
            inside = self.lobe(x) == lobe
            return np.where(inside, -self.radius * np.sin(self._from(x, self.pivot or 0.0)), 0.0) + 0 * y

        known = np.array(self.eccentricity or (0.0, 0.0)) * self.clearance
        return RigidWall(
            names=("eccentricity_x", "eccentricity_y", *(f"tilt_{pad + 1}" for pad in range(pads))),
            normals=(
                lambda x, y: -np.cos(self.angle(x)) + 0 * y,
                lambda x, y: -np.sin(self.angle(x)) + 0 * y,
                *(partial(tilted, pad) for pad in range(pads)),
            ),
            unit=np.array([self.clearance] * 2 + [self.clearance / self.radius] * pads),
            place=np.concatenate([known, self.tilts or np.zeros(pads)]),
            turns=np.array([False] * 2 + [True] * pads),
        )

    def at(self, place: Array) -> Self:
        """The same bearing with its shaft and pads at the coordinates of its wall."""
        x, y, *tilts = (float(value) for value in place)
        return self.model_copy(
            update={"eccentricity": (x / self.clearance, y / self.clearance), "tilts": tuple(tilts) or None}
        )

    @property
    def tilted(self) -> bool:
        """Whether the tilts of the pads are given."""
        return self.tilts is not None

    @property
    def symmetric(self) -> bool:
        """Whether the film is symmetric about the middle of its width."""
        return not any(self.misalignment)

    def gaps(self) -> Iterator[tuple[float, float]]:
        """Where the gaps between the lobes begin and end, m."""
        if self.joined or self.single:
            return
        for lobe in range(self.lobes):
            yield self.radius * (self.begins(lobe) + self.turn), self.radius * self.begins(lobe + 1)

    def film_shape(self) -> Shape:
        """The shape of the film."""
        edges = {self.radius * self.begins(lobe) for lobe in range(self.lobes)} | {self.length}
        edges |= {begin for begin, _ in self.gaps()}
        return Shape(
            thickness=self.thickness,
            breaks=tuple(sorted(edges)),
            across=(0.0, self.length if self.width is None else self.width),
            wide=self.width is None,
            joined=(not self.single, False),
            idle=tuple(self.gaps()),
        )
