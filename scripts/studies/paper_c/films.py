"""Homogenized compressible films between a rough wall and an infinitely wide flat slider, as in Paper C."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import chebfit, chebval
from numpy.polynomial.polyutils import mapdomain
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.cavitation.discretise import Ends
from roughfilm.rom.cavitation.problem import Problem
from roughfilm.rom.cavitation.shape import Shape
from roughfilm.rom.cavitation.solve import solve
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.gap_factors import FactorsOverGap, GapFactors
from roughfilm.rom.homogenization.line import profile_over_gap
from roughfilm.rom.homogenization.node_sums import Rule, line_factors_on
from roughfilm.rom.lubricants.compressibility import ConstantBulkModulus

SPAN, SPEED, VISCOSITY = 0.1, 1.0, 0.14
"""Length Lx, m, sliding speed u, m/s, and viscosity η, Pa s."""

MODULUS = 1e9
"""Bulk modulus β, Pa. The paper prints 10⁹ GPa; the greatest pressures for ``MODULI`` show which value it used."""

MODULI = (1e9, 1e10)

CELLS = 512
DROP = {"C.9": 1e-6, "C.10": 0.4e-6, "C.11": 0.4e-6, "C.12": 0.4e-6, "C.13": 1e-6}
"""Decrease of the film from inlet to outlet, m."""

SMOOTH = "S"
LAMBDA = 10.0
CLEARANCES = np.geomspace(0.02e-6, 30e-6, 34)
"""Clearances min h0 of the films of Fig. C.13, m."""

LOADS = (5e4, 1e5, 2e5, 5e5, 1e6, 2e6, 5e6, 1e7)
"""Loads at which films are compared, N/m; Fig. C.13 of the paper shows loads up to 10⁶ N/m."""

DEGREE, LOW = 24, 8
"""Degrees of the polynomials from near contact to thick films, and over the one micrometre of Fig. C.9."""


@dataclass(frozen=True, kw_only=True)
class HomogenizedFilm:
    """The solution of a film at its nodes: x and mean gap, m, pressure above pc, Pa, shape (nodes,); load, N/m."""

    x: Array
    mean_gap: Array
    pressure: Array
    load: float


@dataclass(frozen=True, kw_only=True)
class Curve:
    """The falling load of a film, N/m, over its clearance min h0, m, and the rms height ``rms`` of its profile, m."""

    clearance: Array
    load: Array
    rms: float

    def at(self, loads: ArrayLike) -> Array:
        """Return the clearances, m, at loads, N/m; NaN beyond the curve."""
        through = PchipInterpolator(np.log(self.load[::-1]), np.log(self.clearance[::-1]), extrapolate=False)
        return np.asarray(np.exp(through(np.log(loads))))


@dataclass(frozen=True, kw_only=True)
class FilmOrdering:
    """Roughness parameters of profiles (m, shape (profiles,)), and min h0 at ``LOADS`` (m, shape (profiles, loads))."""

    numbers: dict[str, Array]
    clearance: Array

    def concordance(self, number: str, load: int) -> float:
        """Return the fraction of the pairs of profiles in which the one of larger ``number`` has the thinner film."""
        rough, thin = self.numbers[number], -self.clearance[:, load]
        one, other = np.triu_indices(rough.size, 1)
        return float(((rough[one] - rough[other]) * (thin[one] - thin[other]) > 0).mean())


def solved(
    thickness: Callable[[Array], Array],
    roughness: FactorsOverGap | None,
    *,
    cells: int = CELLS,
    modulus: float = MODULUS,
) -> HomogenizedFilm:
    """Solve Eq. C.19 with p = pc at both ends, by the solver for cavitating films; these films do not cavitate."""
    law = ConstantBulkModulus.model_validate({"law": "constant_bulk_modulus", "bulk_modulus": f"{modulus!r} Pa"})
    shape = Shape(thickness=lambda x, y: thickness(x) + 0 * y, breaks=(0.0, SPAN), roughness=roughness)
    problem = Problem(shape=shape, ends=Ends(inlet=0.0), speed=SPEED, viscosity=VISCOSITY, compressibility=law)
    found = solve(problem, (cells, 1))
    return HomogenizedFilm(
        x=found.grid.x,
        mean_gap=found.faces.thickness[:, 0],
        pressure=found.state.pressure[:, 0],
        load=found.levels[-1].load,
    )


def wedge(outlet: float, drop: float) -> Callable[[Array], Array]:
    """Return the film thickness over x, m, which falls by ``drop``, m, to ``outlet``, m."""
    return lambda x: outlet + drop * (1 - x / SPAN)


def over_gap(factors: Sequence[FlowFactors], mean_gap: Array, highest: float) -> GapFactors:
    """Return the factors over the mean gap, m, from those at each mean gap; ``highest`` is the highest point, m."""
    return GapFactors(
        along=np.array([one.pressure[0, 0] for one in factors]),
        across=np.array([one.pressure[1, 1] for one in factors]),
        cross=np.array([one.pressure[0, 1] for one in factors]),
        drag=np.array([one.shear[0] for one in factors]),
        drag_across=np.array([one.shear[1] for one in factors]),
        couette=np.array([one.couette for one in factors]),
        shear_couette=np.array([one.shear_couette for one in factors]),
        streaming=np.array([one.couette - one.shear_couette for one in factors]),
        least=mean_gap - highest,
    )


def tabled(
    factors: FactorsOverGap, highest: float, clearances: tuple[float, float], degree: int = DEGREE
) -> FactorsOverGap:
    """Return factors interpolated between ``degree`` + 1 mean gaps ĥ, by polynomials in ln(ĥ - rmax).

    ``highest`` is rmax, m, and ``clearances`` are the least and the greatest ĥ - rmax, m.
    """
    low, high = np.log(clearances)
    places = (low + high) / 2 - (high - low) / 2 * np.cos(np.pi * np.arange(degree + 1) / degree)
    nodes = highest + np.exp(places)
    at = factors(nodes)

    kept = (at.along / nodes**3, at.across / nodes**3, at.drag / nodes, at.couette * nodes)
    values = np.column_stack([*map(np.log, kept), at.shear_couette / at.couette])
    polynomials = chebfit(mapdomain(places, (low, high), (-1, 1)), values, degree)

    def between(mean_gap: Array) -> GapFactors:
        place = mapdomain(np.log(mean_gap - highest), (low, high), (-1, 1))
        along, across, drag, couette, part = chebval(place, polynomials)
        inverse = np.exp(couette) / mean_gap
        return GapFactors(
            along=np.exp(along) * mean_gap**3,
            across=np.exp(across) * mean_gap**3,
            cross=0 * mean_gap,
            drag=np.exp(drag) * mean_gap,
            drag_across=0 * mean_gap,
            couette=inverse,
            shear_couette=part * inverse,
            streaming=(1 - part) * inverse,
            least=mean_gap - highest,
        )

    return between


def by_rule(heights: Array, nodes: int, rule: Rule) -> FactorsOverGap:
    """Return the factors of a profile over the mean gap, by a rule on ``nodes`` nodes."""
    highest = float(heights.max())

    def factors(mean_gap: Array) -> GapFactors:
        found = [line_factors_on(one - heights, nodes, rule=rule).factors for one in mean_gap]
        return over_gap(found, mean_gap, highest)

    return factors


def loads_by_nodes(heights: Array, nodes: Sequence[int], rule: Rule) -> Array:
    """Return the loads, N/m, of the film of Fig. C.9 (ĥ = 6 to 5 µm) for each number of nodes."""
    top = float(heights.max())
    clearances = (5e-6 - top, 6e-6 - top)
    return np.array(
        [
            solved(wedge(5e-6, DROP["C.9"]), tabled(by_rule(heights, count, rule), top, clearances, LOW)).load
            for count in nodes
        ]
    )


def films(profiles: Mapping[str, Array]) -> dict[str, dict[str, HomogenizedFilm]]:
    """Return the films of Figs. C.10 (equal h0), C.11 (equal mean gap), C.12 (equal Λ) by profile; "S" is smooth."""
    found: dict[str, dict[str, HomogenizedFilm]] = {
        "C.10": {SMOOTH: solved(wedge(3e-6, DROP["C.10"]), None)},
        "C.11": {SMOOTH: solved(wedge(4e-6, DROP["C.11"]), None)},
        "C.12": {},
    }
    for name, heights in profiles.items():
        factors, top = profile_over_gap(heights), float(heights.max())
        for figure, outlet in (("C.10", 3e-6 + top), ("C.11", 4e-6), ("C.12", LAMBDA * float(heights.std()) + top)):
            found[figure][name] = solved(wedge(outlet, DROP[figure]), factors)
    return found


def peaks(profiles: Mapping[str, Array]) -> dict[float, tuple[float, float]]:
    """Return the greatest pressures of S in Fig. C.10 and of profile C in Fig. C.12 for each modulus, Pa."""
    heights = profiles["C"]
    outlet = LAMBDA * float(heights.std()) + float(heights.max())
    found = {}
    for modulus in MODULI:
        smooth = solved(wedge(3e-6, DROP["C.10"]), None, modulus=modulus)
        rough = solved(wedge(outlet, DROP["C.12"]), profile_over_gap(heights), modulus=modulus)
        found[modulus] = float(smooth.pressure.max()), float(rough.pressure.max())
    return found


def curve(heights: Array | None, *, cells: int = CELLS // 2) -> Curve:
    """Return the loads of Fig. C.13 over min h0; the wall is smooth if ``heights`` is None."""
    drop = DROP["C.13"]
    top, factors = 0.0, None
    if heights is not None:
        top = float(heights.max())
        factors = tabled(profile_over_gap(heights), top, (CLEARANCES[0], CLEARANCES[-1] + drop))
    loads = [solved(wedge(top + clearance, drop), factors, cells=cells).load for clearance in CLEARANCES]
    return Curve(clearance=CLEARANCES, load=np.array(loads), rms=0.0 if heights is None else float(heights.std()))


def load_curves(profiles: Mapping[str, Sequence[Array]]) -> dict[str, list[Curve]]:
    """Return the curves of every seed of every profile, and that of a smooth wall."""
    return {SMOOTH: [curve(None)]} | {name: [curve(heights) for heights in made] for name, made in profiles.items()}


def random_profile(seed: int, *, points: int = 512, roll_off: int = 4) -> Array:
    """Return the heights of a self-affine profile (H = 0.8, Ra = 0.1 to 1 µm), m, skewed towards peaks or valleys."""
    random = np.random.default_rng(seed)
    wave = np.arange(points // 2 + 1)
    waves = np.maximum(wave / roll_off, 1.0) ** -1.3 * (
        random.normal(size=wave.size) + 1j * random.normal(size=wave.size)
    )
    waves[0] = 0
    straight = np.fft.irfft(waves, points)
    bend = random.uniform(-0.5, 0.5)
    heights = np.expm1(bend * straight / straight.std())
    heights = (heights - heights.mean()) * np.sign(bend)
    return np.asarray(heights / np.abs(heights).mean() * 10 ** random.uniform(-7, -6))


def random_ordering(count: int) -> dict[str, FilmOrdering]:
    """Return the films of random profiles with different Ra, and of profiles that are scaled to Ra = 0.4 µm."""
    made = [random_profile(seed) for seed in range(1001, 1001 + count)]
    alike = [0.4e-6 * heights / np.abs(heights).mean() for heights in made[: count // 2]]
    return {"random": _ordered(made), "of one Ra": _ordered(alike)}


def _ordered(profiles: Sequence[Array]) -> FilmOrdering:
    return FilmOrdering(
        numbers={
            "Ra": np.array([np.abs(heights).mean() for heights in profiles]),
            "Rq": np.array([heights.std() for heights in profiles]),
            "rmax": np.array([heights.max() for heights in profiles]),
        },
        clearance=np.array([curve(heights, cells=CELLS // 4).at(LOADS) for heights in profiles]),
    )
