"""The random counts: every answer of a scene beside its truth, and the scenes without an answer."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.rom.bearing.march.solve import ERROR
from scripts.studies.coverage.judge import UNCERTAINTY, Finding
from scripts.studies.motion.random_scenes import GIVEN, drawn, drawn_in_time, drawn_with_heat
from scripts.studies.motion.solving import (
    Stated,
    Truth,
    dynamics_answer,
    heated_dynamics_truth,
    heated_truth,
    march_answer,
    march_truth,
    nearest,
    solve_answer,
    truths,
)

SOLVE, DYNAMICS, MARCH = "solve", "dynamics", "march"
"""The commands that are judged."""

ACROSS = "across"
THERMAL = ("heat_balance", "adiabatic", ACROSS)
"""Models with temperatures, each judged as a command of its own."""

HEATED_DYNAMICS = "heated_dynamics"
"""Stiffness and damping at the temperature of the heat balance."""

ROUND_OFF = 1e-9
"""Relative difference up to which an answer is the truth: residuals of films and forces."""

PRESCRIBED = frozenset({"load", "specific_load", "hersey_number", "sommerfeld_number"})
"""Quantities that follow from the load of the scene."""

MULTIPLES = frozenset({"power_loss", "power_loss_mean", "torque", "torque_mean"})
"""Multiples of the friction, of which one number is judged."""


@dataclass(frozen=True, kw_only=True)
class Counted:
    """What one random scene gave.

    Attributes
    ----------
    kind, seed : the scene.
    command : "solve", which stands for the equilibrium with its stiffness and damping, "march", "heated_dynamics", or a
        thermal model.
    found : every judged number.
    silent : numbers without an uncertainty, by the command.
    refused : why there is no answer or no truth; empty if there are both.
    cpu_s : CPU time of the answers, s.
    """

    kind: str
    seed: int
    command: str
    found: tuple[Finding, ...] = ()
    silent: Mapping[str, tuple[str, ...]]
    refused: str = ""
    cpu_s: float = 0.0


def count_scene(kind: str, seed: int, command: str, cells: int) -> dict[str, Any]:
    """Return what a random scene gives, with plain entries, see :func:`counted_of`.

    Parameters
    ----------
    command : ``SOLVE`` for the equilibrium and its stiffness and damping, ``MARCH``, ``HEATED_DYNAMICS``, or a model of
        ``THERMAL``.
    cells : cells along the film of the answer; there are half as many across.
    """
    try:
        if command in THERMAL:
            answers = _heated(kind, seed, command, cells)
        elif command == HEATED_DYNAMICS:
            scene = drawn_with_heat(kind, seed)
            answers = {command: (dynamics_answer(scene, cells), heated_dynamics_truth(scene, cells))}
        else:
            answers = _marched(kind, seed, cells) if command == MARCH else _settled(kind, seed, cells)
    except (InputError, ConvergenceError) as error:
        return asdict(Counted(kind=kind, seed=seed, command=command, silent={}, refused=str(error)))
    return asdict(
        Counted(
            kind=kind,
            seed=seed,
            command=command,
            found=tuple(
                one for name, (stated, truth) in answers.items() for one in judged(kind, seed, name, stated, truth)
            ),
            silent={
                name: tuple(sorted(stated.values.keys() - stated.uncertainty.keys()))
                for name, (stated, _) in answers.items()
            },
            cpu_s=sum(stated.cpu_s for stated, _ in answers.values()),
        )
    )


def counted_of(entries: Mapping[str, Any]) -> Counted:
    """Return what a scene gave from its entries."""
    found = tuple(Finding(**one) for one in entries["found"])
    silent = {name: tuple(names) for name, names in entries["silent"].items()}
    return Counted(**{**entries, "found": found, "silent": silent})


def _settled(kind: str, seed: int, cells: int) -> dict[str, tuple[Stated, Truth]]:
    scene = drawn(kind, seed)
    solved, moving = solve_answer(scene, cells), dynamics_answer(scene, cells)
    statics, coefficients = truths(scene, cells)
    return {SOLVE: (solved, statics), DYNAMICS: (moving, coefficients)}


def _marched(kind: str, seed: int, cells: int) -> dict[str, tuple[Stated, Truth]]:
    scene, end = drawn_in_time(kind, seed)
    return {MARCH: (march_answer(scene, end, cells), march_truth(scene, end, cells, ERROR))}


def _heated(kind: str, seed: int, model: str, cells: int) -> dict[str, tuple[Stated, Truth]]:
    scene = drawn_with_heat(kind, seed, replaced=model != ACROSS)
    return {model: (solve_answer(scene, cells, model), heated_truth(scene, cells, model))}


def judged(kind: str, seed: int, command: str, stated: Stated, truth: Truth) -> list[Finding]:
    """Return the numbers of an answer that state an uncertainty, beside their truths.

    Each number counts once: what the scene prescribes, multiples of the friction and values per width are left out.
    """
    found = []
    multiples = MULTIPLES if stated.values.keys() & {"friction", "friction_mean"} else frozenset()
    left_out = multiples if kind in GIVEN else PRESCRIBED | multiples
    for name in sorted((stated.uncertainty.keys() & truth.values.keys()) - left_out):
        if name.endswith("_per_width"):
            continue
        true = truth.values[name]
        value = nearest(name, stated.values[name], true)
        found.append(
            Finding(
                kind=kind,
                seed=seed,
                model=command,
                quantity=name,
                promise=UNCERTAINTY,
                value=true if abs(value - true) <= ROUND_OFF * abs(true) else value,
                true=true,
                truth_uncertainty=truth.uncertainty[name],
                stated=stated.uncertainty[name],
                warned=stated.warned,
            )
        )
    return found
