"""The map of films with temperatures: their heat balances, laws and limits, and films that run away."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import product
from typing import Any

from roughfilm.ladder import find
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.request import Request
from roughfilm.stability.form import (
    BAD,
    GOOD,
    MapOutcome,
    Probe,
    Spot,
    StabilityMap,
    count,
    in_groups,
    in_numbers,
    in_turn,
    listed,
)
from roughfilm.stability.questions.thermal import (
    ISOTHERMAL,
    LENGTH,
    MODELS,
    SUPPLIED,
    asked,
    bounded,
    film,
    judged,
    lubricant,
    nahme,
)
from roughfilm.stability.questions.warm import (
    Compared,
    against_adiabatic,
    against_exact,
    against_isothermal,
    against_warmer,
    judged_pair,
    loaded,
)

MANY_FILMS = 20
"""Number of films on the finest grid above which a case is slow."""

HEATING = (1e-3, 0.1, 1.0, 10.0, 100.0)
"""Heating numbers β η u L/(ρ c h²) with the viscosity at the supply."""

PAD: Mapping[str, Any] = {"shape": "linear", "length": "50 mm", "width": "50 mm", "film": "30 um", "rise": "30 um"}
SECTOR: Mapping[str, Any] = {
    "shape": "sector",
    "inner_radius": "30 mm",
    "outer_radius": "60 mm",
    "angle": "50 deg",
    "film": "30 um",
    "rise": "30 um",
}
JOURNAL: Mapping[str, Any] = {"shape": "journal", "radius": "25 mm", "width": "50 mm", "clearance": "50 um"}
BORE: Mapping[str, Any] = {"shape": "lobes", "radius": "25 mm", "width": "50 mm", "clearance": "50 um"}
FED: Mapping[str, Any] = {"boundary": {"sides": {"low": "0.2 MPa", "high": "0.2 MPa"}}}

SHAPES: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any]]] = {
    "pad": (PAD, {}),
    "sector": (SECTOR, {}),
    "journal with a groove": ({**JOURNAL, "eccentricity": 0.6}, {}),
    "two axial grooves": ({**BORE, "lobes": 2, "arc": "160 deg", "eccentricity": [0.1, -0.6]}, {}),
    "three lobes": ({**BORE, "lobes": 3, "arc": "100 deg", "preload": 0.5, "eccentricity": [0.05, -0.3]}, {}),
    "full bore fed at its sides": ({**BORE, "eccentricity": [0.1, -0.6]}, FED),
    "four tilting pads": (
        {
            **BORE,
            "lobes": 4,
            "arc": "80 deg",
            "first": "-45 deg",
            "preload": 0.3,
            "pivot": 0.5,
            "eccentricity": [0.0, -0.4],
        },
        {},
    ),
}
"""The shapes of the map and their other tables."""

FEW: Mapping[str, Sequence[float]] = {
    "full bore fed at its sides": (1e-3, 0.1),
    "four tilting pads": (1e-3, 0.1),
}
"""Heating numbers of shapes that are slow, or whose lubricant circulates."""

ECCENTRICITIES = (0.8, 0.95, 0.99)
"""Eccentricities of journals near contact."""

THETAS = (0.3, 0.6, 0.9)
"""Filling fractions of the inlet of starved pads."""

BACK_PRESSURES = ("0.5 MPa", "2 MPa", "10 MPa", "50 MPa")
"""Pressures at the outlet of a pad, of which the larger ones drive lubricant back."""

SEPARATIONS = (6.0, 4.0, 3.0)
"""Film thickness of mixed films over the rms height of their roughness."""

DENSE: Mapping[str, Any] = {"viscosity": None, "temperature": "50 degC", "density": "870 kg/m^3"}

LAWS: Mapping[str, Mapping[str, Any]] = {
    "exponential, β = 0.005/K": lubricant(1.0, 0.005),
    "exponential, β = 0.1/K": lubricant(1.0, 0.1),
    "ISO VG 32": lubricant(1.0, **{**DENSE, "thermoviscosity": {"law": "iso_vg", "grade": 32}}),
    "ISO VG 460": lubricant(1.0, **{**DENSE, "thermoviscosity": {"law": "iso_vg", "grade": 460}}),
    "Walther": lubricant(
        1.0,
        **{**DENSE, "thermoviscosity": {"law": "walther", "points": [["40 degC", "46 cSt"], ["100 degC", "6.8 cSt"]]}},
    ),
    "Roelands": lubricant(1.0, thermoviscosity={"law": "roelands", "index": 1.2}),
    "piezoviscous": lubricant(1.0, piezoviscosity={"law": "barus", "pressure_coefficient": "15 1/GPa"}),
}
"""Lubricants with several laws of the viscosity over temperature."""

STEEL: Mapping[str, Any] = {"conductivity": "45 W/(m*K)", "density": "7800 kg/m^3", "heat_capacity": "460 J/(kg*K)"}

WALLS: Mapping[str, tuple[str, Mapping[str, Any]]] = {
    "both at 40 °C": (
        "pad",
        {
            "fixed_wall": {"kind": "temperature", "temperature": "40 degC"},
            "sliding_wall": {"kind": "temperature", "temperature": "40 degC"},
        },
    ),
    "one at 80 °C": ("pad", {"fixed_wall": {"kind": "temperature", "temperature": "80 degC"}}),
    "a layer": (
        "pad",
        {"fixed_wall": {"kind": "conducting", "thickness": "20 mm", "conductivity": "45 W/(m*K)"}},
    ),
    "a half space": ("pad", {"sliding_wall": {"kind": "half_space", **STEEL}}),
    "a turning shaft": ("journal with a groove", {"sliding_wall": "turning"}),
    "a turning shaft and a layer": (
        "two axial grooves",
        {
            "sliding_wall": "turning",
            "fixed_wall": {"kind": "conducting", "heat_transfer": "500 W/(m^2*K)", "surroundings": "30 degC"},
        },
    ),
}
"""Walls of films with a temperature across: shape and table."""


ROUGH: Mapping[str, Any] = {
    "roughness": {
        "kind": "surface",
        "surface": {
            "kind": "gaussian",
            "size": ["0.5 mm", "0.5 mm"],
            "points": [64, 64],
            "seed": 7,
            "rms_height": "1 um",
            "correlation_length": "20 um",
        },
    },
    "asperities": {"friction": 0.1, "solid": {"modulus": "210 GPa", "poisson": 0.3, "hardness": "2 GPa"}},
    "motion": {"speed": "1 m/s"},
}
"""A rough wall that touches the other one, at a low speed."""

MIXED_PAD: Mapping[str, Any] = {**PAD, "rise": "2 um"}


@dataclass(frozen=True, kw_only=True)
class Case:
    """A film with temperatures and its place on the map.

    Attributes
    ----------
    group, row, column : names of the place on the map.
    geometry, lubricant, tables : the scene.
    model : name of the model.
    less : whether the film must generate less heat than at the temperature of the supply.
    even : whether it is symmetric about the middle of its width.
    """

    group: str
    row: str
    column: str
    geometry: Mapping[str, Any]
    lubricant: Mapping[str, Any]
    tables: Mapping[str, Any] = field(default_factory=dict)
    model: str
    less: bool = False
    even: bool = True

    @property
    def scene(self) -> Bearing:
        """The scene."""
        return film(self.geometry, self.lubricant, **self.tables)


def cases() -> Iterator[Case]:
    """The films that are judged by the balance of their heat and by a finer grid."""
    for (name, (geometry, tables)), model in product(SHAPES.items(), MODELS):
        for heating in FEW.get(name, HEATING):
            yield Case(
                group=f"{model} over the heating number",
                row=name,
                column=_column(heating),
                geometry=geometry,
                lubricant=lubricant(heating),
                tables=tables,
                model=model,
                less=not tables and "pivot" not in geometry,
                even=name != "sector",
            )
    for model, eccentricity in product(MODELS, ECCENTRICITIES):
        yield Case(
            group="journals near contact",
            row=model,
            column=f"e = {eccentricity:g}",
            geometry={**JOURNAL, "eccentricity": eccentricity},
            lubricant=lubricant(0.03),
            model=model,
            less=True,
        )
    for model, theta in product(MODELS, THETAS):
        yield Case(
            group="starved pads",
            row=model,
            column=f"θ = {theta:g}",
            geometry=PAD,
            lubricant=lubricant(1.0),
            tables={"boundary": {"inlet": {"theta": theta}}},
            model=model,
        )
    for model, pressure in product(MODELS, BACK_PRESSURES):
        yield Case(
            group="a pad against a pressure at its outlet",
            row=model,
            column=pressure,
            geometry=PAD,
            lubricant=lubricant(1.0),
            tables={"boundary": {"outlet": {"pressure": pressure}}},
            model=model,
        )
        yield Case(
            group="a film that widens, pumped against its sliding",
            row=model,
            column=pressure,
            geometry=PAD,
            lubricant=lubricant(1.0),
            tables={"motion": {"speed": "-10 m/s"}, "boundary": {"inlet": {"pressure": pressure}}},
            model=model,
        )
    for model, (name, table) in product(MODELS, LAWS.items()):
        less = name != "piezoviscous"
        yield Case(group="laws", row=name, column=model, geometry=PAD, lubricant=table, model=model, less=less)
    for (name, (shape, heat)), heating in product(WALLS.items(), (0.1, 1.0, 10.0)):
        yield Case(
            group="walls that take heat",
            row=name,
            column=_column(heating),
            geometry=SHAPES[shape][0],
            lubricant=lubricant(heating),
            tables={"heat": heat},
            model="across",
        )
    for model, separation in product(MODELS, SEPARATIONS):
        yield Case(
            group="mixed films",
            row=model,
            column=f"h/Sq = {separation:g}",
            geometry={**MIXED_PAD, "film": f"{separation!r} um"},
            lubricant=lubricant(1e-3),
            tables=ROUGH,
            model=model,
            even=False,
        )


def _column(heating: float) -> str:
    return f"{heating:g} (Na = {nahme(heating):.3g})"


REFUSED: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any], Mapping[str, Any]]] = {
    "a wide journal, all lubricant returns": (
        {key: entry for key, entry in JOURNAL.items() if key != "width"} | {"eccentricity": 0.6},
        lubricant(1.0),
        {},
    ),
    "a pad under a load of 10 GN": ({**PAD, "film": None}, lubricant(1.0), {"load": {"force": "10 GN"}}),
    "a flat ring, the same pressure at both sides": (
        {**SECTOR, "rise": "0 um", "joined": True},
        lubricant(1.0),
        {"boundary": {"sides": {"low": "0.1 MPa", "high": "0.1 MPa"}}},
    ),
    "asperities that heat a film by 10⁵ K": ({**MIXED_PAD, "film": "1 um"}, lubricant(1e-3), ROUGH),
}
"""Films without a temperature, and without a film: geometry, lubricant and other tables."""

COOLED = ("a wide journal, all lubricant returns", "a flat ring, the same pressure at both sides")
"""Films from which no lubricant carries heat: heat_balance takes that which the bearing gives off to still air."""


def probes(cells: int) -> Iterator[Probe]:
    """The probes on ``cells`` along a side, and on twice as many."""
    for case in cases():
        yield Probe(
            group=case.group,
            row=case.row,
            column=case.column,
            ask=partial(bounded, partial(_asked, case, cells)),
            judge=partial(judged, even=case.even),
            many=MANY_FILMS,
        )
    for group, row, column, ask in _pairs(cells):
        question = partial(bounded, ask)
        yield Probe(group=group, row=row, column=column, ask=question, judge=judged_pair, many=MANY_FILMS)
    for (name, (geometry, table, tables)), model in product(REFUSED.items(), MODELS):
        if name in COOLED and model == "heat_balance":
            continue
        given = {key: entry for key, entry in geometry.items() if entry is not None}
        refused = partial(bounded, partial(_solved, given, table, tables, model, cells))
        yield Probe(group="no temperature", row=name, column=model, ask=refused, judge=judged, refused=True)


def _asked(case: Case, cells: int) -> object:
    return asked(case.scene, case.model, cells, less=case.less)


def _solved(
    geometry: Mapping[str, Any], table: Mapping[str, Any], tables: Mapping[str, Any], model: str, cells: int
) -> object:
    return find("bearing", model).solve(film(geometry, table, **tables), Request(resolution=cells))


def _pairs(cells: int) -> Iterator[tuple[str, str, str, Callable[[], Compared]]]:
    """Pairs of answers that are compared: an exact solution, limits, warmer supplies, and other models."""
    for ratio, heating in product((0.3, 1.0, 3.0), HEATING):
        ask = partial(against_exact, ratio, heating, 4 * cells)
        yield "a wide wedge against its exact solution", f"rise/film = {ratio:g}", _column(heating), ask
    for (name, (geometry, tables)), model in product(SHAPES.items(), MODELS):
        ask = partial(against_isothermal, geometry, tables, model, cells)
        yield f"no thinning, against {ISOTHERMAL}", name, model, ask
    for (name, (geometry, tables)), model in product(SHAPES.items(), MODELS):
        if name in FEW:
            continue
        ask = partial(against_warmer, geometry, tables, model, cells)
        yield f"a supply at {SUPPLIED + 20:g} °C against one at {SUPPLIED:g} °C", name, model, ask
    for name, heating in product(("pad", "sector", "journal with a groove", "two axial grooves"), (0.1, 1.0, 10.0)):
        ask = partial(against_adiabatic, *SHAPES[name], heating, cells)
        yield "heat_balance against adiabatic", name, _column(heating), ask
    for (name, heating), model in product(product(("pad", "journal with a groove"), (0.1, 1.0, 10.0)), MODELS):
        ask = partial(loaded, *SHAPES[name], heating, model, cells)
        yield "films under the load of a known one", f"{name}, {model}", _column(heating), ask


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: each group, the uncertainties, and films that run away."""
    lines = []
    for name, own in in_groups(spots).items():
        if films := [spot.iterations for spot in own if spot.iterations and spot.outcome in GOOD]:
            lines.append(f"{name}: {in_numbers(own)}; at most {max(films)} films on the finest grid.")
    compared, inside = (math.fsum(spot.numbers.get(name) or 0.0 for spot in spots) for name in ("compared", "inside"))
    if compared:
        lines.append(
            f"The uncertainty alone contains the value on a grid with half the cell size for {inside:g} of "
            f"{compared:g} quantities ({inside / compared:.1%})."
        )
    lines.append(f"{count(spots, MapOutcome.REFUSED)} films without a temperature are refused.")
    return [*lines, *listed(spots, *BAD)]


THERMAL = StabilityMap(
    name="thermal",
    title="Films with temperatures",
    axes=f"{', '.join(MODELS)} for several shapes (rows) over the heating number β η u L/(ρ c h²) with the viscosity "
    "of the supply, and the Nahme number Na = β η u²/k (columns), near contact, starved, against a pressure at the "
    "outlet, for several laws of viscosity and walls, and in mixed films, on {resolution} cells along a side. Then "
    "pairs of answers that are compared, and films without a temperature.",
    judge="The heat that the film generates, brings in, carries out and gives to its walls, recomputed from its flows "
    "and temperatures to 1e-8; the work of friction and pressures; temperatures not below all that enters; a "
    "symmetric field of a symmetric film; less heat than in the isothermal film; and quantities on a grid with half "
    "the cell size, which must agree within the uncertainties of both. A wide wedge is judged by its exact solution "
    f"(shooting for its flow over a length of {LENGTH * 1e3:g} mm), other pairs by the isothermal limit, the film "
    "under a load by the known one. The error is that of the load. Iterations are films on the finest grid; more than "
    f"{MANY_FILMS} are slow.",
    resolution=32,
    resolution_meaning="cells along a side of the film",
    least=24,
    most=64,
    allowed="the films take 24 to 64 cells along a side",
    solve=in_turn(probes),
    summary=summary,
)
