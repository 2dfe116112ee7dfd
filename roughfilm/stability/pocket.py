"""Where each model of a pocket with each scheme converges, over Reynolds number and depth."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

from roughfilm.batch.answers import answers_to
from roughfilm.batch.jobs import Failure, Job
from roughfilm.contact.foundation.units import with_unit
from roughfilm.foamcases.openfoam.iterate import RECIPE
from roughfilm.foamcases.openfoam.residuals import PATIENCE
from roughfilm.ladder import models
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.ladder.scene import read_scene
from roughfilm.rom.ladder.setting import Setting
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.rom.pocket.validity import TURBULENT
from roughfilm.stability.form import SECOND, Map, Outcome, Spot, count, failed, in_groups

KIND = "pocket"
RUNS = "runs"

RE, DEPTH = "Re", "d+"

FILM = 30e-6
GEOMETRY = {"length": "1 mm", "film": with_unit(FILM, "m"), "profile": "cylindrical", "width": "0.3 mm"}
GROOVE = {
    "name": "pocket",
    "kind": "pocket",
    "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
}
"""The groove of Sahlin et al. 2005, doi:10.1115/1.1828067."""


@dataclass(frozen=True, kw_only=True)
class PocketFamily:
    """The Reynolds numbers and depths (in film thicknesses) that a groove is varied to."""

    reynolds_numbers: tuple[float, ...]
    depths_plus: tuple[float, ...]
    resolution: int = 120
    resolution_meaning: str = "mesh columns of the OpenFOAM models"

    @property
    def places(self) -> tuple[tuple[float, float], ...]:
        """Every Reynolds number with every depth, from the deepest down."""
        return tuple((number, depth) for depth in reversed(self.depths_plus) for number in self.reynolds_numbers)

    def at(self, reynolds_number: float, depth_plus: float) -> Pocket:
        """The scene at a place of the map."""
        geometry = {**GEOMETRY, "depth": with_unit(depth_plus * FILM, "m")}
        scene = read_scene({**GROOVE, "geometry": geometry, "motion": {"reynolds_number": reynolds_number}})
        assert isinstance(scene, Pocket)
        return scene

    def make(self, *, resolution: int, out: Path, processes: int, scratch: Path) -> Map:
        """Solve what is not in ``out`` already, and put all of it together."""
        ladder = models(KIND)
        absent = {model.name: found.detail for model in ladder if not (found := model.available()).available}
        settings = [
            Setting(model=model, resolution=resolution if model.outside else None, scheme=scheme)
            for model in ladder
            if model.name not in absent
            for scheme in model.schemes or (None,)
        ]
        scenes = {at: self.at(*at) for at in self.places}
        jobs = {
            (setting, at): Job(
                scene=scene, setting=setting, path=out / RUNS / f"Re{at[0]:g}-d{at[1]:g}" / f"{setting.name}.h5"
            )
            for setting in settings
            for at, scene in scenes.items()
        }
        answers = answers_to(list(jobs.values()), processes, scratch)
        spots = [spot_of(setting, *at, answers[job.path]) for (setting, at), job in jobs.items()]
        shape, turbulent = self.at(1.0, 1.0).geometry, f"{TURBULENT:g}"
        groove = shape.grooves[0]
        return Map(
            family=KIND,
            title="A groove under a sliding wall",
            axes=f"A groove {1e6 * groove.width:g} µm wide in a period of {1e6 * shape.length:g} µm under a film of "
            f"{1e6 * shape.film:g} µm: Re = ρ u Ly/η (columns) and depth d+ = d/Ly (rows), by every model with every "
            f"scheme; OpenFOAM with {resolution} mesh columns, the other models as they are by default. Above Re = "
            f"{turbulent} shear flow turns turbulent, and every model takes it as laminar.",
            judge="By the equations of each model: its residual, recomputed. A run that converged is steady by its own "
            "equations; whether the real flow is, it cannot say. OpenFOAM gives up when its residual has not halved "
            f"for {PATIENCE} iterations; the second try: {RECIPE}.",
            resolution=resolution,
            resolution_meaning=self.resolution_meaning,
            spots=spots,
            told=[line for name, own in in_groups(spots).items() for line in in_words(name, own, spots)],
            absent=absent,
        )


def spot_of(setting: Setting, reynolds_number: float, depth_plus: float, answer: Result | Failure) -> Spot:
    """The run of which this is the answer."""
    where: dict[str, Any] = {
        "group": setting.model.name + (f", {setting.scheme}" if setting.scheme else ""),
        "row": f"{DEPTH} {depth_plus:g}",
        "column": f"{RE} {reynolds_number:g}",
    }
    numbers = {"reynolds_number": reynolds_number, "depth_plus": depth_plus}
    if isinstance(answer, Failure):
        return failed(answer, **where, numbers={**numbers, "load_plus": None})
    told = [f"{run.outcome} after {run.iterations} iterations at the first try" for run in answer.numerics.runs[:-1]]
    return Spot(
        **where,
        outcome=Outcome.SLOW if told else Outcome.CONVERGED,
        why=SECOND if told else "",
        iterations=answer.numerics.iterations,
        cpu_s=answer.numerics.cpu_s,
        message="; ".join([*told, *answer.warnings]),
        numbers={**numbers, "load_plus": answer.quantities["load_plus"].value},
    )


def in_words(name: str, own: Sequence[Spot], every: Sequence[Spot]) -> list[str]:
    """What a reader should know of a model: where it converges and where not, and how far its scheme is off."""
    good = count(own, Outcome.CONVERGED)
    told = [f"{name}: converges at {'all' if good == len(own) else good} of {len(own)} places."]
    told += [
        f"{name}: {word} at {len(some)}: {_places(some)}."
        for word in dict.fromkeys(spot.why or spot.outcome for spot in own if spot.outcome is not Outcome.CONVERGED)
        if (some := [spot for spot in own if (spot.why or spot.outcome) == word])
    ]
    model, _, scheme = name.partition(", ")
    first = next(group for group in in_groups(every) if group.partition(", ")[0] == model)
    gaps = _gaps(own, in_groups(every)[first])
    if scheme and first != name and gaps:
        scheme = first.partition(", ")[2]
        told.append(f"{name}: at half of them its load is {100 * median(gaps):.2g} % or more from that of {scheme}.")
    return told


def _gaps(own: Sequence[Spot], first: Sequence[Spot]) -> list[float]:
    others = {(spot.row, spot.column): spot.numbers["load_plus"] for spot in first}
    pairs = ((spot.numbers["load_plus"], others[spot.row, spot.column]) for spot in own)
    return [abs(load / other - 1) for load, other in pairs if load is not None and other]


def _places(spots: Iterable[Spot]) -> str:
    """The places of runs, gathered by Reynolds number or by depth, whichever is shorter."""
    at = [(spot.column.removeprefix(f"{RE} "), spot.row.removeprefix(f"{DEPTH} ")) for spot in spots]
    numbers = {n: ", ".join(d for m, d in at if m == n) for n, _ in at}
    depths = {d: ", ".join(n for n, e in at if e == d) for _, d in at}
    if len(depths) < len(numbers):
        return "; ".join(f"{DEPTH} {depth} at {RE} {numbers}" for depth, numbers in depths.items())
    return "; ".join(f"{RE} {number} at {DEPTH} {depths}" for number, depths in numbers.items())


POCKET = PocketFamily(
    reynolds_numbers=(40.0, 160.0, 500.0, 1000.0, 2000.0, 5000.0),
    depths_plus=(0.25, 0.5, 0.75, 1.25, 2.0, 3.0),
)
