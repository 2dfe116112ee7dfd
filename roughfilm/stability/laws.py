"""Where pressed seals and mixed films are answered as nature allows: by laws that no model may break."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from roughfilm.contact.foundation.errors import InputError
from roughfilm.ladder import find, models
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.stability.checks.invariants import broken
from roughfilm.stability.form import BAD, Judged, Map, Outcome, Spot, count, in_groups, named, summed, tried
from roughfilm.terminal.console import progress_bar

FEWEST, MOST = 32, 256
"""Points along a side of the surfaces."""

SEED, SIDE, ROUGHNESS = 20071, 1e-3, 1e-6
"""m: the period of the surfaces, and their rms height."""

SLACK = 1e-6
"""A part by which what must fall with the load may grow, besides the error bars."""

LOADS = (1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 1.0)
"""P/(E* g'), from a touch to past sealing."""

SEPARATIONS = (10.0, 5.0, 3.0, 2.0, 1.0, 0.5, 0.0)
"""Of the mean planes, over the rms height: from full film to crushed tips."""

SPEEDS = (0.0, 1e-3, 0.03, 1.0, 30.0, -1.0)
"""m/s."""

CELLS = 32

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


@dataclass(frozen=True, kw_only=True)
class Probe:
    """A scene for a rung, and where it stands; ``falling`` must not grow from one column of a row to the next."""

    group: str
    row: str
    column: str
    model: Model
    scene: Callable[[], Scene]
    resolution: int | None
    falling: str
    refused: bool = False


def surfaces(points: int) -> dict[str, dict[str, Any]]:
    """Descriptions of rough walls by name."""
    told = {"size": [f"{SIDE!r} m"] * 2, "points": [points, points], "seed": SEED, "rms_height": f"{ROUGHNESS!r} m"}
    waves = {"roll_off": f"{SIDE / 4!r} m", "cut_off": f"{6 * SIDE / points!r} m"}
    length = f"{3 * SIDE / points!r} m"
    return {
        "self-affine, Hurst 0.8": {"kind": "self_affine", "hurst": 0.8, **waves, **told},
        "self-affine, Hurst 0.3": {"kind": "self_affine", "hurst": 0.3, **waves, **told},
        "ridges along the flow": {"kind": "gaussian", "correlation_length": length, "anisotropy": 4, **told},
        "ridges across the flow": {
            "kind": "gaussian",
            "correlation_length": length,
            "anisotropy": 4,
            "lay_angle": "90 deg",
            **told,
        },
    }


def seals(points: int) -> Iterator[Probe]:
    """Surfaces pressed harder and harder, elastic and not."""
    ladder = models("seal")
    for name, surface in surfaces(points).items():
        for hardness in (None, 0.5):
            group = name + ("" if hardness is None else f", H = {hardness:g} E* g'")
            unit = _seal(surface, 1.0, None).pressure_unit
            limit = None if hardness is None else hardness * unit
            for model in ladder:
                for load in LOADS:
                    yield Probe(
                        group=group,
                        row=model.name,
                        column=f"P = {load:g} E* g'",
                        model=model,
                        scene=partial(_seal, surface, load * unit, limit),
                        resolution=None,
                        falling="permeability",
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
    """Bearings whose walls come nearer and nearer, at rest to fast, and backwards."""
    model = find("bearing", "mixed")
    for shape, geometry in SHAPES.items():
        for name, surface in list(surfaces(points).items())[::2]:
            for speed in SPEEDS:
                for separation in SEPARATIONS:
                    yield Probe(
                        group=f"{shape}, {name.replace('flow', 'sliding')}",
                        row=f"{speed:g} m/s",
                        column=f"α = {separation:g} Sq",
                        model=model,
                        scene=partial(_film, geometry, surface, separation * ROUGHNESS, speed),
                        resolution=CELLS,
                        falling="least_gap",
                        refused=separation == 0,
                    )


def _film(geometry: Mapping[str, Any], surface: Mapping[str, Any], separation: float, speed: float) -> Scene:
    film = {"film": f"{separation!r} m"}
    if geometry["shape"] == "journal":
        film = {"eccentricity": 1 - separation / 50e-6}  # type: ignore[dict-item]
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


def put(probe: Probe, before: Result | None) -> tuple[Spot, Result | None]:
    """The answer of a rung, judged by the laws of its kind and by the answer before; and that answer."""
    kept: list[Result] = []

    def ask() -> tuple[Scene, Result]:
        scene = probe.scene()
        result = probe.model.solve(scene, Request(resolution=probe.resolution))
        kept.append(result)
        return scene, result

    spot = partial(Spot, group=probe.group, row=probe.row, column=probe.column)
    return tried(spot, ask, partial(judged, probe, before), refused=probe.refused), kept[0] if kept else before


def judged(probe: Probe, before: Result | None, found: tuple[Scene, Result]) -> Judged:
    """By the laws, and against what came before."""
    scene, result = found
    value = result.quantities[probe.falling].value
    faults = broken(scene, result)
    if before is not None:
        last = before.quantities[probe.falling].value
        bars = sum(one[probe.falling].uncertainty or 0.0 for one in (before, result))
        if value > last * (1 + SLACK) + bars:
            faults.append(f"{probe.falling} grows from {last:.6g} to {value:.6g}")
    names = ("permeability", "area_fraction", "load_per_width", "contact_share", "least_gap", "friction_coefficient")
    return Judged(
        iterations=result.numerics.iterations,
        right=not faults,
        error=np.nan,
        numbers={name: result.quantities[name].value for name in names if name in result.quantities},
        message="; ".join(faults),
    )


@dataclass(frozen=True, kw_only=True)
class LawfulFamily:
    """Probes whose answers are judged by laws alone."""

    name: str
    title: str
    axes: str
    judge: str
    probes: Callable[[int], Iterator[Probe]]
    resolution: int = 64
    resolution_meaning: str = "points along a side of the surfaces"

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Map:  # noqa: ARG002
        """Try every probe, one after the other."""
        if not FEWEST <= resolution <= MOST:
            raise InputError(
                f"--resolution: got {resolution}; the surfaces take {FEWEST} to {MOST} points along a side"
            )
        asked = list(self.probes(resolution))
        spots: list[Spot] = []
        last: dict[tuple[str, str], Result | None] = {}
        with progress_bar(len(asked)) as advance:
            for probe in asked:
                advance(len(spots), f"{probe.group}: {probe.row}, {probe.column}")
                spot, last[probe.group, probe.row] = put(probe, last.get((probe.group, probe.row)))
                spots.append(spot)
        return Map(
            family=self.name,
            title=self.title,
            axes=self.axes,
            judge=self.judge,
            resolution=resolution,
            resolution_meaning=self.resolution_meaning,
            spots=spots,
            told=told(spots),
        )


def told(spots: Sequence[Spot]) -> list[str]:
    """What a reader should know."""
    lines = [f"{name}: {summed(own)}." for name, own in in_groups(spots).items()]
    slowest = max(spots, key=lambda spot: spot.iterations or 0)
    lines.append(f"The most iterations: {slowest.iterations}, {slowest.place}.")
    return [*lines, f"{count(spots, Outcome.REFUSED)} are refused.", *named(spots, *BAD)]


SEAL = LawfulFamily(
    name="seal",
    title="Seals that are pressed",
    axes="Surfaces pressed from a touch to past sealing (columns), elastic and with a hardness, by every rung (rows).",
    judge="By laws that share nothing with the models: sealed just where no open path leads through, told by "
    "what hangs "
    "together in copies of the period; else no more than if pressure were even over every section, no less than "
    "if every "
    "line leaked by itself; the conditions of the answer; and never more at a greater load.",
    probes=seals,
)

MIXED = LawfulFamily(
    name="mixed",
    title="Mixed films",
    axes="Pads, journals and washers whose walls come nearer, from full film to crushed tips (columns: "
    "separation of the "
    "mean planes over the rms height), at rest to 30 m/s and backwards (rows).",
    judge="By laws that share nothing with the model: pressures at the nodes add up to the load, film and asperities "
    "share it, parts are parts, pressure never below that of cavitation, friction not below that of the "
    "asperities; and "
    "the mean gap never grows as the walls come nearer. A separation of 0 is below what the scene takes for a "
    "film, and "
    "refused.",
    probes=films,
)
