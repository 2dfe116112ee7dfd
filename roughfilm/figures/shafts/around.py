"""A shaft in lobes seen along its axis: the bore, the shaft, its load and the pressure around it."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, FancyArrowPatch
from scipy.interpolate import InterpolatedUnivariateSpline

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure, svg
from roughfilm.figures.shafts.angles import EDGE_COLOUR, GAP_COLOUR, LEAST_COLOUR, LOAD_COLOUR, SUPPLY_COLOUR
from roughfilm.figures.view import Style
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.result import Result
from roughfilm.words.scales import scales_of

CLEARANCE = 0.22
"""Clearance in the drawing over the radius of the shaft."""

LEAST_ATTITUDE = 5.0
"""Attitude angle below which its number is not written, degrees."""

SHELL = 0.06
"""Thickness of the shell in the drawing over the radius of the shaft."""

LEAST_MOUTH = 0.05
"""Smallest angle of a supply in the drawing, rad."""

HIGHEST = 0.75
"""Height of the largest pressure in the drawing over the radius of the shaft."""


def around(scene: Bearing, results: Mapping[str, Result], reference: str, styles: Mapping[str, Style]) -> str:
    """The bore and the shaft with an exaggerated clearance, the pressure around them, and the load.

    All are those of the section through the greatest pressure. The film is drawn in proportion to its thickness, by the
    reference model; the pressure above ambient, in proportion to its magnitude, outside of the shell.
    """
    figure, axes = new_figure((9.4, 6.6))
    draw(axes, scene, results, reference, styles)
    figure.legend(loc="outside right upper", fontsize=8)
    return svg(figure)


def draw(
    axes: Axes, scene: Bearing, results: Mapping[str, Result], reference: str, styles: Mapping[str, Style]
) -> None:
    """Draw the bore, the shaft, the pressure around them and the load of a scene."""
    geometry, shown = scene.geometry, results[reference]
    assert isinstance(geometry, Lobes)
    axes.set(aspect="equal")
    axes.set_axis_off()
    shaft = np.linspace(0, 2 * np.pi, 361)
    across = float(_section(shown, "y")[0]) - (geometry.width or 0.0) / 2
    moved = np.array([_value(shown, "eccentricity_x"), _value(shown, "eccentricity_y")])
    moved += np.array(geometry.misalignment) * across / geometry.clearance
    surface = 1 + CLEARANCE * _along(moved, shaft)
    axes.fill(*_places(shaft, surface), facecolor="#deebf7", edgecolor="#08519c", linewidth=1.2)
    outside = _shell(axes, scene, shown, moved)
    scale = scales_of([shown])("pressure_max", "Pa")
    largest = max(float(_section(result, "pressure").max()) for result in results.values())
    for name, result in results.items():
        if largest <= 0:
            break
        style = styles.get(name, Style())
        angle = geometry.angle(_section(result, "x"))
        height = outside + HIGHEST * np.maximum(_section(result, "pressure"), 0) / largest
        if not geometry.single:
            angle, height = np.append(angle, angle[0] + 2 * np.pi), np.append(height, height[0])
        if name == reference:
            below = _places(angle[::-1], np.full_like(angle, outside))
            outline = np.concatenate([_places(angle, height), below], axis=1)
            axes.fill(*outline, color=style.colour, alpha=0.15, linewidth=0)
        axes.plot(*_places(angle, height), color=style.colour, linestyle=style.line, linewidth=1.4, label=name)
    _marks(axes, scene, shown, moved, outside)
    axes.plot([], [], " ", label=f"largest pressure: {scale.number(largest)} {scale.unit}")


def _shell(axes: Axes, scene: Bearing, shown: Result, moved: Array) -> float:
    """Draw the lobes, their centres, pivots and supplies; return the radius outside of the shell."""
    geometry = scene.geometry
    assert isinstance(geometry, Lobes)
    film, x = _section(shown, "film_thickness"), _section(shown, "x")
    angle = geometry.angle(x)
    bore = 1 + CLEARANCE * (film / geometry.clearance + _along(moved, angle))
    arc, cell = geometry.radius * geometry.turn, float(np.diff(x).max())
    outside = float(bore.max()) + SHELL
    for lobe in range(geometry.lobes):
        begin = geometry.radius * geometry.begins(lobe)
        inside = (x > begin + cell / 2) & (x < begin + arc - cell / 2)
        across = np.concatenate([[begin], x[inside], [begin + arc]])
        wall = InterpolatedUnivariateSpline(x[inside], bore[inside], k=1)(across)  # extrapolated to the ends
        back = _places(geometry.angle(across[::-1]), np.full(across.size, outside))
        outline = np.concatenate([_places(geometry.angle(across), wall), back], axis=1)
        axes.fill(*outline, facecolor=GAP_COLOUR, edgecolor="#525252", linewidth=0.8)
        if geometry.preload:
            nearest = geometry.start + geometry.begins(lobe) + geometry.offset * geometry.turn
            axes.plot(*_places(np.array([nearest]), -CLEARANCE * geometry.preload), "+", color="#525252", markersize=5)
        if geometry.pivot is not None:
            pivot = np.array([geometry.start + geometry.begins(lobe) + geometry.pivot * geometry.turn])
            axes.plot(*_places(pivot, outside), "^", color="#252525", markersize=6)
    _supplies(axes, scene, x, bore, outside)
    return outside


def _supplies(axes: Axes, scene: Bearing, x: Array, bore: Array, outside: float) -> None:
    """Draw where the supplies pass the shell, each with its number; one all around lies in the middle of the shell."""
    geometry = scene.geometry
    assert isinstance(geometry, Lobes)
    for number, patch in enumerate(scene.supply_patches, start=1):
        begin, end = (0.0, geometry.length) if patch.x is None else patch.x
        spare = max(0.0, LEAST_MOUTH * geometry.radius - (end - begin)) / 2
        along = np.linspace(begin - spare, end + spare, 73)
        inner = np.interp(along, x, bore, period=None if geometry.single else geometry.length)
        angle, outer = geometry.angle(along), np.full_like(along, outside)
        if patch.x is None:
            inner, outer = inner + 0.35 * (outer - inner), inner + 0.65 * (outer - inner)
        outline = np.concatenate([_places(angle, inner), _places(angle[::-1], outer[::-1])], axis=1)
        label, edge = "supply" if number == 1 else None, 0.0 if patch.x is None else 0.8
        axes.fill(*outline, facecolor=SUPPLY_COLOUR, label=label, edgecolor=EDGE_COLOUR, linewidth=edge)
        middle = np.array([angle[angle.size // 2]]) if patch.x is not None else np.array([np.pi])
        axes.annotate(
            f"{number}",
            xy=tuple(_places(middle, (inner[angle.size // 2] + outside) / 2)[:, 0]),
            ha="center",
            va="center",
            fontsize=7,
            color=EDGE_COLOUR,
        )


def _marks(axes: Axes, scene: Bearing, shown: Result, moved: Array, outside: float) -> None:
    """Draw the axes of the bore, the centre of the shaft, the least film, the load and the sense of rotation."""
    reach, far = outside + HIGHEST, outside + HIGHEST + 0.12
    for direction, name in ((0.0, "x"), (np.pi / 2, "y")):
        axes.annotate(
            name,
            xy=(0, 0),
            xytext=(far * np.cos(direction), far * np.sin(direction)),
            arrowprops={"arrowstyle": "<-", "color": "#969696", "linewidth": 0.8},
            color="#737373",
            ha="center",
            va="center",
            zorder=1,
        )
    centre = CLEARANCE * moved
    axes.plot(*centre, "o", color="#08519c", markersize=4)
    least = np.radians(_value(shown, "film_min_angle"))
    axes.plot(
        *_places(np.array([least, least]), np.array([1.0, outside])),
        color=LEAST_COLOUR,
        linewidth=2.2,
        label="least film",
    )
    if scene.load is not None:
        toward = np.array([np.cos(scene.load.angle), np.sin(scene.load.angle)])
        axes.add_patch(
            FancyArrowPatch(
                tuple(centre),
                tuple(centre + 0.7 * toward),
                arrowstyle="-|>",
                mutation_scale=16,
                color=LOAD_COLOUR,
                lw=2,
            )
        )
        axes.plot([], [], color=LOAD_COLOUR, linewidth=2, label="load")
    if scene.load is not None and "attitude_angle" in shown.quantities:
        _attitude(axes, centre, float(np.degrees(scene.load.angle)), _value(shown, "attitude_angle"))
    if scene.motion.speed:
        ends = np.radians((115, 155) if scene.motion.speed > 0 else (155, 115))
        begin, end = (tuple(centre + 0.8 * np.array([np.cos(one), np.sin(one)])) for one in ends)
        bend = "arc3,rad=0.2" if scene.motion.speed > 0 else "arc3,rad=-0.2"
        axes.add_patch(
            FancyArrowPatch(begin, end, arrowstyle="-|>", mutation_scale=12, color="#08519c", connectionstyle=bend)
        )
    axes.set(xlim=(-reach - 0.2, reach + 0.2), ylim=(-reach - 0.2, reach + 0.2))


def _attitude(axes: Axes, centre: Array, load: float, attitude: float) -> None:
    """Draw the line of centres and the attitude angle between it and the load, degrees."""
    line = float(np.degrees(np.arctan2(centre[1], centre[0])))
    axes.plot(*_places(np.radians([line, line]), np.array([0.0, 0.95])), color="#08519c", linewidth=0.9, linestyle=":")
    turned = (line - load + 180) % 360 - 180
    begin, end = (load, load + turned) if turned > 0 else (load + turned, load)
    axes.add_patch(Arc(tuple(centre), 0.9, 0.9, theta1=begin, theta2=end, color="#525252", linewidth=0.9))
    if attitude < LEAST_ATTITUDE:
        return
    between = np.radians((begin + end) / 2)
    axes.annotate(
        f"{attitude:.0f}°",
        xy=tuple(centre + 0.54 * np.array([np.cos(between), np.sin(between)])),
        ha="center",
        va="center",
        fontsize=8,
    )


def _places(angle: Array, radius: Array | float) -> Array:
    """The places at angles and radii, shape (2, n)."""
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)])


def _along(moved: Array, angle: Array) -> Array:
    """The displacement of a shaft along the directions of angles."""
    return np.asarray(moved[0] * np.cos(angle) + moved[1] * np.sin(angle))


def _section(result: Result, field: str) -> Array:
    """A field on the line of the greatest pressure, or in the middle of a width without pressure."""
    largest, values = result.fields["pressure"].values.max(axis=0), result.fields[field].values
    row = int(np.argmax(largest)) if largest.max() > 0 else largest.size // 2
    return np.asarray(values[:, row])


def _value(result: Result, name: str) -> float:
    return result.quantities[name].value
