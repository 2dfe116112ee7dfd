"""Judge the errors stated where the film of a pocket ruptures: python -m scripts.studies.coverage.rupture.

The truth has both effects: the Reynolds equation with inertia to first order and with cavitation that conserves mass.
The models that have one of them, ``inertial_reynolds`` and ``reynolds_cavitating``, are judged by it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
import typer
from rich.table import Table

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, Outcome
from roughfilm.contact.foundation.units import with_unit
from roughfilm.ladder import find
from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.discretise import PARTS
from roughfilm.rom.cavitation.evaluation.friction import friction
from roughfilm.rom.cavitation.line import line_step
from roughfilm.rom.cavitation.network import Network, State
from roughfilm.rom.cavitation.newton import settle
from roughfilm.rom.cavitation.residual import RESIDUAL_TOLERANCE
from roughfilm.rom.cavitation.solve import COLD_SWEEPS, Solution, solve
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.rom.pocket.cavitating.grooves import groove_problem
from roughfilm.rom.pocket.cavitating.omission import CAVITATION_FACTORS, INERTIA_FACTORS, PRESSURES
from roughfilm.rom.pocket.closed_form import inertia_pressure
from roughfilm.rom.pocket.kind import KIND
from roughfilm.rom.pocket.scene import Pocket
from roughfilm.terminal.console import output, run_alone
from scripts.studies.coverage.drawing import drawn, seeds

CELLS = 512
"""Number of cells along a film."""

MAX_STEPS = 40
"""Largest number of steps towards the flow on which the pressure of inertia depends."""

FLOW_TOLERANCE = 1e-9
"""Change of the flow in the last step, over u times the film thickness."""

PART_MISSING = (0.05, 0.97)
"""Least and greatest ratio of the ambient pressure to the fall of pressure of the film that stays whole."""

ROUNDING = 1e-9
"""Error over the size of a quantity that is round-off."""

Numbers = dict[str, float]


def both(scene: Pocket, cells: int = CELLS) -> Numbers:
    """The quantities of a film with inertia to first order in Re and with cavitation, in the units of p+.

    In the film ∂p/∂x = 6ηu/h² - 12ηq/h³ + ∂p₁/∂x with the pressure p₁(h, q) of
    :func:`roughfilm.rom.pocket.closed_form.inertia_pressure`; a cavity is that without inertia. p₁ changes the flow
    through a face as a drag would; the flow q on which it depends is found by repetition.

    Raises
    ------
    ConvergenceError
        If the flow or a film does not converge.
    """
    problem, gap = groove_problem(scene), scene.gap()
    film = solve(problem, (cells, 1))
    plain, state = film.network, film.state
    x, lengths = film.grid.x, film.grid.spacing_x
    unit, flow = scene.reynolds_number * scene.pressure_unit, _flow(scene, plain, state)
    for step in range(MAX_STEPS):
        inertia, *inside = (
            unit * inertia_pressure(gap.thickness(places) / gap.film, flow)
            for places in (x, *(x + part * lengths for part in PARTS))
        )
        rise = np.append(np.diff(inertia), 0.0)[:, None]
        within = np.array([one - inertia for one in inside])[:, :, None]
        dragged = replace(
            plain,
            couette=plain.couette + plain.east * rise,
            part_couette=plain.part_couette + plain.part_east * within,
        )
        sweeps = COLD_SWEEPS if step == 0 else 1
        found = settle(dragged, problem, state, line_step, sweeps=sweeps, tolerance=RESIDUAL_TOLERANCE)
        state, before = found.state, flow
        flow = _flow(scene, dragged, state)
        if abs(flow - before) < FLOW_TOLERANCE:
            film = replace(film, network=dragged, state=state, kind=found.kind, residual=found.residual)
            return _numbers(scene, film, rise)
    raise ConvergenceError("rupture: the flow does not settle", outcome=Outcome.UNFINISHED)


def _flow(scene: Pocket, film: Network, state: State) -> float:
    """The flow through the period, over u times the film thickness."""
    rise = np.roll(state.pressure, -1, axis=0) - state.pressure
    through = film.least_flow(
        film.couette * state.fill - film.east * rise, state, np.zeros(film.shape), np.ones(film.shape)
    )
    return float(through[:-1].mean()) / (scene.speed * scene.geometry.film)


def _numbers(scene: Pocket, film: Solution, inertia: Array) -> Numbers:
    """The quantities; the pressure of inertia, which rises by ``inertia`` along each face, pulls no wall."""
    areas, cavity = film.grid.areas, film.kind == CAVITY
    whole = ~(cavity | np.roll(cavity, -1, axis=0))
    pressure = film.state.pressure + scene.cavitation_pressure
    pull = friction(film) - float((film.faces.mean / 2 * inertia * whole).sum())
    values = {
        "load_plus": (areas * pressure).sum() / areas.sum(),
        "friction_plus": pull / areas.sum(),
        "pressure_max_plus": pressure.max(),
        "pressure_min_plus": pressure.min(),
    }
    return {name: float(value) / scene.pressure_unit * scene.plus_factor for name, value in values.items()}


def ruptured_scene(seed: int) -> Pocket | None:
    """A random pocket at an ambient pressure at which its film ruptures; None if no pressure falls below ambient."""
    scene = drawn("pocket", seed)
    assert isinstance(scene, Pocket)
    lowest = find("pocket", "inertial_reynolds").solve(scene)["pressure_min_plus"].value
    fall = -lowest / scene.plus_factor * scene.pressure_unit
    part = np.random.default_rng(seed).uniform(*PART_MISSING)
    if fall <= 0:
        return None
    entries = {**scene_entries(scene), "boundary": {"ambient_pressure": with_unit(float(part * fall), "Pa")}}
    ruptured = read_scene(entries)
    assert isinstance(ruptured, Pocket)
    return ruptured


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """The error of a model in a quantity.

    Attributes
    ----------
    model, quantity : names; the model may be the sum of both effects, each without the other.
    ratio : error over the stated one with the numerical uncertainty; NaN for the sum, which states none.
    relative : error over the size of the quantity.
    """

    model: str
    quantity: str
    ratio: float
    relative: float


SUM = "sum of both effects"


def judgements(scene: Pocket) -> Iterator[Judgement]:
    """The errors of the models with one of both effects, over what each effect does by itself."""
    truth = both(scene)
    requests = {"reynolds": Request(), "inertial_reynolds": Request(), "reynolds_cavitating": Request(resolution=CELLS)}
    results = {model: find("pocket", model).solve(scene, request) for model, request in requests.items()}
    plain, inertia, cavitation = ({name: result[name].value for name in truth} for result in results.values())
    changed = max(abs(inertia[name] - plain[name]) for name in PRESSURES)
    thickest = (1 + scene.depth) * scene.geometry.film / scene.geometry.length
    for name in CAVITATION_FACTORS:
        value = truth[name]
        own, size = results["reynolds_cavitating"][name].uncertainty or 0.0, float(KIND.scale(truth, name))
        without = CAVITATION_FACTORS[name] * abs(cavitation[name] - plain[name]) + abs(inertia[name] - plain[name])
        within = INERTIA_FACTORS[name] * changed * (thickest if name == "friction_plus" else 1.0)
        for model, found, bound in (
            ("inertial_reynolds", inertia[name], without),
            ("reynolds_cavitating", cavitation[name], within),
            (SUM, inertia[name] + cavitation[name] - plain[name], float("nan")),
        ):
            error = max(abs(found - value) - ROUNDING * size, 0.0)
            yield Judgement(
                model=model, quantity=name, ratio=error / (bound + own + ROUNDING * size), relative=error / size
            )


def command(scenes: Annotated[int, typer.Option(min=1, help="Number of random pockets.")] = 300) -> None:
    """Print how often the stated bounds hold where the film ruptures."""
    found: list[Judgement] = []
    kept = failed = 0
    for seed in seeds(10 * scenes):
        if kept == scenes:
            break
        try:
            scene = ruptured_scene(seed)
            if scene is not None:
                found += judgements(scene)
                kept += 1
        except (ConvergenceError, InputError):
            failed += 1
    table = Table("model", "quantity", "bound kept", "error over bound, 95 %", "relative error, median", "95 %")
    for model, quantity in dict.fromkeys((one.model, one.quantity) for one in found):
        own = [one for one in found if (one.model, one.quantity) == (model, quantity)]
        ratios, relative = np.array([one.ratio for one in own]), np.array([one.relative for one in own])
        table.add_row(
            model,
            quantity,
            "" if np.isnan(ratios).any() else f"{100 * (ratios <= 1).mean():.1f} %",
            "" if np.isnan(ratios).any() else f"{np.percentile(ratios, 95):.2f}",
            f"{np.median(relative):.3f}",
            f"{np.percentile(relative, 95):.3f}",
        )
    output.print(table)
    output.print(f"{kept} pockets, {failed} without a solution")


if __name__ == "__main__":
    run_alone(command)
