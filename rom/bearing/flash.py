"""The flash temperature of asperities: how much hotter the spots in contact are than the walls."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy

from roughfilm.contact.foundation.arrays import Array, Mask
from roughfilm.contact.foundation.rounding import share
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.bearing.asperity_contact import FLASH, AsperityContact
from roughfilm.rom.bearing.roughness import RoughSurface
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.parts.solids import HeatConductor, composite_modulus, hardness
from roughfilm.rom.temperature.closed_forms.moving_sources import moving_circle

SPOT_TOLERANCE = 1e-4
"""Complementarity error of the contact over the rms height."""

MIN_NODES_OF_SPOT = 9.0
"""Number of nodes of a spot below which the grid of the surface does not resolve it."""

PEAK_OF_SPHERE = 3 * math.pi / 8
"""Greatest temperature under the heat of a sphere's contact, over that under a uniform one, at rest."""

MAX_CONTACT_AREA = 0.03
"""Contact area over the nominal area above which neighbouring spots heat one another much."""

MAX_RISE = 500.0
"""Rise of the temperature, K, above which solids soften and their properties are not constant."""


@dataclass(frozen=True, kw_only=True)
class Spots:
    """The spots in contact of one period of a rough surface.

    Attributes
    ----------
    areas : area of each spot, m².
    pressures : mean contact pressure on each spot, Pa.
    area_fraction : contact area over the nominal area.
    nodes : number of nodes of a spot, as the mean over the contact area.
    """

    areas: Array
    pressures: Array
    area_fraction: float
    nodes: float


@dataclass(frozen=True, kw_only=True)
class FlashTemperature:
    """An estimate of the flash temperature, K above the temperature of the walls, and its range.

    Attributes
    ----------
    mean : mean over the contact area.
    low : mean over the spots, whatever their area.
    high : the greatest temperature in the hottest spot, if its pressure is that of a sphere.
    """

    mean: float
    low: float
    high: float

    @property
    def named(self) -> dict[str, float]:
        """The estimate and its range by the names of the quantities."""
        return dict(zip(FLASH, (self.mean, self.low, self.high), strict=True))


def spots_of(contact: Contact) -> Spots:
    """The spots of a periodic contact: nodes in contact that are connected through their faces.

    Examples
    --------
    >>> from roughfilm.contact.mechanics.press import Press
    >>> heights = np.zeros((16, 16))
    >>> heights[2:4, 5:8], heights[-1, 1], heights[0, 1] = 1e-7, 1e-7, 1e-7
    >>> spots = spots_of(Press(heights, (1e-6, 1e-6), 1e11, hardness=5e9).at(1e8))
    >>> sorted((1e12 * spots.areas).round(6).tolist())
    [2.0, 6.0]
    """
    labels = _labels(contact.in_contact)
    dx, dy = contact.spacing
    counts = np.bincount(labels.ravel())[1:]
    forces = np.bincount(labels.ravel(), weights=contact.pressure.ravel())[1:]
    kept = counts > 0
    counts, forces = counts[kept], forces[kept]
    return Spots(
        areas=np.asarray(counts * (dx * dy), dtype=np.float64),
        pressures=forces / counts,
        area_fraction=float(counts.sum()) / labels.size,
        nodes=float((counts**2).sum() / counts.sum()),
    )


def _labels(touching: Mask) -> Array:
    """The number of the spot of each node, from 1, and 0 without contact; spots continue across the seams."""
    labels, count = scipy.ndimage.label(touching)
    meet = np.concatenate([np.stack([labels[-1], labels[0]]), np.stack([labels[:, -1], labels[:, 0]])], axis=1)
    meet = meet[:, (meet > 0).all(axis=0)]
    links = scipy.sparse.coo_array((np.ones(meet.shape[1]), (meet[0], meet[1])), shape=(count + 1, count + 1))
    return np.asarray(scipy.sparse.csgraph.connected_components(links, directed=False)[1][labels])


def rise_of_spots(
    spots: Spots, *, friction: float, speed: float, rough: HeatConductor, smooth: HeatConductor
) -> FlashTemperature:
    """The flash temperature of spots on which friction makes the heat q = μ p u.

    Each spot is a circle of its area. It rests on the rough wall and slides over the smooth one. The heat is divided so
    that both have the same temperature, ΔT = 1/(1/ΔT_rough + 1/ΔT_smooth) with the rises ΔT_rough and ΔT_smooth if one
    wall took all the heat: of :func:`roughfilm.rom.temperature.closed_forms.moving_sources.moving_circle` at rest and
    at the speed u. The pressure on a spot is uniform, but ``high`` is 3 π/8 times as high, as under the pressure of a
    sphere at rest. Left out are the time in which a spot heats up, about the square of its radius over the thermal
    diffusivity, and the heat of the other spots: beside the temperatures of all nodes in contact, on both walls at
    once, the mean is 2 to 5 % too low at up to 0.3 % of the area in contact, 8 to 16 % at 0.9 %, 20 to 30 % at 3 % and
    30 to 55 % at 8 % (a part of which is the temperature of the walls around).

    Parameters
    ----------
    friction : coefficient of boundary friction μ.
    speed : sliding speed u, m/s.
    rough, smooth : heat conduction of the solids of both walls.

    Sources: Jaeger 1942, Journal and Proceedings of the Royal Society of New South Wales 76, 203-224; Tian and Kennedy
    1994, Journal of Tribology 116, 167-174; Ashby, Abulawi and Kong 1991, Tribology Transactions 34, 577-587.
    """
    rises = [
        _shared(math.sqrt(area / math.pi), friction * pressure * abs(speed), speed, rough, smooth)
        for area, pressure in zip(spots.areas.tolist(), spots.pressures.tolist(), strict=True)
    ]
    means, greatest = np.array(rises).T
    mean = float(np.average(means, weights=spots.areas))
    return FlashTemperature(mean=mean, low=min(float(means.mean()), mean), high=PEAK_OF_SPHERE * float(greatest.max()))


def _shared(
    radius: float, flux: float, speed: float, rough: HeatConductor, smooth: HeatConductor
) -> tuple[float, float]:
    """The mean and the greatest rise of a spot whose heat flux both walls share."""
    if flux == 0:
        return 0.0, 0.0
    at_rest, moving = (
        moving_circle(
            radius=radius,
            flux=flux,
            speed=sliding,
            conductivity=wall.conductivity,
            heat_per_volume=wall.heat_per_volume,
        )
        for sliding, wall in ((0.0, rough), (abs(speed), smooth))
    )
    return 1 / (1 / at_rest.mean + 1 / moving.mean), 1 / (1 / at_rest.greatest + 1 / moving.greatest)


def flash_temperature(scene: Bearing, pressure: float, friction: float) -> FlashTemperature | None:
    """The flash temperature at a contact pressure over the nominal area, Pa; None if no asperities touch.

    It is None, too, if the scene has no ``asperities.solid_heat``. The contact of the rough wall is solved at this
    pressure for its spots.

    Raises
    ------
    ConvergenceError
        If the contact does not converge.
    """
    asperities = scene.asperities
    if asperities is None or asperities.solid_heat is None or pressure == 0:
        return None
    return rise_of_spots(
        _spots_at(scene, pressure),
        friction=friction,
        speed=scene.motion.speed,
        rough=asperities.solid_heat,
        smooth=asperities.counter_heat or asperities.solid_heat,
    )


def flash_warnings(scene: Bearing, pressure: float, flash: FlashTemperature) -> list[str]:
    """Warnings about a flash temperature outside of the range of its estimate."""
    if pressure == 0:
        return []
    spots, warnings = _spots_at(scene, pressure), []
    if spots.nodes < MIN_NODES_OF_SPOT:
        warnings.append(
            f"flash_temperature: a spot has {spots.nodes:.2g} nodes of the surface; below {MIN_NODES_OF_SPOT:g} "
            "its size is that of the grid, give the surface with a finer spacing"
        )
    if spots.area_fraction > MAX_CONTACT_AREA:
        warnings.append(
            f"flash_temperature: {share(spots.area_fraction)} of the area touches at {pressure:.3g} Pa; above "
            f"{share(MAX_CONTACT_AREA)} neighbouring spots heat one another, which the estimate leaves out"
        )
    if flash.high > MAX_RISE:
        warnings.append(
            f"flash_temperature: up to {flash.high:.3g} K; above {MAX_RISE:g} K solids soften and conduct otherwise, "
            "which the estimate leaves out"
        )
    return warnings


def _spots_at(scene: Bearing, pressure: float) -> Spots:
    assert isinstance(scene.roughness, RoughSurface)
    assert scene.asperities is not None
    solids = scene.asperities.model_dump_json(include={"solid", "counter"}, exclude_none=True)
    return _spots(scene.roughness.model_dump_json(exclude_none=True), solids, pressure)


@lru_cache(maxsize=64)
def _spots(surface: str, solids: str, pressure: float) -> Spots:
    roughness, asperities = RoughSurface.model_validate_json(surface), AsperityContact.model_validate_json(solids)
    assert asperities.solid is not None
    press = Press(
        roughness.scaled_heights(),
        roughness.scaled_spacing(),
        composite_modulus(asperities.solid, asperities.counter),
        hardness=hardness(asperities.solid),
    )
    return spots_of(press.at(pressure, tolerance=SPOT_TOLERANCE))
