"""Stribeck curves: how friction, film and the asperities' share of a load change with speed."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from rom.bearing import Bearing
from rom.ladder import Progress, silent
from rom.mixed.asperities import Asperities

RESOLUTION = 64
"""Cells along and across, by default."""

TOLERANCE = 1e-6
"""Of the load that film and asperities carry together, by default."""


@dataclass(frozen=True, kw_only=True)
class StribeckPoint:
    """A bearing under one load at one speed, walls where film and asperities carry it together.

    Forces are per width, N/m, of an infinitely wide bearing.

    Attributes
    ----------
    pressure : the load over the nominal area (of a journal diameter times width), Pa.
    speed : of the sliding wall, m/s.
    separation : α of the rigid mean planes at the narrowest place, m.
    least_gap : the mean gap there, m; the separation as long as nothing touches.
    load, film_load, contact_load : N.
    contact_share : of the load.
    friction : N; boundary friction and that of the film.
    friction_coefficient : friction over load.
    pressure_max : of the film, above ambient, Pa.
    contact_pressure_max : of the asperities, averaged over the roughness, Pa.
    contact_area : the part of the nominal area that touches.
    cavitated_fraction : the part of the film that is torn.
    balance : what the loads miss the one asked for by, relative to it.
    residual : of the film: the largest net flow into a node over the largest through a face.
    cpu_s : s.
    uncertainty : how far off quantities may be, in their units, by name; empty at points where it was not estimated.
    """

    pressure: float
    speed: float
    separation: float
    least_gap: float
    load: float
    film_load: float
    contact_load: float
    contact_share: float
    friction: float
    friction_coefficient: float
    pressure_max: float
    contact_pressure_max: float
    contact_area: float
    cavitated_fraction: float
    balance: float
    residual: float
    cpu_s: float
    uncertainty: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True)
class LiftOff:
    """Where the asperities just touch at the narrowest place: the film alone carries the load from this speed on.

    ``speed``, m/s, is NaN where none up to 1000 times the largest asked for lifts the wall, 0 where it floats at rest.
    """

    speed: float
    uncertainty: float


@dataclass(frozen=True, kw_only=True)
class StribeckCurve:
    """The points of one load in the order of their speeds, and its lift-off; ``pressure`` over the nominal area, Pa."""

    pressure: float
    points: tuple[StribeckPoint, ...]
    lift_off: LiftOff


def stribeck(
    scene: Bearing,
    speeds: Sequence[float],
    pressures: Sequence[float],
    *,
    asperities: Asperities | None = None,
    resolution: int = RESOLUTION,
    tolerance: float = TOLERANCE,
    known: Sequence[StribeckPoint] = (),
    keep: Callable[[StribeckPoint], object] = lambda _point: None,
    progress: Progress = silent,
) -> tuple[StribeckCurve, ...]:
    """Sweep the speed of a bearing with asperities at several loads.

    Parameters
    ----------
    scene : with ``asperities`` and a roughness; its speed and film do not count.
    speeds : of the sliding wall, m/s, 0 or more; in any order, each once.
    pressures : loads over the nominal area, Pa.
    asperities : of the rough wall; by default as the scene says.
    resolution : cells along and across.
    tolerance : of the balance of loads, relative.
    known : points that need not be solved again.
    keep : called with every new point as soon as it is done.

    Raises
    ------
    InputError
        If a load is more than the asperities' table or the surface can carry, naming the largest; if the pressures at
        the sides alone float the wall; for a scene without asperities.
    ConvergenceError
        If a film does not come into balance.
    """
    raise NotImplementedError
