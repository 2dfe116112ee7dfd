"""The maps of films over pockets: where each model converges with each scheme, over Reynolds number and depth."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from statistics import median
from typing import Any

from roughfilm.batch.answers import answers_to
from roughfilm.batch.jobs import Failure, Job
from roughfilm.contact.foundation.errors import Outcome
from roughfilm.contact.foundation.units import with_unit
from roughfilm.foamcases.openfoam.iterate import RECIPE
from roughfilm.foamcases.openfoam.residuals import PATIENCE
from roughfilm.ladder import models
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.parts.laminar import SHEAR_LIMIT
from roughfilm.stability.form import SECOND_TRY, MapOutcome, Spot, Spots, StabilityMap, count, failed, in_groups

RE, DEPTH = "Re", "d+"

"""Names of the columns (Reynolds number) and rows (depth over the film thickness) of the map."""

FILM, VISCOSITY, DENSITY = 30e-6, 0.01, 1000.0
"""Film thickness outside of the pockets, m, viscosity, Pa s, and density, kg/m³."""

GROOVE = {
    "name": "pocket",
    "kind": "pocket",
    "lubricant": {"viscosity": with_unit(VISCOSITY, "Pa*s"), "density": with_unit(DENSITY, "kg/m^3")},
    "geometry": {"length": "1 mm", "film": with_unit(FILM, "m"), "profile": "cylindrical", "width": "0.3 mm"},
}
"""Entries of the scene of the groove of Sahlin et al. 2005, doi:10.1115/1.1828067, without a depth."""

DIMPLE = {
    **GROOVE,
    "name": "dimple",
    "geometry": {
        "length": "1 mm",
        "breadth": "1 mm",
        "film": with_unit(FILM, "m"),
        "dimples": [{"shape": "spherical", "width": "0.5 mm"}],
    },
}
"""Entries of the scene of a spherical dimple in a square cell, without a depth."""


PAD = {
    "name": "pad",
    "kind": "bearing",
    "lubricant": {**GROOVE["lubricant"], "cavitation_pressure": "-0.1 MPa"},  # type: ignore[dict-item]
    "geometry": {
        "shape": "parallel",
        "length": "4 mm",
        "film": with_unit(FILM, "m"),
        "texture": {"length": "0.5 mm", "start": "0.25 mm", "pitch": "1 mm", "columns": 2},
    },
}
"""Entries of the scene of an infinitely wide pad with two grooves in its leading half, without a depth."""


def available_models(kind: str) -> tuple[list[Model], dict[str, str]]:
    """The models of a kind that are available on this machine, and by name the reason why the others are absent."""
    absent = {model.name: here.detail for model in models(kind) if not (here := model.available()).available}
    return [model for model in models(kind) if model.name not in absent], absent


def scene_at(reynolds_number: float, depth_plus: float, entries: Mapping[str, Any] = GROOVE) -> Scene:
    """The scene at Re = ρ u film/η and a depth over the film thickness; ``entries`` have neither."""
    depth, geometry = {"depth": with_unit(depth_plus * FILM, "m")}, entries["geometry"]
    own: dict[str, Any] = depth
    if "dimples" in geometry:
        own = {"dimples": [{**one, **depth} for one in geometry["dimples"]]}
    elif "texture" in geometry:
        own = {"texture": {**geometry["texture"], **depth}}
    speed = with_unit(reynolds_number * VISCOSITY / (DENSITY * FILM), "m/s")
    return read_scene({**entries, "geometry": {**geometry, **own}, "motion": {"speed": speed}})


@dataclass(frozen=True, kw_only=True)
class Places:
    """The Reynolds numbers and the depths over the film thickness at which films over pockets are solved."""

    entries: Mapping[str, Any] = field(default_factory=lambda: GROOVE)
    reynolds_numbers: tuple[float, ...] = (40.0, 160.0, 500.0, 1000.0, 2000.0, 5000.0)
    depths_plus: tuple[float, ...] = (0.25, 0.5, 0.75, 1.25, 2.0, 3.0)

    def solve(self, resolution: int, out: Path, processes: int, scratch: Path) -> Spots:
        """The spots of all places by every model with every scheme, deepest grooves first, and the absent models.

        The arguments are those of ``StabilityMap.solve``; ``resolution`` counts mesh columns of the OpenFOAM models.
        """
        here, absent = available_models(self.entries["kind"])
        settings = [
            Setting(model=model, resolution=resolution if model.outside else None, scheme=scheme)
            for model in here
            if model.applies(scene_at(self.reynolds_numbers[0], self.depths_plus[0], self.entries)).applies
            for scheme in model.schemes or (None,)
        ]
        places = [(number, depth) for depth in reversed(self.depths_plus) for number in self.reynolds_numbers]
        scenes = {at: scene_at(*at, self.entries) for at in places}
        jobs = {
            (setting, at): Job(
                scene=scene, setting=setting, path=out / "runs" / f"Re{at[0]:g}-d{at[1]:g}" / f"{setting.name}.h5"
            )
            for setting in settings
            for at, scene in scenes.items()
        }
        answers = answers_to(list(jobs.values()), processes, scratch)
        return [spot_of(setting, *at, answers[job.path]) for (setting, at), job in jobs.items()], absent


def spot_of(setting: Setting, reynolds_number: float, depth_plus: float, answer: Result | Failure) -> Spot:
    """The spot of a run with this answer."""
    place: dict[str, Any] = {
        "group": setting.model.name + (f", {setting.scheme}" if setting.scheme else ""),
        "row": f"{DEPTH} {depth_plus:g}",
        "column": f"{RE} {reynolds_number:g}",
    }
    numbers = {"reynolds_number": reynolds_number, "depth_plus": depth_plus}
    if isinstance(answer, Failure):
        return failed(answer, **place, numbers={**numbers, "load": None})
    failures = [
        f"{run.outcome} after {run.iterations} iterations at the first try"
        for run in answer.numerics.runs[:-1]
        if run.outcome != Outcome.CONVERGED
    ]
    return Spot(
        **place,
        outcome=MapOutcome.SLOW if failures else MapOutcome.CONVERGED,
        why=SECOND_TRY if failures else "",
        iterations=answer.numerics.iterations,
        cpu_s=answer.numerics.cpu_s,
        message="; ".join([*failures, *answer.warnings]),
        numbers={**numbers, "load": answer["load"].value},
    )


def summary(spots: Sequence[Spot]) -> list[str]:
    """Sentences about the map: where each model converges or fails, and how much the loads of its schemes differ."""
    groups = in_groups(spots)
    return [line for name in groups for line in _sentences(name, groups)]


def _sentences(name: str, groups: Mapping[str, Sequence[Spot]]) -> list[str]:
    own = groups[name]
    good = count(own, MapOutcome.CONVERGED)
    lines = [f"{name}: converges at {'all' if good == len(own) else good} of {len(own)} places."]
    others = [spot for spot in own if spot.outcome is not MapOutcome.CONVERGED]
    for word in dict.fromkeys(spot.why or spot.outcome for spot in others):
        some = [spot for spot in others if (spot.why or spot.outcome) == word]
        lines.append(f"{name}: {word} at {len(some)}: {_places(some)}.")
    model, _, scheme = name.partition(", ")
    first = next(group for group in groups if group.partition(", ")[0] == model)
    differences = _differences(own, groups[first])
    if scheme and first != name and differences:
        reference = first.partition(", ")[2]
        lines.append(
            f"{name}: at half of them its load is {100 * median(differences):.2g} % or more from that of {reference}."
        )
    return lines


def _differences(own: Sequence[Spot], first: Sequence[Spot]) -> list[float]:
    others = {(spot.row, spot.column): spot.numbers["load"] for spot in first}
    pairs = ((spot.numbers["load"], others[spot.row, spot.column]) for spot in own)
    return [abs(load / other - 1) for load, other in pairs if load is not None and other]


def _places(spots: Iterable[Spot]) -> str:
    """The places of spots in words, grouped by Reynolds number or by depth, whichever gives fewer groups."""
    at = [(spot.column.removeprefix(f"{RE} "), spot.row.removeprefix(f"{DEPTH} ")) for spot in spots]
    numbers = {n: ", ".join(d for m, d in at if m == n) for n, _ in at}
    depths = {d: ", ".join(n for n, e in at if e == d) for _, d in at}
    if len(depths) < len(numbers):
        return "; ".join(f"{DEPTH} {depth} at {RE} {numbers}" for depth, numbers in depths.items())
    return "; ".join(f"{RE} {number} at {DEPTH} {depths}" for number, depths in numbers.items())


POCKET = StabilityMap(
    name="pocket",
    title="A groove under a sliding wall",
    axes="A groove 300 µm wide in a period of 1000 µm under a film of 30 µm: Re = ρ u Ly/η (columns) and depth "
    "d+ = d/Ly (rows), by every model with every scheme; OpenFOAM with {resolution} mesh columns, the other models at "
    f"their default resolution. Above Re = {SHEAR_LIMIT:g} shear flow turns turbulent, and every model takes it as "
    "laminar.",
    judge="The residual of the equations of each model, recomputed. A run that converged is steady by its own "
    "equations, which does not prove that the real flow is. OpenFOAM stops when its residual has not halved "
    f"for {PATIENCE} iterations; the second run: {RECIPE}.",
    resolution=120,
    resolution_meaning="mesh columns of the OpenFOAM models",
    solve=Places().solve,
    summary=summary,
)

DIMPLES = replace(
    POCKET,
    name="dimple",
    title="A dimple under a sliding wall",
    axes="A spherical dimple 500 µm wide in a square cell of 1000 µm under a film of 30 µm: Re = ρ u Ly/η (columns) "
    "and depth d+ = d/Ly (rows), by every model with every scheme; OpenFOAM with {resolution} mesh columns along the "
    f"cell, the other models at their default resolution. Above Re = {SHEAR_LIMIT:g} shear flow turns turbulent, and "
    "every model takes it as laminar.",
    resolution=32,
    solve=Places(
        entries=DIMPLE, reynolds_numbers=(40.0, 160.0, 500.0, 2000.0), depths_plus=(0.25, 0.75, 1.25, 2.0)
    ).solve,
)

PADS = replace(
    POCKET,
    name="pad",
    title="A wide pad with grooves",
    axes="An infinitely wide parallel pad of 4 mm under a film of 30 µm, with two grooves 500 µm wide in its leading "
    "half: Re = ρ u h/η (columns) and depth d+ = d/h (rows), by every model with every scheme; OpenFOAM with "
    "{resolution} mesh columns, the other models at their default resolution. Above Re = "
    f"{SHEAR_LIMIT:g} shear flow turns turbulent, and every model takes it as laminar.",
    resolution=160,
    solve=Places(entries=PAD).solve,
)
