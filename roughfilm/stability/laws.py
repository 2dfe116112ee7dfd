"""The maps of pressed seals and of mixed films, judged by physical laws that no model may break."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from roughfilm.ladder import find, models
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.stability.checks.invariants import broken
from roughfilm.stability.form import (
    BAD,
    Judgement,
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

SIDE = 1e-3
"""Period of the surfaces, m."""

ROUGHNESS = 1e-6
"""Rms height of the surfaces, m."""

SEED = 20071
"""Seed of the random surfaces."""

MONOTONE_TOLERANCE = 1e-6
"""Allowed relative growth of a quantity that must fall, in addition to the uncertainties."""

LOADS = (1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 1.0)
"""Loads P/(E* g'), from first contact to past sealing."""

SEPARATIONS = (10.0, 5.0, 3.0, 2.0, 1.0, 0.5, 0.0)
"""Separations of the mean planes over the rms height, from full film to crushed asperities."""

SPEEDS = (0.0, 1e-3, 0.03, 1.0, 30.0, -1.0)
"""Sliding speeds, m/s."""

CELLS = 32
"""Cells along a side of the mixed films."""

SHAPES: Mapping[str, Mapping[str, Any]] = {
    "pad": {"shape": "linear", "length": "20 mm", "width": "10 mm", "rise": "5 um"},
    "journal": {"shape": "journal", "radius": "10 mm", "clearance": "50 um", "width": "10 mm"},
    "washer": {
        "shape": "washer",
        "inner_radius": "20 mm",
        "outer_radius": "30 mm",
        "pockets": 8,
        "pocket": {"depth": "0.1 mm", "share": 0.5, "extent": "5 mm"},
    },
}

REFERENCE = "homogenized_leakage"
"""Model by whose flow through the gap of the surface the estimates from a spectrum are judged."""

ALLOWED_ERROR = 0.5
"""Largest relative error of an estimate from a spectrum that counts as right."""

SHOWN = ("permeability", "area_fraction", "load_per_width", "contact_share", "least_gap", "friction_coefficient")
"""Names of the quantities of a result that a spot shows."""


def surfaces(points: int) -> dict[str, dict[str, Any]]:
    """The descriptions of rough surfaces by name, with ``points`` along each side."""
    shared = {"size": [f"{SIDE!r} m"] * 2, "points": [points, points], "seed": SEED, "rms_height": f"{ROUGHNESS!r} m"}
    waves = {"kind": "self_affine", "roll_off": f"{SIDE / 4!r} m", "cut_off": f"{6 * SIDE / points!r} m", **shared}
    ridges = {"kind": "gaussian", "correlation_length": f"{3 * SIDE / points!r} m", "anisotropy": 4, **shared}
    return {
        "self-affine, Hurst 0.8": {**waves, "hurst": 0.8},
        "self-affine, Hurst 0.3": {**waves, "hurst": 0.3},
        "ridges along the flow": ridges,
        "ridges across the flow": {**ridges, "lay_angle": "90 deg"},
    }


def seals(points: int) -> Iterator[Probe]:
    """The probes of seals: surfaces pressed by growing loads, elastic and with a hardness, by every model."""
    for (name, surface), hardness in product(surfaces(points).items(), (None, 0.5)):
        group = name + ("" if hardness is None else f", H = {hardness:g} E* g'")
        unit = _seal(surface, 1.0, None).pressure_unit
        limit = None if hardness is None else hardness * unit
        for model in models("seal"):
            before: list[Result] = []
            for load in LOADS:
                scene = partial(_seal, surface, load * unit, limit)
                estimate = model.name == "effective_medium"
                yield Probe(
                    group=group,
                    row=model.name,
                    column=f"P = {load:g} E* g'",
                    ask=partial(_solved, model, scene, None),
                    judge=partial(judged_estimate if estimate else judged, "permeability", before),
                    refused=hardness is not None and load > hardness,
                )


def _seal(surface: Mapping[str, Any], pressure: float, hardness: float | None) -> Any:
    solid = {"modulus": "10 MPa", "poisson": 0.5}
    return read_scene(
        {
            "name": "a seal",
            "kind": "seal",
            "geometry": {"surface": dict(surface)},
            "solid": solid if hardness is None else {**solid, "hardness": f"{hardness!r} Pa"},
            "load": {"pressure": f"{pressure!r} Pa"},
            "liquid": {"density": "900 kg/m^3", "viscosity": "0.01 Pa*s"},
            "flow": {"pressure_drop": "1 kPa", "length": f"{2 * SIDE!r} m"},
        }
    )


def films(points: int) -> Iterator[Probe]:
    """The probes of mixed films: bearings whose walls approach, at rest, at speed and backwards."""
    model = find("bearing", "mixed")
    rough = list(surfaces(points).items())[::2]
    for (shape, geometry), (name, surface), speed in product(SHAPES.items(), rough, SPEEDS):
        before: list[Result] = []
        for separation in SEPARATIONS:
            scene = partial(_film, geometry, surface, separation * ROUGHNESS, speed)
            yield Probe(
                group=f"{shape}, {name.replace('flow', 'sliding')}",
                row=f"{speed:g} m/s",
                column=f"α = {separation:g} Sq",
                ask=partial(_solved, model, scene, CELLS),
                judge=partial(judged, "least_gap", before),
                refused=separation == 0,
            )


def _film(geometry: Mapping[str, Any], surface: Mapping[str, Any], separation: float, speed: float) -> Scene:
    film: dict[str, Any] = {"film": f"{separation!r} m"}
    if geometry["shape"] == "journal":
        film = {"eccentricity": 1 - separation / 50e-6}
    entries = {
        "name": "a mixed film",
        "kind": "bearing",
        "geometry": {**geometry, **film},
        "lubricant": {"viscosity": "0.05 Pa*s", "cavitation_pressure": "-0.1 MPa"},
        "motion": {"speed": f"{speed!r} m/s"},
        "roughness": {"kind": "surface", "surface": dict(surface)},
        "asperities": {"friction": 0.1, "solid": {"modulus": "210 GPa", "poisson": 0.3, "hardness": "2 GPa"}},
    }
    return read_scene(entries | ({"boundary": {"sides": {"low": "0.1 MPa"}}} if geometry["shape"] == "washer" else {}))


def _solved(model: Model, scene: Any, resolution: int | None) -> tuple[Scene, Result]:
    read = scene()
    return read, model.solve(read, Request(resolution=resolution))


def judged(falling: str, before: list[Result], answer: tuple[Scene, Result]) -> Judgement:
    """The judgement of a result by the laws of its kind, and by the result before it in the row.

    Parameters
    ----------
    falling : the quantity that must not grow along a row.
    before : list of the last result of the row, empty at its start; the new result replaces it.
    answer : scene and result.
    """
    scene, result = answer
    value = result[falling].value
    faults = broken(scene, result)
    for last in before:
        uncertainty = sum(one[falling].uncertainty or 0.0 for one in (last, result))
        if value > last[falling].value * (1 + MONOTONE_TOLERANCE) + uncertainty:
            faults.append(f"{falling} grows from {last[falling].value:.6g} to {value:.6g}")
    before[:] = [result]
    return Judgement(
        iterations=result.numerics.iterations,
        right=not faults,
        error=np.nan,
        numbers={name: result[name].value for name in SHOWN if name in result.quantities},
        message="; ".join(faults),
    )


def judged_estimate(falling: str, before: list[Result], answer: tuple[Scene, Result]) -> Judgement:
    """The judgement of a result from the spectrum alone, by the laws and by the flow through the gap of the surface.

    The bounds of the flow need the gap, which these results do not hold. The error is relative to the value by
    ``REFERENCE``, and infinite if only one of both is sealed. The answer is right if the error is at most
    ``ALLOWED_ERROR``. An error is reported if the uncertainty covers it or a warning says that the model is out of
    range.
    """
    scene, result = answer
    by_laws = judged(falling, before, answer)
    if not by_laws.right:
        return by_laws
    found, true = result[falling], find("seal", REFERENCE).solve(scene)[falling].value
    off = abs(found.value - true)
    error = 0.0 if off == 0 else off / abs(true) if true else np.inf
    right = error <= ALLOWED_ERROR
    return replace(
        by_laws,
        right=right,
        error=error,
        reported=bool(result.warnings or result.outside) or off <= (found.uncertainty or 0.0),
        message="" if right else f"{falling} is {found.value:.3g}, {true:.3g} by {REFERENCE}",
    )


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: each group, the most iterations, and the number of refusals."""
    lines = [f"{name}: {in_numbers(own)}." for name, own in in_groups(spots).items()]
    slowest = max(spots, key=lambda spot: spot.iterations or 0)
    lines.append(f"The most iterations: {slowest.iterations}, {slowest.place}.")
    return [*lines, f"{count(spots, MapOutcome.REFUSED)} are refused.", *listed(spots, *BAD)]


LawMap = partial(
    StabilityMap,
    resolution=64,
    resolution_meaning="points along a side of the surfaces",
    least=32,
    most=256,
    allowed="the surfaces take 32 to 256 points along a side",
    summary=summary,
)

SEAL = LawMap(
    name="seal",
    title="Seals that are pressed",
    axes="Surfaces pressed from first contact to past sealing (columns), elastic and with a hardness, by every model "
    "(rows).",
    judge="Physical laws that share nothing with the models: the seal leaks nothing exactly where no open path exists; "
    "otherwise no more than if the pressure were uniform over every section, and no less than if every line leaked "
    "separately; the conditions of the result; and never more at a greater load. The estimate from the "
    f"spectrum holds no gap to which these bounds apply: it is right within {ALLOWED_ERROR:.0%} of {REFERENCE}.",
    solve=in_turn(seals),
)

MIXED = LawMap(
    name="mixed",
    title="Mixed films",
    axes="Pads, journals and washers whose walls approach, from full film to crushed asperities (columns: "
    "separation of the mean planes over the rms height), at rest to 30 m/s and backwards (rows).",
    judge="Physical laws that share nothing with the model: the pressures at the nodes add up to the load, film and "
    "asperities share it, fractions are within 0 and 1, the pressure is never below that of cavitation, friction is "
    "not below that of the asperities; and the mean gap never grows as the walls approach. A separation of 0 is no "
    "film for the scene, and refused.",
    solve=in_turn(films),
)
