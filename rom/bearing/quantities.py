"""The quantities of a converged film: load, friction, pressures and flows."""

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.rom.bearing.geometry.journal import Journal, Shaft
from roughfilm.rom.bearing.geometry.lobes import Lobes
from roughfilm.rom.bearing.geometry.pivoted import Tilting
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.bearing.supply.quantities import supply_values
from roughfilm.rom.bearing.totals.least_film import least_film
from roughfilm.rom.bearing.totals.pads import of_pad
from roughfilm.rom.bearing.totals.rounding import film_round_off
from roughfilm.rom.cavitation.balance import CAVITY, FILM, FIXED
from roughfilm.rom.cavitation.evaluation.filling import density_ratio, filled_fraction
from roughfilm.rom.cavitation.evaluation.flows import flow_across, flow_along
from roughfilm.rom.cavitation.evaluation.friction import drag_of_rows, radius_between
from roughfilm.rom.cavitation.evaluation.peak import peak_pressure
from roughfilm.rom.cavitation.grid import Grid, gaps
from roughfilm.rom.cavitation.solve import Solution

EXACT = ("film_min", "film_min_x", "film_min_y")
"""Quantities that follow from the geometry alone and have no error of the grid."""

MIN_MEAN_PRESSURE_RATIO = 1e-6
"""Mean pressure over the maximum pressure below which no friction coefficient is given."""


def bearing_quantities(scene: Bearing, solution: Solution, pressed: Array | None = None) -> dict[str, Quantity]:
    """The load, friction, power and torque of the sliding wall, pressures, flows and extent of a converged film.

    Pressures are above ambient. ``film_start`` and ``rupture`` are the positions x/L from the inlet, on the line of the
    maximum pressure, where the first film begins and the last one ruptures; both are 1 without a film. Of joined pieces
    without an inlet, ``side_leakage`` is what leaves through a side. The friction of the liquid is
    F = ∫(η ξ u/h + h/2 ∂p/∂x) dA, where a cavity has streamers from wall to wall over its filled fraction ξ;
    with averaged roughness it is F = ∫(ηu (g (d + 3e) + (ξ - g) B₁ <h⁻²>) + B·∇p/2) dA with the wetness g of the tips
    after :mod:`roughfilm.rom.cavitation.oblique`, which is 1 in a film.

    ``power_loss`` is the power that the sliding wall takes, F u, on a ring ω M with the torque M = ∫ r dF; what a
    pressure pumps through the film, p Q, is not in it. ``torque`` is F R of a journal and M of a ring.
    Where the walls approach each other, ``displaced_flow`` is the flow -∫ θ ∂h/∂t dA that they displace.
    ``film_min`` is the least thickness of the film between the mean planes of the walls, at ``film_min_x`` and
    ``film_min_y`` (:func:`roughfilm.rom.bearing.totals.least_film.least_film`), and ``specific_load`` the load over the
    nominal area, p. ``supply_1_flow`` is what the first supply gives to the film, and ``supply_1_pressure`` the
    pressure there, behind its restrictor. ``hersey_number`` is ηN/p of a wall that turns N times a second, and ηu/(pL)
    of one that slides; ``sommerfeld_number`` of a journal is ηN/p (R/c)². A pad about its pivot has ``pivot_film``, its
    slopes, and the moments of its film about the pivot (:func:`roughfilm.rom.bearing.totals.pads.of_pad`); a misaligned
    shaft in lobes has moments about the middle of its width (:func:`shaft_moments`).

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
    boundary = 0.0 if pressed is None else scene.boundary_friction * pressed.sum(axis=0)
    drag = drag_of_rows(solution)
    rows = drag.rows + boundary
    load, resistance = load_of(scene, scene_positions(solution), force), float(rows.sum() + drag.between.sum())
    rounding = film_round_off(scene, solution)["N"]
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
    if problem.opening is not None:
        extensive["displaced_flow"] = (flows.displaced, "m^3/s", "m^2/s")
    values: dict[str, tuple[float, str]] = {
        "pressure_max": (peak_pressure(solution) + pc, "Pa"),
        "specific_load": (specific, "Pa"),
        "film_min": (least.thickness, "m"),
        "film_min_x": (least.x, "rad" if problem.shape.polar else "m"),
        "film_start": (start, "1"),
        "rupture": (end, "1"),
        "cavitated_fraction": (
            float(grid.areas[solution.kind == CAVITY].sum() / (problem.shape.film_fraction * grid.areas.sum())),
            "1",
        ),
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
    values |= supply_values(scene, solution)
    if isinstance(scene.geometry, Journal):
        if load > rounding:
            values["attitude_angle"] = (journal_load(scene.geometry, scene_positions(solution), force)[0], "deg")
    elif isinstance(scene.geometry, Lobes):
        values |= _of_shaft(scene.geometry, scene_positions(solution), force, rounding)
        if any(scene.geometry.misalignment):
            values |= shaft_moments(scene.geometry, scene_positions(solution), grid.y, force)
        values["film_min_angle"] = (
            math.degrees(math.remainder(float(scene.geometry.angle(np.array(least.x))), 2 * math.pi)),
            "deg",
        )
        if not scene.geometry.single:  # films of several lobes have no one beginning
            values = {name: value for name, value in values.items() if name not in ("film_start", "rupture")}
    elif isinstance(scene.geometry, Tilting):
        values |= of_pad(scene.geometry, scene_positions(solution), grid.y, force)
    if load > max(rounding, MIN_MEAN_PRESSURE_RATIO * float(grid.areas.sum() * np.abs(force / grid.areas).max())):
        values["friction_coefficient"] = (resistance / load, "1")
        values |= {name: (number, "1") for name, number in numbers_of_load(scene, specific).items()}
    return {name: Quantity(value=value, unit=unit) for name, (value, unit) in values.items()}


def _torque(scene: Bearing, between: Array, rows: Array, grid: Grid) -> float | None:
    """The torque on a wall that turns, N m (N if infinitely wide); None of a wall that slides."""
    if isinstance(scene.geometry, Shaft):
        return scene.geometry.radius * float(rows.sum() + between.sum())
    if scene.turning_radius is None:
        return None
    return float((rows * grid.radius).sum() + (between * radius_between(grid)).sum())


def numbers_of_load(scene: Bearing, specific: float) -> dict[str, float]:
    """The Hersey number of a specific load, Pa, and the Sommerfeld number of a journal."""
    geometry, radius, speed = scene.geometry, scene.turning_radius, abs(scene.motion.speed)
    frequency = speed / geometry.length if radius is None else speed / (2 * math.pi * radius)
    hersey = scene.lubricant.viscosity * frequency / specific
    if not isinstance(geometry, Shaft):
        return {"hersey_number": hersey}
    return {"hersey_number": hersey, "sommerfeld_number": hersey * (geometry.radius / geometry.clearance) ** 2}


@dataclass(frozen=True, kw_only=True)
class Flows:
    """Flows at cavitation density, m³/s (m²/s if infinitely wide).

    What enters, inlet, supplies and displaced, equals what leaves, outlet + low + high.

    Attributes
    ----------
    inlet, outlet : flow in through the inlet and flow out through the outlet; None of joined pieces.
    low, high : flows out through the sides at the lowest and at the highest y; zero without open sides.
    displaced : flow -∫ θ ∂h/∂t dA that walls displace which approach each other; negative where they part.
    supplied : whether lubricant is supplied inside of the film.
    gaps : for each gap between films the flows of the rows of nodes out of the film before it and into the one behind
        it, each of shape (ny,).
    """

    inlet: float | None
    outlet: float | None
    low: float
    high: float
    supplied: bool = False
    displaced: float = 0.0
    gaps: tuple[tuple[Array, Array], ...] = ()

    @property
    def side_leakage(self) -> float:
        """The net flow out through both sides; without inlet and supplies what leaves through one side or both."""
        if self.supplied or self.inlet is not None:
            return self.low + self.high
        return max(self.low, 0.0) + max(self.high, 0.0)


def boundary_flows(solution: Solution) -> Flows:
    """The flows through the edges of a film, from the balances of its control volumes; second-order accurate.

    The control volumes of the outermost rows are half as wide as the others, and the nodes on open sides belong to the
    bath. What flows along such a row enters with it at the inlet, leaves with it at the outlet, and the difference
    passes the side. The flow along it is three quarters that at the side, with the filling of the row next to it, and
    one quarter that of the row next to it, as the middle of the half row lies a quarter of a cell from the side. The
    control volumes of the edges store liquid as the others do where the walls approach each other.
    """
    along, grid, open_sides = flow_along(solution), solution.grid, solution.problem.ends.sides is not None
    across = flow_across(solution) if open_sides else np.zeros((grid.x.size, 2))
    low, high = -float(across[:, 0].sum()), float(across[:, -2].sum())
    stored, joined = stored_flow(solution), solution.network.periodic[0] and not solution.problem.shape.idle
    displaced, supplied = 0.0 - float(stored.sum()), bool(solution.problem.inflows)
    if open_sides:
        beside = stored if solution.network.periodic[0] else stored[1:-1]
        low, high = low - float(beside[:, 0].sum()), high - float(beside[:, -1].sum())
    if joined:
        return Flows(inlet=None, outlet=None, low=low, high=high, supplied=supplied, displaced=displaced)
    fill, couette, widths = solution.state.fill, solution.network.couette, grid.volume_y * grid.radius
    for row, inner in ((0, 1), (-1, -2)) if open_sides else ():
        filled = along[:, row] + couette[:, row] * (fill[:, inner] - fill[:, row])
        along[:, row] = 0.75 * filled + 0.25 * along[:, inner] * widths[row] / widths[inner]
    between = gaps(solution.problem.shape, grid)
    if between:
        film = np.ones(grid.x.size, dtype=bool)
        film[np.concatenate(between)] = False
        begins = np.array([nodes[-1] for nodes in between])
        ends = np.sort([(nodes[0] - 1) % grid.x.size for nodes in between])
        low, high = -float(across[film, 0].sum()), float(across[film, -2].sum())
        entering = leaving = 0.0
    else:
        begins, ends = np.array([0]), np.array([along.shape[0] - 2])
        through = across[[0, -1], -2] - across[[0, -1], 0]
        entering, leaving = float(stored[0].sum() + through[0]), -float(stored[-1].sum() + through[1])
    passed = along[begins].sum(axis=0) - along[ends].sum(axis=0) if open_sides else np.zeros(1)
    return Flows(
        inlet=float(along[begins].sum()) + entering,
        outlet=float(along[ends].sum()) + leaving,
        low=low + float(passed[0]),
        high=high + float(passed[-1]),
        supplied=supplied,
        displaced=displaced,
        gaps=tuple((along[nodes[0] - 1], along[nodes[-1]]) for nodes in between),
    )


def stored_flow(solution: Solution) -> Array:
    """The flow θ ∂h/∂t that the control volume of each node takes up, m³/s, shape (nx, ny).

    A node on an open edge has the filling of the node next to it, as no liquid enters a cavity through the edge, but
    one at an inlet through which sliding carries liquid.
    """
    net, fill = solution.network, solution.state.fill
    if not net.periodic[0]:
        first = fill[1:2] if solution.problem.speed == 0 else fill[:1]
        fill = np.concatenate([first, fill[1:-1], fill[-2:-1]])
    if solution.problem.ends.sides is not None:
        fill = np.pad(fill[:, 1:-1], ((0, 0), (1, 1)), mode="edge")
    filled = fill + solution.problem.compression(solution.state.pressure)[0]
    return np.asarray(net.storage * filled - net.stored)


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
    """The position where a film begins, m: the filled fraction of the cavity node before it places it in the cell.

    At rest the film covers this fraction of the control volume of the node.
    """
    if first == 0 or solution.kind[first - 1, row] != CAVITY:
        return float(x[max(first - 1, 0)])
    net, fill = solution.network, solution.state.fill[:, row]
    if solution.problem.speed == 0:
        return float(x[first] - (x[first] - x[first - 1]) * (0.5 + fill[first - 1]))
    if first > 1:
        inflow = net.couette[first - 2, row] * fill[first - 2]
    else:
        inflow = net.supplied[row] if net.supplied.size else net.couette[0, row] * fill[0]
    empty = inflow / net.couette[first - 1, row] if net.couette[first - 1, row] > 0 else 1.0
    fraction = (fill[first - 1] - empty) / (1 - empty) if empty < 1 else 0.0
    return float(x[first] - (x[first] - x[first - 1]) * min(max(fraction, 0.0), 1.0))


def _ends(solution: Solution, row: int, last: int, x: Array) -> float:
    """The position where a film ends, m: θ extrapolated to 1 from the two nodes behind it, at rest as it begins.

    A cavity of one node before an end of the film begins at this node.
    """
    if last + 2 >= x.size or solution.kind[last + 2, row] != CAVITY:
        return float(x[min(last + 1, x.size - 1)])
    if solution.problem.speed == 0:
        return float(x[last + 1] + (x[last + 1] - x[last]) * (solution.state.fill[last + 1, row] - 0.5))
    theta = filled_fraction(solution)[:, row]
    fall = theta[last + 1] - theta[last + 2]
    if fall <= 0:
        return float(x[last + 1])
    back = (1 - theta[last + 1]) / fall * (x[last + 2] - x[last + 1])
    return float(min(max(x[last + 1] - back, x[last]), x[last + 2]))


def nominal_area(scene: Bearing, grid: Grid) -> float:
    """The nominal area, m² (m if infinitely wide): the area of the film; of a journal bearing diameter times width."""
    if isinstance(scene.geometry, Shaft):
        return 2 * scene.geometry.radius * (1.0 if grid.shape[1] == 1 else scene.geometry.width or 1.0)
    return float(grid.areas.sum())


def scene_positions(solution: Solution) -> Array:
    """The positions of the nodes along the x of the scene, m."""
    x, breaks = solution.grid.x, solution.problem.shape.breaks
    return breaks[0] + breaks[-1] - x if solution.turned else x


def load_of(scene: Bearing, x: Array, force: Array) -> float:
    """The load of forces at the nodes, N (N/m if infinitely wide): their sum, in a journal bearing their vector sum.

    ``x`` is the position in the coordinates of the scene, m.
    """
    if isinstance(scene.geometry, Journal):
        return journal_load(scene.geometry, x, force)[1]
    if isinstance(scene.geometry, Lobes):
        return math.hypot(*shaft_force(scene.geometry, x, force))
    return float(force.sum())


def shaft_force(geometry: Lobes, x: Array, force: Array) -> tuple[float, float]:
    """The force along x and y on a shaft in lobes, N, by forces at the nodes, which push it away from the bore."""
    angle = geometry.angle(x)[:, None]
    return -float((force * np.cos(angle)).sum()), -float((force * np.sin(angle)).sum())


def _of_shaft(geometry: Lobes, x: Array, force: Array, rounding: float) -> dict[str, tuple[float, str]]:
    """The place of a shaft in lobes: its eccentricity, and the angle from the load it carries, in its rotation.

    A force not larger than ``rounding``, N, has no direction.
    """
    along_x, along_y = geometry.eccentricity or (0.0, 0.0)
    push_x, push_y = shaft_force(geometry, x, force)
    values = {
        "eccentricity": (math.hypot(along_x, along_y), "1"),
        "eccentricity_x": (along_x, "1"),
        "eccentricity_y": (along_y, "1"),
    }
    values |= {f"tilt_{pad + 1}": (tilt, "rad") for pad, tilt in enumerate(geometry.tilts or ())}
    if math.hypot(push_x, push_y) > rounding and math.hypot(along_x, along_y):
        turned = math.atan2(along_y, along_x) - math.atan2(-push_y, -push_x)
        values["attitude_angle"] = (abs(math.degrees(math.remainder(turned, 2 * math.pi))), "deg")
    return values


def shaft_moments(geometry: Lobes, x: Array, y: Array, force: Array) -> dict[str, tuple[float, str]]:
    """The moments on a shaft in lobes about the middle of its width, N m, by forces at the nodes.

    With the force (F_x, F_y) at the distance ζ from the middle they are M_x = -Σ ζ F_y and M_y = Σ ζ F_x: they turn y
    towards the axis, and the axis towards x.
    """
    push_x, push_y = shaft_force(geometry, x, force * (y - (geometry.width or 0.0) / 2))
    return {"moment_x": (-push_y, "N*m"), "moment_y": (push_x, "N*m")}


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
    iteration_uncertainties : iteration_uncertainties(scene, levels, quantities): uncertainty of each quantity, in its
        unit, that an iteration around the film leaves, from the films on their grids, the finest first.
    details : details(solution): further numbers of the solver by name.
    warnings : warnings(scene, solution): warnings in addition to those of every film.
    outside : outside(scene, solution): the ways in which it is outside the range of the model, in addition to those
        of every film.
    of_finest : of_finest(scene, solution): estimates without uncertainty, of the finest film alone.
    estimates : quantities that may have no uncertainty for a reason that a warning of their own states.
    """

    quantities: Callable[[Bearing, Solution], dict[str, Quantity]] = bearing_quantities
    factor_uncertainties: Callable[[Bearing, Solution, Mapping[str, Quantity]], Mapping[str, float]] = (
        factor_uncertainties
    )
    fields: Callable[[Bearing, Solution], Fields] = lambda _scene, _solution: {}
    iteration_uncertainties: Callable[[Bearing, Sequence[Solution], Mapping[str, Quantity]], Mapping[str, float]] = (
        lambda _scene, _levels, _quantities: {}
    )
    details: Callable[[Solution], Mapping[str, float]] = lambda _solution: {}
    warnings: Callable[[Bearing, Solution], Sequence[str]] = lambda _scene, _solution: ()
    outside: Callable[[Bearing, Solution], tuple[str, ...]] = lambda _scene, _solution: ()
    of_finest: Callable[[Bearing, Solution], Mapping[str, Quantity]] = lambda _scene, _solution: {}
    estimates: Collection[str] = ()

    @property
    def searched(self) -> "Outputs":
        """The functions that evaluate a film on the way to another one: without estimates and warnings."""
        return replace(self, warnings=FILM_OUTPUTS.warnings, of_finest=FILM_OUTPUTS.of_finest)


FILM_OUTPUTS = Outputs()
