"""The effect of a periodic joint at which valleys end on the flow along them, where the true flow is known."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import atan

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.contact.preparation.prepare import Prepared
from roughfilm.contact.surfaces.periodicity import periodicity_mismatch
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.rom.homogenization.flow_factors import flow_factors
from roughfilm.rom.homogenization.lay import turned
from roughfilm.stability.joint import cut_grooves, joined
from scripts.studies.lay.data import ROUGHNESS, SIDE, THICKNESSES, gap_at, grooves_exactly
from scripts.studies.lay.measured import STRIATED, along, lay_of

GROOVES, NODES = 4, 192
SHIFTS = tuple(np.linspace(0, 1, 11).tolist())
"""Shift of grooves from end to end of the window over their distance; at 0 and 1 they meet at the joint."""

WINDOWS, SEEDS, LAYS = 4, (811, 823), (0.0, 0.06)
"""A window is a quarter of a random periodic surface along its lay, which is turned by so much, rad."""


@dataclass(frozen=True, kw_only=True)
class Joint:
    """One window at one separation: flow along the lay where nothing ends at a joint, and with two kinds of joint.

    Attributes
    ----------
    thickness : separation over Sq.
    mismatch : ``periodicity_mismatch`` of the raw window, and of the window with edges joined.
    passed : A along the lay divided by the true value, likewise; nan where both are 0.
    """

    thickness: float
    mismatch: tuple[float, float]
    passed: tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Joints:
    """All joints: sinusoidal grooves by shift, random windows, and measured surfaces by name."""

    cut: Mapping[float, Sequence[Joint]]
    windows: Sequence[Joint]
    measured: Mapping[str, Sequence[Joint]]


def judged(window: Surface, joined: Surface, truth: Mapping[float, float], lay: float) -> list[Joint]:
    """A window and the same with joined edges, at each thickness of which the true A along the lay is given."""
    roughness = float(window.heights.std())
    mismatch = (periodicity_mismatch(window), periodicity_mismatch(joined))
    made = []
    for thickness, true in truth.items():
        found = [passed(one, thickness * roughness, lay) for one in (window, joined)]
        with np.errstate(divide="ignore", invalid="ignore"):
            raw, after = np.divide(found, true)
        made.append(Joint(thickness=thickness, mismatch=mismatch, passed=(float(raw), float(after))))
    return made


def passed(surface: Surface, separation: float, lay: float) -> float:
    """A along the lay, m³, with the surface taken as periodic; nan where the solver failed."""
    gap = gap_at(surface.heights - surface.heights.mean(), separation)
    try:
        return along(flow_factors(gap, surface.spacing).factors.pressure, lay)
    except ConvergenceError:
        return float("nan")


def mirrored(surface: Surface) -> Surface:
    """A surface and its mirror image behind it in x: twice as long, and no valley ends where they meet."""
    return Surface(heights=np.concatenate([surface.heights, surface.heights[::-1]]), spacing=surface.spacing)


def _cut(shift: float, nodes: int) -> list[Joint]:
    surface = cut_grooves(shift, nodes, grooves=GROOVES, side=SIDE, roughness=ROUGHNESS)
    slope = atan(shift / GROOVES)
    truth = {}
    for thickness in THICKNESSES:
        mean = gap_at(surface.heights, thickness * ROUGHNESS).mean()
        truth[thickness] = float(turned(grooves_exactly(thickness)[0], slope)[0, 0] * mean**3)
    return judged(surface, joined(surface), truth, 0.0)


def _windows(seed: int, lay: float, nodes: int) -> list[Joint]:
    whole = gaussian(
        size=(WINDOWS * SIDE, SIDE),
        points=(WINDOWS * nodes, nodes),
        seed=seed,
        rms_height=ROUGHNESS,
        correlation_length=40e-6,
        anisotropy=20.0,
        lay_angle=lay,
    )
    made = []
    for part in np.split(whole.heights, WINDOWS):
        window = Surface(heights=part - part.mean(), spacing=whole.spacing)
        double, roughness = mirrored(window), float(window.heights.std())
        truth = {thickness: passed(double, thickness * roughness, 0.0) for thickness in THICKNESSES}
        made += judged(window, joined(window), truth, 0.0)
    return made


def _turned_to_x(surface: Surface) -> Surface:
    return Surface(heights=surface.heights.T, spacing=surface.spacing[::-1])


def _measured(name: str, prepared: Prepared) -> list[Joint]:
    """Judge a measured joint: against the window with its mirror image for marks along y, else against joined edges.

    An oblique lay and its mirror image form chevrons, through which nothing flows across.
    """
    raw, after = prepared.cell, prepared.joined
    if name == STRIATED:
        raw, after = _turned_to_x(raw), _turned_to_x(after)
        truth = {t: passed(mirrored(raw), t * float(raw.heights.std()), 0.0) for t in THICKNESSES}
        return judged(raw, after, truth, 0.0)
    lay = lay_of(prepared)
    truth = {t: passed(after, t * float(raw.heights.std()), lay) for t in THICKNESSES}
    return judged(raw, after, truth, lay)


def join_all(
    prepared: Mapping[str, Prepared], advance: Callable[[str], None], *, nodes: int = NODES, coarser: int = 1
) -> Joints:
    """Compute all joints, or every n-th shift, seed and lay only; ``advance`` is called ``PARTS`` times."""
    advance("cut grooves")
    cut = {shift: _cut(shift, nodes) for shift in SHIFTS[::coarser]}
    advance("random windows")
    windows = [one for seed in SEEDS[::coarser] for lay in LAYS[::coarser] for one in _windows(seed, lay, nodes)]
    advance("measured joints")
    return Joints(cut=cut, windows=windows, measured={name: _measured(name, one) for name, one in prepared.items()})


PARTS = 3


def lowest(joints: Sequence[Joint], thickness: float) -> tuple[float, float]:
    """Return the least relative flow of raw and joined windows at a thickness."""
    both: Array = np.array([one.passed for one in joints if one.thickness == thickness])
    raw, after = np.nanmin(both, axis=0)
    return float(raw), float(after)
