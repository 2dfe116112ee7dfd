"""The dimensionless numbers of a bearing: what says before any solution which effects its film will feel."""

import math
from collections.abc import Mapping

import numpy as np

from roughfilm.rom.bearing.ring import Ring, Washer
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.texture import Texture

PLACES = 129
"""Along and across, where a film is looked at."""


def bearing_numbers(scene: Bearing) -> Mapping[str, float]:
    """The numbers that a scene has, by name, all of unit 1; h is the least film thickness without texture and waves.

    ``slenderness`` : width over length, of a bearing that has a width.
    ``convergence`` : greatest film thickness over h less 1, texture left out, and ``thickness_ratio`` one more;
    ``finest`` : the shortest feature along the sliding over the length, 1 where there is none.
    ``starvation`` : θ of the inlet, 1 where it is full; not of joined pads.
    ``cavitation_number`` : (p_ambient - p_cav)/(6ηuL/h²): tension that the liquid bears over the pressure that sliding
    makes; infinite at rest.
    ``divergence`` : the most by which the film grows thicker along the sliding, over h, texture and waves of the shape
    counted: where there is none, nothing cavitates.
    ``compression`` : θ - 1 at 6ηuL/h², p/β of a stiff liquid; ``piezoviscous`` : ln η/η0 there, αp by Barus' law;
    ``pressure_dependence`` : both together.
    ``roughness_ratio`` : Sq/h; ``peak_ratio`` : Sp/h, above 1 where the walls touch; ``roughness_period`` : period over
    length, where it is known.
    ``texture_density`` : the part of the bearing that pockets cover; ``pocket_depth_ratio`` : depth over h;
    ``pocket_length_ratio`` : length of a pocket over that of the bearing.
    ``reynolds_number`` : ρuh/η, and ``reduced_reynolds_number`` : ρuh²/(ηl), l the shortest feature along the sliding;
    of a lubricant whose density is told.
    """
    geometry, lubricant, roughness = scene.geometry, scene.lubricant, scene.roughness
    film, length, speed = geometry.film, geometry.length, abs(scene.motion.speed)
    numbers = {"convergence": _convergence(scene), "divergence": _divergence(scene)}
    finest = _finest(scene)
    if geometry.width is not None:
        numbers["slenderness"] = geometry.width / length
    numbers["thickness_ratio"] = numbers["convergence"] + 1
    numbers["finest"] = finest / length if math.isfinite(finest) else 1.0
    if not (isinstance(geometry, Ring) and geometry.endless):
        theta = scene.boundary.inlet.theta
        numbers["starvation"] = 1.0 if theta is None else theta
    made, tension = scene.pressure_unit, 0.0 - lubricant.cavitation_pressure
    numbers["cavitation_number"] = tension / made if made > 0 else math.copysign(math.inf, tension) if tension else 0.0
    problem, pressure = scene.problem(), np.array([made])
    with np.errstate(all="ignore"):
        numbers["compression"] = float(problem.compression(pressure)[0][0])
        thinner = float(problem.piezoviscosity.fluidity(pressure, lubricant.viscosity)[0][0])
    numbers["piezoviscous"] = 0.0 - math.log(thinner) if thinner > 0 else math.inf
    numbers["pressure_dependence"] = numbers["compression"] + numbers["piezoviscous"]
    if roughness is not None:
        numbers |= {"roughness_ratio": roughness.rms / film, "peak_ratio": roughness.peak / film}
        if math.isfinite(roughness.period):
            numbers["roughness_period"] = roughness.period / length
    numbers |= _texture(scene)
    if lubricant.density is not None:
        number = lubricant.density * speed * film / lubricant.viscosity
        numbers["reynolds_number"] = number
        numbers["reduced_reynolds_number"] = number * film / min(finest, length)
    return numbers


def without_texture(scene: Bearing) -> Bearing:
    """The same bearing without its pockets."""
    key = "pocket" if isinstance(scene.geometry, Washer) else "texture"
    if getattr(scene.geometry, key, None) is None:
        return scene
    return scene.model_copy(update={"geometry": scene.geometry.model_copy(update={key: None})})


def _finest(scene: Bearing) -> float:
    """The shortest feature of the wall along the sliding, m; infinite where there is none."""
    radius = scene.geometry.radius if isinstance(scene.geometry, Ring) else 1.0
    return radius * scene.geometry.film_shape().finest[0]


def _convergence(scene: Bearing) -> float:
    shape = without_texture(scene).geometry.film_shape()
    x, y = np.linspace(shape.breaks[0], shape.breaks[-1], PLACES), np.linspace(*shape.across, PLACES)
    thickness = shape.thickness(*np.broadcast_arrays(x[:, None], y[:1] if shape.wide else y))
    return float(thickness.max()) / scene.geometry.film - 1


def _divergence(scene: Bearing) -> float:
    shape = scene.geometry.film_shape()
    x, y = np.linspace(shape.breaks[0], shape.breaks[-1], PLACES), np.linspace(*shape.across, PLACES)
    thickness = np.asarray(shape.thickness(*np.broadcast_arrays(x[:, None], y[:1] if shape.wide else y)))
    ahead = thickness if scene.motion.speed >= 0 else thickness[::-1]
    return float((ahead - np.minimum.accumulate(ahead, axis=0)).max()) / scene.geometry.film


def _texture(scene: Bearing) -> dict[str, float]:
    geometry = scene.geometry
    if isinstance(geometry, Washer):
        pocket = geometry.pocket
        if pocket is None:
            return {}
        inner, outer = geometry.inner_radius, geometry.outer_radius
        covered = pocket.share * ((inner + pocket.extent) ** 2 - inner**2) / (outer**2 - inner**2)
        ratios = {"pocket_depth_ratio": pocket.depth / geometry.film, "pocket_length_ratio": pocket.share}
        return {"texture_density": covered, **ratios}
    texture: Texture | None = getattr(geometry, "texture", None)
    if texture is None:
        return {}
    across = 1.0 if texture.width is None or geometry.width is None else texture.rows * texture.width / geometry.width
    filled = math.pi / 4 if texture.profile == "ellipsoidal" else 1.0
    return {
        "texture_density": filled * texture.columns * texture.length / geometry.length * across,
        "pocket_depth_ratio": texture.depth / geometry.film,
        "pocket_length_ratio": texture.length / geometry.length,
    }
