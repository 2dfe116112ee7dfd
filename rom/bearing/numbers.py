"""The dimensionless numbers of a bearing, which show before any solution which effects matter."""

import math
from collections.abc import Mapping

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.bearing.equilibrium.expected import expected_scene
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.rigid import MovingWall
from roughfilm.rom.bearing.geometry.ring import Ring, Washer
from roughfilm.rom.bearing.geometry.shapes import AnyShape
from roughfilm.rom.bearing.geometry.texture import Texture
from roughfilm.rom.bearing.scene import Bearing, Inlet
from roughfilm.rom.cavitation.shape import Shape

SAMPLES = 129
"""Number of positions along and across at which the film thickness is sampled."""

NEGLIGIBLE_DENSITY = 1e-9
"""Density of a liquid without inertia, kg/m³."""


def bearing_numbers(scene: Bearing) -> Mapping[str, float]:
    """The dimensionless numbers of a scene by name; h is the minimum film thickness without texture and waves.

    Under a load the film is the expected one (:func:`roughfilm.rom.bearing.equilibrium.expected.expected_film`).

    slenderness : width over length, if the bearing has a width.
    piece_slenderness : of a wall that moves freely, width over the length of a lobe or a pad.
    convergence : maximum film thickness without texture over h, minus 1.
    thickness_ratio : convergence plus 1.
    finest : length of the shortest feature along the sliding direction over the length; 1 without features.
    starvation : θ at the inlet, 1 if flooded; not for joined pads.
    cavitation_number : (p_ambient - p_cav)/(6ηuL/h²); infinite at rest.
    divergence : largest increase of the film thickness along the sliding direction over h, with texture and waves of
        the shape; a film without divergence does not cavitate.
    suction : of a wall that moves freely, divergence over the sum of divergence and cavitation_number; 0 if the film
        does not widen, and 1 if it widens and cavitates at ambient pressure.
    compression : θ - 1 at 6ηuL/h², which is p/β of a stiff liquid.
    piezoviscous : ln η/η0 at 6ηuL/h², which is αp by Barus' law.
    pressure_dependence : sum of θ - 1 and ln η/η0 at p/(1 + (L/B)²) plus the largest pressure at an edge, p = 6ηuL/h².
    roughness_ratio, peak_ratio : Sq/h and Sp/h; the walls touch if the latter is above 1.
    roughness_period : period of the roughness over the length, if the period is known.
    texture_density : fraction of the bearing that pockets cover.
    pocket_depth_ratio, pocket_length_ratio : depth of a pocket over h, and its length over that of the bearing.
    squeeze_number : 2VL/(uh), the pressure scale of squeeze over that of sliding, if the walls approach each other;
        infinite at rest. In the numbers above and below u + 2VL/h then takes the place of u.
    reynolds_number : ρuh/η, if the density is given.
    reduced_reynolds_number : ρuh²/(ηl), if the density is given; l is the shortest feature along the sliding direction.

    Scenes with a temperature (:attr:`roughfilm.rom.bearing.lubricant.BearingLubricant.liquid`) have the following, too,
    with β = -(dη/dT)/η of the supplied lubricant, and L the length of one lobe or pad:

    heating_number : β times the temperature at which the lubricant would leave, above that at which it enters, if its
        viscosity stayed and the walls took no heat: F u/(ρ c q) of an infinitely wide film that narrows linearly. It
        is βηuL/(ρch²) times a factor of 2 of a parallel film and about 1 of a film that narrows much.
    thermal_peclet_number : ρcuh²/(kL): how far heat is carried along the film, over its length, while it is conducted
        across it. If the conductivity is given.
    nahme_number : βηu²/k: β times the heating of a film between walls of one temperature, times 8. If the conductivity
        is given.
    brinkman_number : ηu²/(kΔT) with the largest difference ΔT between a given temperature of a wall and the supplied
        lubricant; only if there is one.
    """
    scene = expected_scene(scene)
    geometry, lubricant, roughness = scene.geometry, scene.lubricant, scene.roughness
    film, length, speed = geometry.thinnest, geometry.length, scene.equivalent_speed
    numbers = {"convergence": _convergence(scene), "divergence": _divergence(scene)}
    finest = _finest(scene)
    if geometry.width is not None:
        numbers["slenderness"] = geometry.width / length
        if isinstance(geometry, MovingWall):
            piece = geometry.radius * geometry.turn if isinstance(geometry, Lobes) else length
            numbers["piece_slenderness"] = geometry.width / piece
    numbers["thickness_ratio"] = numbers["convergence"] + 1
    numbers["finest"] = finest / length if math.isfinite(finest) else 1.0
    if not (isinstance(geometry, Ring) and geometry.endless):
        theta = scene.boundary.inlet.theta
        numbers["starvation"] = 1.0 if theta is None else theta
    scale, tension = scene.pressure_unit, 0.0 - lubricant.cavitation_pressure
    numbers["cavitation_number"] = (
        tension / scale if scale > 0 else math.copysign(math.inf, tension) if tension else 0.0
    )
    if isinstance(geometry, MovingWall):
        widening = numbers["divergence"]
        numbers["suction"] = widening / (widening + max(numbers["cavitation_number"], 0.0)) if widening > 0 else 0.0
    numbers["compression"], numbers["piezoviscous"] = _pressed(scene, scale)
    numbers["pressure_dependence"] = sum(_pressed(scene, scale * _share_of_wide(geometry) + _largest_at_edges(scene)))
    if roughness is not None:
        numbers |= {"roughness_ratio": roughness.rms / film, "peak_ratio": roughness.peak / film}
        if math.isfinite(roughness.period):
            numbers["roughness_period"] = roughness.period / length
    numbers |= _texture(scene)
    if approach := abs(scene.motion.approach):
        sliding = abs(scene.motion.speed) * film
        numbers["squeeze_number"] = 2 * approach * length / sliding if sliding > 0 else math.inf
    if lubricant.density is not None:
        number = lubricant.density * speed * film / lubricant.viscosity
        numbers["reynolds_number"] = number
        numbers["reduced_reynolds_number"] = number * film / min(finest, length)
    return numbers | _thermal(scene, numbers)


def _thermal(scene: Bearing, numbers: Mapping[str, float]) -> dict[str, float]:
    """The numbers of the temperature, of scenes that have one."""
    if scene.lubricant.lacking:
        return {}
    geometry, liquid, speed = scene.geometry, scene.lubricant.liquid, scene.equivalent_speed
    film, length = geometry.thinnest, geometry.length
    if isinstance(geometry, Lobes):
        length = geometry.radius * geometry.turn
    supplied = np.array([liquid.temperature])
    viscosity, slope = (float(one[0]) for one in liquid.viscosity(supplied))
    capacity = float(liquid.heat(supplied)[1][0])
    coefficient = -slope / viscosity
    heating = coefficient * viscosity * speed * length / (capacity * film**2)
    filled = min(numbers.get("starvation", 1.0), 1.0)
    found = {"heating_number": heating * linear_heating(numbers["thickness_ratio"]) / filled}
    if math.isnan(liquid.conductivity):
        return found
    found["thermal_peclet_number"] = capacity * speed * film**2 / (liquid.conductivity * length)
    found["nahme_number"] = coefficient * viscosity * speed**2 / liquid.conductivity
    difference = _difference_of_walls(scene, liquid.temperature)
    if difference:
        found["brinkman_number"] = viscosity * speed**2 / (liquid.conductivity * difference)
    return found


def linear_heating(ratio: float) -> float:
    """The adiabatic rise of the temperature of a film that narrows linearly, over ηuL/(ρch²), h at its outlet.

    It is F u/(ρ c q) of constant viscosity, with a = h1/h: (1 + a)/a (4 ln a - 6 (a - 1)/(a + 1))/(a - 1), and 2 for
    a = 1.

    Parameters
    ----------
    ratio : film thickness at the inlet over that at the outlet a, at least 1.

    Examples
    --------
    >>> round(linear_heating(1.0), 6), round(linear_heating(2.0), 6)
    (2.0, 1.158883)
    """
    fall = ratio - 1
    friction = (4 * math.log1p(fall) - 6 * fall / (2 + fall)) / fall if fall > 0 else 1.0
    return (1 + ratio) / ratio * friction


def _difference_of_walls(scene: Bearing, supplied: float) -> float:
    """The largest difference between a given temperature of a wall and that of the supplied lubricant, K."""
    if scene.heat is None:
        return 0.0
    given = [getattr(wall, "temperature", None) for wall in (scene.heat.fixed_wall, scene.heat.sliding_wall)]
    return max((abs(one - supplied) for one in given if one is not None), default=0.0)


def _pressed(scene: Bearing, pressure: float) -> tuple[float, float]:
    """θ - 1 and ln η/η0 at a pressure."""
    problem, at = scene.problem(), np.array([pressure])
    with np.errstate(all="ignore"):
        compression = float(problem.compression(at)[0][0])
        thinner = float(problem.piezoviscosity.fluidity(at, scene.lubricant.viscosity)[0][0])
    return compression, 0.0 - math.log(thinner) if thinner > 0 else math.inf


def _share_of_wide(geometry: AnyShape) -> float:
    """The pressure of a film of finite width over that of an infinitely wide one, roughly 1/(1 + (L/B)²)."""
    return 1.0 if geometry.width is None else 1 / (1 + (geometry.length / geometry.width) ** 2)


def _largest_at_edges(scene: Bearing) -> float:
    """The largest pressure above ambient at an edge, Pa."""
    edges = scene.boundary
    inlet = scene.inlet_pressure if edges.inlet.theta is None else 0.0
    return max(inlet, edges.outlet.pressure, edges.sides.low, edges.sides.high)


def without_texture(scene: Bearing) -> Bearing:
    """The same bearing without its pockets."""
    key = "pocket" if isinstance(scene.geometry, Washer) else "texture"
    if getattr(scene.geometry, key, None) is None:
        return scene
    return scene.model_copy(update={"geometry": scene.geometry.model_copy(update={key: None})})


def without_inertia(scene: Bearing) -> Bearing:
    """The same bearing with a negligible density, and with the same pressure at its inlet."""
    lubricant, boundary = scene.lubricant.model_copy(update={"density": NEGLIGIBLE_DENSITY}), scene.boundary
    if boundary.inlet.theta is None:
        inlet = Inlet.model_construct(pressure=scene.inlet_pressure)
        boundary = boundary.model_copy(update={"inlet": inlet})
    return scene.model_copy(update={"lubricant": lubricant, "boundary": boundary})


def _finest(scene: Bearing) -> float:
    """The length of the shortest feature of the wall along the sliding direction, m; infinite without features."""
    radius = scene.geometry.radius if isinstance(scene.geometry, Ring) else 1.0
    return radius * scene.geometry.film_shape().finest[0]


def _sampled_thickness(shape: Shape) -> Array:
    """The film thickness at ``SAMPLES`` positions along and across, m."""
    x, y = np.linspace(shape.breaks[0], shape.breaks[-1], SAMPLES), np.linspace(*shape.across, SAMPLES)
    return shape.thickness(*np.broadcast_arrays(x[:, None], y[:1] if shape.wide else y))


def _convergence(scene: Bearing) -> float:
    thickness = _sampled_thickness(without_texture(scene).geometry.film_shape())
    return float(thickness.max()) / scene.geometry.thinnest - 1


def _divergence(scene: Bearing) -> float:
    thickness = _sampled_thickness(scene.geometry.film_shape())
    ahead = thickness if scene.motion.speed >= 0 else thickness[::-1]
    return float((ahead - np.minimum.accumulate(ahead, axis=0)).max()) / scene.geometry.thinnest


def _texture(scene: Bearing) -> dict[str, float]:
    geometry = scene.geometry
    if isinstance(geometry, Washer):
        pocket = geometry.pocket
        if pocket is None:
            return {}
        inner, outer = geometry.inner_radius, geometry.outer_radius
        covered = pocket.share * ((inner + pocket.extent) ** 2 - inner**2) / (outer**2 - inner**2)
        ratios = {"pocket_depth_ratio": pocket.depth / geometry.thinnest, "pocket_length_ratio": pocket.share}
        return {"texture_density": covered, **ratios}
    texture: Texture | None = getattr(geometry, "texture", None)
    if texture is None:
        return {}
    across = 1.0 if texture.width is None or geometry.width is None else texture.rows * texture.width / geometry.width
    filled = math.pi / 4 if texture.profile == "ellipsoidal" else 1.0
    return {
        "texture_density": filled * texture.columns * texture.length / geometry.length * across,
        "pocket_depth_ratio": texture.depth / geometry.thinnest,
        "pocket_length_ratio": texture.length / geometry.length,
    }
