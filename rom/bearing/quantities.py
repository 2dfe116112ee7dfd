"""What a bearing carries, rubs and leaks, from a film in balance."""

import math

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shapes import Journal
from roughfilm.rom.cavitation.averaged import Averaged
from roughfilm.rom.cavitation.balance import CAVITY, FILM
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.oblique import wetness
from roughfilm.rom.cavitation.solve import Solution

LEAST_LOAD = 1e-6
"""Of the greatest pressure over the whole film; by less, friction is not divided."""


def bearing_quantities(scene: Bearing, found: Solution, pressed: Array | None = None) -> dict[str, Quantity]:
    """Load, friction on the sliding wall, greatest pressure, flows, and where the film is.

    Pressures count from ambient. Per width of the bearing, along the sliding at the line of the greatest pressure:
    ``film_start`` and ``rupture`` are where the first film begins and the last one ends, x/L from the inlet; both are 1
    where there is none. Friction is that of the liquid, F = ∫(η ξ u/h + h/2 ∂p/∂x) dA, where the filled part ξ of a
    cavity is in streamers from wall to wall; of averaged roughness F = ∫(ηu (g (d + 3e) + (ξ - g) B₁ <h⁻²>)
    + B·∇p/2) dA with the wetness g of its tips as :mod:`roughfilm.rom.cavitation.oblique` has it, 1 in a film.

    Where walls touch, ``pressed`` is what that adds to the force on each node, N, and friction has its boundary part.
    """
    grid, pc = found.grid, scene.lubricant.cavitation_pressure
    pressure = found.state.pressure + pc
    width = 1.0 if found.problem.shape.wide else scene.geometry.width or 1.0
    force = grid.areas * pressure if pressed is None else grid.areas * pressure + pressed
    load, rub = float(force.sum()), friction(found)
    if pressed is not None and scene.asperities is not None:
        rub += scene.asperities.friction * float(pressed.sum())
    row = int(np.argmax(np.where(found.kind == FILM, found.state.pressure, -1.0).max(axis=0)))
    start, end = film_ends(found, row)
    values: dict[str, tuple[float, str]] = {
        "load_per_width": (load / width, "N/m"),
        "friction_per_width": (rub / width, "N/m"),
        "pressure_max": (float(pressure.max()), "Pa"),
        "film_start": (start, "1"),
        "rupture": (end, "1"),
        "inlet_flow_per_width": (inlet_flow(found) / width, "m^2/s"),
        "cavitated_fraction": (
            float(grid.areas[found.kind == CAVITY].sum() / grid.areas.sum()),
            "1",
        ),
        "theta_min": (float(density_ratio(found).min()), "1"),
    }
    if isinstance(scene.geometry, Journal):
        angle, load = journal_load(scene.geometry, grid.x if not found.turned else -grid.x, force)
        values["load_per_width"] = (load / width, "N/m")
        values["attitude_angle"] = (angle, "deg")
        if load > 0:
            diameter = 2 * scene.geometry.radius
            ratio = (scene.geometry.radius / scene.geometry.clearance) ** 2
            number = scene.lubricant.viscosity * scene.revolutions * diameter * width / load * ratio
            values["sommerfeld_number"] = (number, "1")
    if not found.problem.shape.wide:
        values["load"] = (load, "N")
        values["friction"] = (rub, "N")
        values["side_leakage"] = (side_leakage(found), "m^3/s")
    if load > LEAST_LOAD * float(grid.areas.sum()) * float(np.abs(force / grid.areas).max()):
        values["friction_coefficient"] = (rub / load, "1")
    return {name: Quantity(value=value, unit=unit) for name, (value, unit) in values.items()}


def density_ratio(found: Solution) -> Array:
    """θ at the nodes, shape (nx, ny); the filled part of a cavity counts at the faces, from which it is taken here."""
    film = 1 + found.problem.compression(found.state.pressure)[0]
    return np.where(found.kind == CAVITY, np.minimum(_carried(found), 1.0), film)


def _carried(found: Solution) -> Array:
    """How full each node is by what flows out of it."""
    mean, rough = found.faces.mean, found.faces.averaged
    thickness = found.faces.thickness if rough is None else rough.drag
    return np.asarray(found.state.fill * np.where(mean > 0, mean, thickness) / thickness)


def friction(found: Solution) -> float:
    """Force on the sliding wall against its motion, N (N/m if wide)."""
    grid, mean, problem = found.grid, found.faces.mean, found.problem
    fluidity = problem.piezoviscosity.fluidity(found.state.pressure, problem.viscosity)[0]
    stretch = grid.spacing_x[:, None] * grid.radius
    speed = problem.speed * (grid.radius if problem.shape.polar else 1.0)
    fill = found.state.fill
    if problem.ends.sides is not None:  # the line where the bath begins is no part of the film
        fill = np.pad(fill[:, 1:-1], ((0, 0), (1, 1)), mode="edge")
    rough = found.faces.averaged
    with np.errstate(divide="ignore", invalid="ignore"):
        rub = fill / mean if rough is None else _rub(rough, fill)
        shear = np.where(mean > 0, problem.viscosity * speed * rub, 0.0)
    shear = shear * (1 / fluidity + np.roll(1 / fluidity, -1, axis=0)) / 2
    rise = np.roll(found.state.pressure, -1, axis=0) - found.state.pressure
    along = float((grid.volume_y * (shear * stretch + mean / 2 * rise)).sum())
    if rough is None or grid.shape[1] == 1:
        return along
    climb = found.state.pressure[:, 1:] - found.state.pressure[:, :-1]
    return along + float((grid.volume_x[:, None] * _towards(grid) * rough.drag_across[:, :-1] / 2 * climb).sum())


def _rub(rough: Averaged, fill: Array) -> Array:
    """Friction over ηu of averaged roughness, 1/m: d + 3e in a film, that of streamers where no tip is wet."""
    return np.asarray(fill * rough.streaming + wetness(fill, rough.threshold) * (rough.wet - rough.streaming))


def _towards(grid: Grid) -> Array:
    """The radius at the faces towards j+1, shape (ny - 1,)."""
    return (grid.radius[1:] + grid.radius[:-1]) / 2


def flow_along(found: Solution) -> Array:
    """What flows through the faces towards i + 1, m³/s (m²/s if wide) at the density of cavitation, shape (nx, ny)."""
    net, state = found.network, found.state
    excess = found.problem.compression(state.pressure)[0]
    east = net.conductance(found.problem.mobility(state.pressure)[0])[0]
    ahead = np.roll(excess, -1, axis=0)
    drift = net.couette * (state.fill + net.upstream * excess + (1 - net.upstream) * ahead)
    rise = np.roll(state.pressure, -1, axis=0) - state.pressure
    return np.asarray(drift - east * rise + (0.0 if net.oblique is None else _slanting(found)[0]))


def _slanting(found: Solution) -> tuple[Array, Array]:
    """What a slanting lay adds to the flows towards i + 1 and j + 1, m³/s."""
    assert found.network.oblique is not None
    state, problem = found.state, found.problem
    excess, mobility = problem.compression(state.pressure)[0], problem.mobility(state.pressure)[0]
    return found.network.oblique.flows(mobility, state.pressure, state.fill, excess)


def inlet_flow(found: Solution) -> float:
    """What enters where sliding comes from, at the density of cavitation, m³/s (m²/s if wide).

    Beside open sides as much as in the row next to them: there the bath flows, and not the film.
    """
    entering = flow_along(found)[0]
    if found.problem.ends.sides is not None:
        share = found.grid.volume_y * found.grid.radius
        entering[[0, -1]] = entering[[1, -2]] * share[[0, -1]] / share[[1, -2]]
    return float(entering.sum())


def side_leakage(found: Solution) -> float:
    """What leaves through both sides, between the nodes of inlet and outlet, at the density of cavitation, m³/s."""
    net, state = found.network, found.state
    north = net.conductance(found.problem.mobility(state.pressure)[0])[1]
    flow = -north[:, :-1] * np.diff(state.pressure, axis=1)
    if net.oblique is not None:
        flow = flow + _slanting(found)[1][:, :-1]
    if not net.periodic[0]:
        flow = flow[1:-1]
    return float((flow[:, -1] - flow[:, 0]).sum()) if not net.periodic[1] else 0.0


def film_ends(found: Solution, row: int) -> tuple[float, float]:
    """Where the first film of a row of nodes begins and the last one ends, x/L, placed inside the cells."""
    x, length = found.grid.x - found.problem.shape.breaks[0], found.problem.shape.length
    film = found.kind[:, row] == FILM
    if not film.any():
        return 1.0, 1.0
    first, last = int(np.argmax(film)), film.size - 1 - int(np.argmax(film[::-1]))
    return _begins(found, row, first, x) / length, _ends(found, row, last, x) / length


def _begins(found: Solution, row: int, first: int, x: Array) -> float:
    """The cavity node before the film is partly full: as full as the film reaches back from its first node."""
    if first == 0 or found.kind[first - 1, row] != CAVITY:
        return float(x[max(first - 1, 0)])
    net, fill = found.network, found.state.fill[:, row]
    if first > 1:
        carried = net.couette[first - 2, row] * fill[first - 2]
    else:
        carried = net.supplied[row] if net.supplied.size else net.couette[0, row] * fill[0]
    empty = carried / net.couette[first - 1, row] if net.couette[first - 1, row] > 0 else 1.0
    part = (fill[first - 1] - empty) / (1 - empty) if empty < 1 else 0.0
    return float(x[first] - (x[first] - x[first - 1]) * min(max(part, 0.0), 1.0))


def _ends(found: Solution, row: int, last: int, x: Array) -> float:
    """Where θ, going back from the nodes behind the film, is 1: between its last node and the second behind it."""
    if last + 2 >= x.size:
        return float(x[min(last + 1, x.size - 1)])
    theta = _carried(found)[:, row]
    steepness = theta[last + 1] - theta[last + 2]
    if steepness <= 0:
        return float(x[last + 1])
    back = (1 - theta[last + 1]) / steepness * (x[last + 2] - x[last + 1])
    return float(min(max(x[last + 1] - back, x[last]), x[last + 2]))


def nominal_area(scene: Bearing, grid: Grid) -> float:
    """What loads are over, m² (m if infinitely wide): the area of the film, but of a journal diameter times width."""
    if isinstance(scene.geometry, Journal):
        return 2 * scene.geometry.radius * (1.0 if grid.shape[1] == 1 else scene.geometry.width or 1.0)
    return float(grid.areas.sum())


def carried(scene: Bearing, x: Array, force: Array) -> float:
    """The load of forces at the nodes, N (N/m if wide): their sum, of a journal as vectors; ``x`` as in the scene."""
    if isinstance(scene.geometry, Journal):
        return journal_load(scene.geometry, x, force)[1]
    return float(force.sum())


def journal_load(geometry: Journal, x: Array, force: Array) -> tuple[float, float]:
    """The attitude angle, degrees, from the narrowest place against the load line, and the load; ``force`` by nodes."""
    angle = (x / geometry.radius)[:, None]
    along, aside = -float((force * np.cos(angle)).sum()), float((force * np.sin(angle)).sum())
    return math.degrees(math.atan2(abs(aside), along)), math.hypot(along, aside)
