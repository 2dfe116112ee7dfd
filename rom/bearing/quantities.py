"""The quantities of a converged film: load, friction, pressures and flows."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.shapes import Journal
from roughfilm.rom.bearing.totals.least_film import least_film
from roughfilm.rom.cavitation.averaged import Averaged
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED
from roughfilm.rom.cavitation.grid import Grid
from roughfilm.rom.cavitation.oblique import wetness
from roughfilm.rom.cavitation.solve import Solution

EXACT = ("film_min", "film_min_x", "film_min_y")
"""Quantities that follow from the geometry alone and have no error of the grid."""

MIN_MEAN_PRESSURE_RATIO = 1e-6
"""Mean pressure over the maximum pressure below which no friction coefficient is given."""


def bearing_quantities(scene: Bearing, solution: Solution, pressed: Array | None = None) -> dict[str, Quantity]:
    """The load, friction, power and torque of the sliding wall, pressures, flows and extent of a converged film.

    Pressures are above ambient. ``film_start`` and ``rupture`` are the positions x/L from the inlet, on the line of the
    maximum pressure, where the first film begins and the last one ruptures; both are 1 without a film. Of joined pieces
    without an inlet, ``side_leakage`` is what passes from one side to the other. The friction of the liquid is
    F = ∫(η ξ u/h + h/2 ∂p/∂x) dA, where a cavity has streamers from wall to wall over its filled fraction ξ;
    with averaged roughness it is F = ∫(ηu (g (d + 3e) + (ξ - g) B₁ <h⁻²>) + B·∇p/2) dA with the wetness g of the tips
    after :mod:`roughfilm.rom.cavitation.oblique`, which is 1 in a film.

    ``power_loss`` is the power that the sliding wall takes, F u, on a ring ω M with the torque M = ∫ r dF; what a
    pressure pumps through the film, p Q, is not in it. ``torque`` is F R of a journal and M of a ring.
    ``film_min`` is the least thickness of the film between the mean planes of the walls, at ``film_min_x`` and
    ``film_min_y`` (:func:`roughfilm.rom.bearing.totals.least_film.least_film`), and ``specific_load`` the load over the
    nominal area, p. ``hersey_number`` is ηN/p of a wall that turns N times a second, and ηu/(pL) of one that slides;
    ``sommerfeld_number`` of a journal is ηN/p (R/c)².

    Parameters
    ----------
    pressed : contact force of asperities on each node, N, shape (nx, ny); boundary friction is then added.

    Sources: Hersey 1914, J. Wash. Acad. Sci. 4, 542, for ηN/p; Raimondi and Boyd 1958,
    doi:10.1080/05698195808972328, for ηN/p (R/c)².
    """
    grid, pc, problem = solution.grid, scene.lubricant.cavitation_pressure, solution.problem
    pressure = solution.state.pressure + pc
    width = 1.0 if problem.shape.wide else scene.geometry.width or 1.0
    force = grid.areas * pressure if pressed is None else grid.areas * pressure + pressed
    boundary = 0.0 if pressed is None or scene.asperities is None else scene.asperities.friction * pressed.sum(axis=0)
    drag = drag_of_rows(solution)
    rows = drag.rows + boundary
    load, resistance = load_of(scene, scene_positions(solution), force), float(rows.sum() + drag.between.sum())
    row = int(np.argmax(np.where(solution.kind == FILM, solution.state.pressure, -1.0).max(axis=0)))
    start, end = film_ends(solution, row)
    flows = boundary_flows(solution)
    specific, least = load / nominal_area(scene, grid), least_film(scene.geometry, turned=solution.turned)
    extensive: dict[str, tuple[float, str, str]] = {"load": (load, "N", "N/m"), "friction": (resistance, "N", "N/m")}
    torque = _torque(scene, drag.between, rows, grid)
    power = abs(problem.speed) * (torque if torque is not None and problem.shape.polar else resistance)
    extensive["power_loss"] = (power, "W", "W/m")
    if torque is not None:
        extensive["torque"] = (torque, "N*m", "N")
    for name, flow in (("inlet_flow", flows.inlet), ("outlet_flow", flows.outlet)):
        if flow is not None:
            extensive[name] = (flow, "m^3/s", "m^2/s")
    values: dict[str, tuple[float, str]] = {
        "pressure_max": (peak_pressure(solution) + pc, "Pa"),
        "specific_load": (specific, "Pa"),
        "film_min": (least.thickness, "m"),
        "film_min_x": (least.x, "rad" if problem.shape.polar else "m"),
        "film_start": (start, "1"),
        "rupture": (end, "1"),
        "cavitated_fraction": (float(grid.areas[solution.kind == CAVITY].sum() / grid.areas.sum()), "1"),
        "theta_min": (float(density_ratio(solution).min()), "1"),
    }
    if not problem.shape.wide:
        values |= {
            "film_min_y": (least.y, "m"),
            "side_leakage": (flows.side_leakage, "m^3/s"),
            "side_leakage_low": (flows.low, "m^3/s"),
            "side_leakage_high": (flows.high, "m^3/s"),
        }
        values |= {name: (value, unit) for name, (value, unit, _) in extensive.items()}
    values |= {f"{name}_per_width": (value / width, unit) for name, (value, _, unit) in extensive.items()}
    if isinstance(scene.geometry, Journal):
        values["attitude_angle"] = (journal_load(scene.geometry, scene_positions(solution), force)[0], "deg")
    if load > MIN_MEAN_PRESSURE_RATIO * float(grid.areas.sum()) * float(np.abs(force / grid.areas).max()):
        values["friction_coefficient"] = (resistance / load, "1")
        values |= {name: (number, "1") for name, number in numbers_of_load(scene, specific).items()}
    return {name: Quantity(value=value, unit=unit) for name, (value, unit) in values.items()}


def _torque(scene: Bearing, between: Array, rows: Array, grid: Grid) -> float | None:
    """The torque on a wall that turns, N m (N if infinitely wide); None of a wall that slides."""
    if isinstance(scene.geometry, Journal):
        return scene.geometry.radius * float(rows.sum() + between.sum())
    if scene.turning_radius is None:
        return None
    return float((rows * grid.radius).sum() + (between * _towards(grid)).sum())


def numbers_of_load(scene: Bearing, specific: float) -> dict[str, float]:
    """The Hersey number of a specific load, Pa, and the Sommerfeld number of a journal."""
    geometry, radius, speed = scene.geometry, scene.turning_radius, abs(scene.motion.speed)
    frequency = speed / geometry.length if radius is None else speed / (2 * math.pi * radius)
    hersey = scene.lubricant.viscosity * frequency / specific
    if not isinstance(geometry, Journal):
        return {"hersey_number": hersey}
    return {"hersey_number": hersey, "sommerfeld_number": hersey * (geometry.radius / geometry.clearance) ** 2}


def peak_pressure(solution: Solution) -> float:
    """The largest pressure above cavitation pressure, Pa: of a parabola through the highest node and its neighbours.

    p + gᵀ(-H)⁻¹g/2 with the central differences g and H, in the directions in which the highest node lies inside a film
    with equal cells. At a break of the film thickness the pressure may have a kink; the highest node then is the peak.
    """
    pressure, nodes = solution.state.pressure, solution.grid
    shape, (i, j) = solution.problem.shape, (int(at) for at in np.unravel_index(np.argmax(pressure), pressure.shape))
    top = float(pressure[i, j])
    ways = [
        _smooth(place, at, spacing, breaks, periodic=periodic)
        for place, at, spacing, breaks, periodic in (
            (nodes.x, i, nodes.spacing_x, shape.breaks, solution.network.periodic[0]),
            (nodes.y, j, nodes.spacing_y, shape.steps_across, solution.network.periodic[1]),
        )
    ]
    around = pressure.take(range(i - 1, i + 2), axis=0, mode="wrap").take(range(j - 1, j + 2), axis=1, mode="wrap")
    film = solution.kind.take(range(i - 1, i + 2), axis=0, mode="wrap").take(range(j - 1, j + 2), axis=1, mode="wrap")
    if not (film[1 - ways[0] : 2 + ways[0], 1 - ways[1] : 2 + ways[1]] == FILM).all():
        return top
    slope = np.array([around[2, 1] - around[0, 1], around[1, 2] - around[1, 0]]) / 2
    mixed = (around[2, 2] - around[2, 0] - around[0, 2] + around[0, 0]) / 4
    bend = np.array(
        [
            [2 * top - around[2, 1] - around[0, 1], -mixed],
            [-mixed, 2 * top - around[1, 2] - around[1, 0]],
        ]
    )
    slope, bend = slope[ways], bend[np.ix_(ways, ways)]
    if not (slope.any() and np.linalg.eigvalsh(bend).min() > 0):
        return top
    offset = np.linalg.solve(bend, slope)
    return top + float(slope @ offset) / 2 if np.abs(offset).max() <= 1 else top


def _smooth(places: Array, at: int, spacing: Array, breaks: Sequence[float], *, periodic: bool) -> bool:
    """Whether a node lies between two equal cells and at no break."""
    if places.size < 3 or not (periodic or 0 < at < places.size - 1):
        return False
    before, after = spacing[at - 1], spacing[at]
    return bool(abs(before - after) <= 1e-6 * after and (np.abs(places[at] - np.array(breaks)) > 1e-6 * after).all())


def density_ratio(solution: Solution) -> Array:
    """The density ratio θ at the nodes, shape (nx, ny), in cavities that of the liquid that flows out of the node."""
    film = 1 + solution.problem.compression(solution.state.pressure)[0]
    return np.where(solution.kind == CAVITY, np.minimum(_filled_fraction(solution), 1.0), film)


def _filled_fraction(solution: Solution) -> Array:
    """The filled fraction of each node according to the flow out of it."""
    mean, rough = solution.faces.mean, solution.faces.averaged
    thickness = solution.faces.thickness if rough is None else rough.drag
    return np.asarray(_carried(solution) * np.where(mean > 0, mean, thickness) / thickness)


def _carried(solution: Solution) -> Array:
    """ξ of each node, in cavities the flow out of the node over that through the whole face full of liquid."""
    mean, fill = solution.faces.mean, solution.state.fill
    parts = solution.faces.parts[0, : len(solution.network.part_couette)]
    share = np.divide(np.minimum(mean, parts.min(axis=0, initial=np.inf)), mean, out=np.ones_like(mean), where=mean > 0)
    return np.where(solution.kind == CAVITY, share * fill, fill)


def friction(solution: Solution) -> float:
    """The force on the sliding wall against its motion, N (N/m if infinitely wide)."""
    drag = drag_of_rows(solution)
    return float(drag.rows.sum() + drag.between.sum())


@dataclass(frozen=True, kw_only=True)
class Drag:
    """The force of the liquid on the sliding wall against its motion, N (N/m if infinitely wide).

    Attributes
    ----------
    rows : the part of the shear and of the pressure gradient along the sliding, for each row of nodes, shape (ny,).
    between : that of the pressure gradient across the sliding, between neighbouring rows, shape (ny - 1,); only an
        averaged oblique lay has one.
    """

    rows: Array
    between: Array


def drag_of_rows(solution: Solution) -> Drag:
    """The friction of the liquid, row by row."""
    grid, mean, problem = solution.grid, solution.faces.mean, solution.problem
    fluidity = problem.piezoviscosity.fluidity(solution.state.pressure, problem.viscosity)[0]
    stretch = grid.spacing_x[:, None] * grid.radius
    speed = problem.speed * (grid.radius if problem.shape.polar else 1.0)
    fill = _carried(solution)
    if problem.ends.sides is not None:  # the outermost lines belong to the bath
        fill = np.pad(fill[:, 1:-1], ((0, 0), (1, 1)), mode="edge")
    rough = solution.faces.averaged
    with np.errstate(divide="ignore", invalid="ignore"):
        gradient = fill / mean if rough is None else _shear_factor(solution, rough, fill)
        shear = np.where(mean > 0, problem.viscosity * speed * gradient, 0.0)
    shear = shear * (1 / fluidity + np.roll(1 / fluidity, -1, axis=0)) / 2
    rise = np.roll(solution.state.pressure, -1, axis=0) - solution.state.pressure
    along = (grid.volume_y * (shear * stretch + mean / 2 * rise)).sum(axis=0)
    if rough is None or grid.shape[1] == 1:
        return Drag(rows=along, between=np.zeros(grid.shape[1] - 1))
    climb = solution.state.pressure[:, 1:] - solution.state.pressure[:, :-1]
    across = grid.volume_x[:, None] * _towards(grid) * rough.drag_across[:, :-1] / 2 * climb
    return Drag(rows=along, between=across.sum(axis=0))


def _shear_factor(solution: Solution, rough: Averaged, fill: Array) -> Array:
    """Friction over ηu of averaged roughness, 1/m: d + 3e in a film, that of streamers where the tips are dry."""
    return np.asarray(fill * rough.streaming + _wetness(solution, rough, fill) * (rough.wet - rough.streaming))


def _wetness(solution: Solution, rough: Averaged, fill: Array) -> Array:
    """The wetness g of the tips at the faces towards i + 1, where a film begins the mean over cavity and film."""
    couette, kind = solution.network.couette, solution.kind
    inflow = np.roll(flow_along(solution), 1, axis=0)
    if solution.network.supplied.size:
        inflow[0] = solution.network.supplied
    empty = np.clip(np.divide(inflow, couette, out=np.zeros_like(couette), where=couette > 0), 0.0, fill)
    film = np.divide(fill - empty, 1 - empty, out=np.zeros_like(fill), where=empty < 1)
    begins = (kind == CAVITY) & (np.roll(kind, -1, axis=0) == FILM)
    of_cavity = wetness(np.where(begins, empty, fill), rough.threshold)
    return np.where(begins, film + (1 - film) * of_cavity, of_cavity)


def _towards(grid: Grid) -> Array:
    """The radius at the faces towards j + 1, shape (ny - 1,)."""
    return (grid.radius[1:] + grid.radius[:-1]) / 2


def flow_along(solution: Solution) -> Array:
    """The flow through the faces towards i + 1 at cavitation density, m³/s (m²/s if wide), shape (nx, ny)."""
    net, state = solution.network, solution.state
    excess = solution.problem.compression(state.pressure)[0]
    mobility = solution.problem.mobility(state.pressure)[0]
    east = net.conductance(mobility)[0]
    ahead = np.roll(excess, -1, axis=0)
    drift = net.couette * (state.fill + net.upstream * excess + (1 - net.upstream) * ahead)
    rise = np.roll(state.pressure, -1, axis=0) - state.pressure
    flow = net.least_flow(drift - east * rise, state, excess, mobility)
    return np.asarray(flow + (0.0 if net.oblique is None else _oblique_flows(solution)[0]))


def _oblique_flows(solution: Solution) -> tuple[Array, Array]:
    """The additional flows of an oblique lay towards i + 1 and j + 1, m³/s."""
    assert solution.network.oblique is not None
    state, problem = solution.state, solution.problem
    excess, mobility = problem.compression(state.pressure)[0], problem.mobility(state.pressure)[0]
    return solution.network.oblique.flows(mobility, state.pressure, state.fill, excess)


def flow_across(solution: Solution) -> Array:
    """The flow through the faces towards j + 1 at cavitation density, m³/s, shape (nx, ny); zero for the last j."""
    net, state = solution.network, solution.state
    north = net.conductance(solution.problem.mobility(state.pressure)[0])[1]
    flow = -north * (np.roll(state.pressure, -1, axis=1) - state.pressure)
    return np.asarray(flow if net.oblique is None else flow + _oblique_flows(solution)[1])


@dataclass(frozen=True, kw_only=True)
class Flows:
    """Flows at cavitation density, m³/s (m²/s if infinitely wide): inlet = outlet + low + high.

    Attributes
    ----------
    inlet, outlet : flow in through the inlet and flow out through the outlet; None of joined pieces.
    low, high : flows out through the sides at the lowest and at the highest y; zero without open sides.
    """

    inlet: float | None
    outlet: float | None
    low: float
    high: float

    @property
    def side_leakage(self) -> float:
        """The net flow out through both sides; without an inlet what passes from one side to the other."""
        return max(self.low, self.high) if self.inlet is None else self.low + self.high


def boundary_flows(solution: Solution) -> Flows:
    """The flows through the edges of a film, from the balances of its control volumes; second-order accurate.

    The control volumes of the outermost rows are half as wide as the others, and the nodes on open sides belong to the
    bath. What flows along such a row enters with it at the inlet, leaves with it at the outlet, and the difference
    passes the side. The flow along it is three quarters that at the side, with the filling of the row next to it, and
    one quarter that of the row next to it, as the middle of the half row lies a quarter of a cell from the side.
    """
    along, grid, open_sides = flow_along(solution), solution.grid, solution.problem.ends.sides is not None
    across = flow_across(solution) if open_sides else np.zeros((grid.x.size, 2))
    low, high = -float(across[:, 0].sum()), float(across[:, -2].sum())
    if solution.network.periodic[0]:
        return Flows(inlet=None, outlet=None, low=low, high=high)
    if not open_sides:
        return Flows(inlet=float(along[0].sum()), outlet=float(along[-2].sum()), low=low, high=high)
    fill, couette, widths = solution.state.fill, solution.network.couette, grid.volume_y * grid.radius
    for row, inner in ((0, 1), (-1, -2)):
        filled = along[:, row] + couette[:, row] * (fill[:, inner] - fill[:, row])
        along[:, row] = 0.75 * filled + 0.25 * along[:, inner] * widths[row] / widths[inner]
    through_columns = across[[0, -1], -2] - across[[0, -1], 0]
    passed = along[0] - along[-2]
    return Flows(
        inlet=float(along[0].sum() + through_columns[0]),
        outlet=float(along[-2].sum() - through_columns[1]),
        low=low + float(passed[0]),
        high=high + float(passed[-1]),
    )


def film_ends(solution: Solution, row: int) -> tuple[float, float]:
    """The positions x/L, interpolated within cells, where the first film of a row begins and the last one ruptures.

    A film that forms again before the outlet does not rupture, and one at an inlet above the cavitation pressure begins
    there; both may be thinner than a cell. Without a film both are 1.
    """
    x, length = solution.grid.x - solution.problem.shape.breaks[0], solution.problem.shape.length
    film = solution.kind[:, row] == FILM
    if not film.any():
        return 1.0, 1.0
    ruptures = np.flatnonzero(film[:-1] & (solution.kind[1:, row] == CAVITY))
    end = _ends(solution, row, int(ruptures[-1]), x) / length if ruptures.size else 1.0
    if solution.kind[0, row] == FIXED and solution.state.pressure[0, row] > 0:
        return 0.0, end
    return _begins(solution, row, int(np.argmax(film)), x) / length, end


def _begins(solution: Solution, row: int, first: int, x: Array) -> float:
    """The position where a film begins, m: the filled fraction of the cavity node before it places it in the cell."""
    if first == 0 or solution.kind[first - 1, row] != CAVITY:
        return float(x[max(first - 1, 0)])
    net, fill = solution.network, solution.state.fill[:, row]
    if first > 1:
        inflow = net.couette[first - 2, row] * fill[first - 2]
    else:
        inflow = net.supplied[row] if net.supplied.size else net.couette[0, row] * fill[0]
    empty = inflow / net.couette[first - 1, row] if net.couette[first - 1, row] > 0 else 1.0
    fraction = (fill[first - 1] - empty) / (1 - empty) if empty < 1 else 0.0
    return float(x[first] - (x[first] - x[first - 1]) * min(max(fraction, 0.0), 1.0))


def _ends(solution: Solution, row: int, last: int, x: Array) -> float:
    """The position where a film ends, m: θ extrapolated to 1 from the two nodes behind it."""
    if last + 2 >= x.size:
        return float(x[min(last + 1, x.size - 1)])
    theta = _filled_fraction(solution)[:, row]
    fall = theta[last + 1] - theta[last + 2]
    if fall <= 0:
        return float(x[last + 1])
    back = (1 - theta[last + 1]) / fall * (x[last + 2] - x[last + 1])
    return float(min(max(x[last + 1] - back, x[last]), x[last + 2]))


def nominal_area(scene: Bearing, grid: Grid) -> float:
    """The nominal area, m² (m if infinitely wide): the area of the film; of a journal bearing diameter times width."""
    if isinstance(scene.geometry, Journal):
        return 2 * scene.geometry.radius * (1.0 if grid.shape[1] == 1 else scene.geometry.width or 1.0)
    return float(grid.areas.sum())


def scene_positions(solution: Solution) -> Array:
    """The positions of the nodes in the direction of the scene's x, m, up to a constant (one turn of a journal)."""
    return -solution.grid.x if solution.turned else solution.grid.x


def load_of(scene: Bearing, x: Array, force: Array) -> float:
    """The load of forces at the nodes, N (N/m if infinitely wide): their sum, in a journal bearing their vector sum.

    ``x`` is the position in the coordinates of the scene, m.
    """
    if isinstance(scene.geometry, Journal):
        return journal_load(scene.geometry, x, force)[1]
    return float(force.sum())


def journal_load(geometry: Journal, x: Array, force: Array) -> tuple[float, float]:
    """The attitude angle, degrees, and the load, N, of forces at the nodes of a journal bearing."""
    angle = (x / geometry.radius)[:, None]
    along, aside = -float((force * np.cos(angle)).sum()), float((force * np.sin(angle)).sum())
    return math.degrees(math.atan2(abs(aside), along)), math.hypot(along, aside)


def factor_uncertainties(scene: Bearing, _solution: Solution, quantities: Mapping[str, Quantity]) -> dict[str, float]:
    """The uncertainty of each quantity that comes from the flow factors, in its unit."""
    relative = 0.0 if scene.roughness is None else scene.roughness.factor_uncertainty(scene.geometry.thinnest)
    return {name: abs(quantity.value) * relative for name, quantity in quantities.items()}


Fields = dict[str, tuple[Array, str]]
"""Fields over the grid, shape (nx, ny), with their units."""


@dataclass(frozen=True, kw_only=True)
class Outputs:
    """The functions that evaluate a converged film.

    Attributes
    ----------
    quantities : quantities(scene, solution).
    factor_uncertainties : factor_uncertainties(scene, solution, quantities): uncertainty of each quantity, in its unit,
        that comes from flow factors and contact pressures.
    fields : fields(scene, solution): fields in addition to those of every film.
    """

    quantities: Callable[[Bearing, Solution], dict[str, Quantity]] = bearing_quantities
    factor_uncertainties: Callable[[Bearing, Solution, Mapping[str, Quantity]], Mapping[str, float]] = (
        factor_uncertainties
    )
    fields: Callable[[Bearing, Solution], Fields] = lambda _scene, _solution: {}


FILM_OUTPUTS = Outputs()
