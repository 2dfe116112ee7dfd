"""What the rungs of a seal share: the surface pressed, and what its permeability is in the seal."""

import math
from collections.abc import Callable
from functools import partial
from typing import Unpack

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.rom.dry_contact.model import Answer, Task, contact_model, once, one
from roughfilm.rom.dry_contact.pressed import TOLERANCE, prepare
from roughfilm.rom.ladder.model import About, Applicability, Model
from roughfilm.rom.ladder.result import Field, with_uncertainties
from roughfilm.rom.pocket.validity import NO_COARSER_GRID
from roughfilm.rom.seal.leakage.passage import Passage, dimensionless, mass_flow
from roughfilm.rom.seal.scene import Seal

RESIDUAL_MEANING = (
    "part of the leakage by which iterating on would change it, or by how much contact breaks its conditions"
)

BINS, FARTHEST = 80, 8.0
"""Of gaps, up to so many rms heights."""

Flow = Callable[[Contact, Seal], Passage]
"""flow(contact, scene): what a contact lets through along the scene's axis."""


def leak(task: Task, *, flow: Flow) -> Answer:
    """Press the surface, its hardness kept, and take the flow through the gap."""
    from roughfilm.contact.mechanics.press import Press  # numba is slow to import
    from roughfilm.rom.homogenization.flux import flux

    scene: Seal = task.scene
    found = Press(task.heights, task.spacing, scene.composite_modulus, hardness=scene.hardness).at(
        scene.load.pressure, tolerance=task.tolerance
    )
    passage = flow(found, scene)
    driven = flux(found.gap, found.spacing, passage.corrector, scene.axis) if not passage.sealed else None
    size = np.zeros(found.gap.shape) if driven is None else np.hypot(*driven)
    per_permeability = scene.flow.pressure_drop / (12 * scene.liquid.viscosity * scene.flow.length)
    return Answer(
        quantities=with_uncertainties(
            quantities(
                scene, passage.permeability, passage.sealed, found.area_fraction, found.mean_gap, task.heights.std()
            ),
            {
                "permeability": passage.uncertainty,
                "leakage_per_width": leakage_of(scene, passage.uncertainty),
            },
        ),
        fields={
            **gap_shares(float(task.heights.std()), found.gap),
            "gap": Field(values=found.gap, unit="m"),
            "flow": Field(values=size * per_permeability, unit="m^2/s"),
        },
        residual=max(found.complementarity, passage.unsolved),
        iterations=max(found.iterations + passage.iterations, 1),
        warnings=(*_warnings(scene, found), *(() if math.isfinite(passage.uncertainty) else (NO_COARSER_GRID,))),
    )


def gap_shares(rms: float, gaps: Array, shares: Array | None = None) -> dict[str, Field]:
    """How much of the nominal area has a gap in which of the bins that all rungs share, contact left out.

    ``rms`` is that of the heights, m; ``shares`` are the parts of the area of each gap, equal ones if not given.
    """
    edges = np.linspace(0.0, FARTHEST * (rms or 1e-9), BINS + 1)
    weights = np.full(gaps.shape, 1 / gaps.size) if shares is None else shares
    some = gaps > 0
    share, _ = np.histogram(gaps[some], edges, weights=weights[some])
    return {"gap_edges": Field(values=edges, unit="m"), "gap_share": Field(values=share.astype(float), unit="1")}


def leakage_of(scene: Seal, permeability: float) -> float:
    """Of the scene's liquid, kg/(s m)."""
    return mass_flow(
        permeability,
        density=scene.liquid.density,
        viscosity=scene.liquid.viscosity,
        pressure_drop=scene.flow.pressure_drop,
        length=scene.flow.length,
    )


def quantities(
    scene: Seal, permeability: float, sealed: bool, area: float, mean_gap: float | None, rms: float
) -> dict[str, Quantity]:
    """What every rung tells; ``smooth_leakage`` is that of a smooth gap as thick as the rms height."""
    told = {
        "leakage_per_width": Quantity(value=leakage_of(scene, permeability), unit="kg/(m*s)"),
        "sealed": one(float(sealed)),
        "permeability": Quantity(value=permeability, unit="m^3"),
        "area_fraction": one(area),
        "smooth_leakage": Quantity(value=leakage_of(scene, float(rms) ** 3), unit="kg/(m*s)"),
    }
    if rms > 0:
        told["dimensionless_leakage"] = one(dimensionless(permeability, float(rms)))
    if mean_gap is not None:
        told["mean_gap"] = Quantity(value=mean_gap, unit="m")
    return told


def _warnings(scene: Seal, found: Contact) -> tuple[str, ...]:
    from roughfilm.contact.surfaces.periodicity import (  # scipy is slow to import
        MISMATCH_THRESHOLD,
        periodicity_mismatch,
    )
    from roughfilm.rom.seal.leakage.joint import joint_seals

    surface = scene.surface()
    mismatch = 0.0 if scene.geometry.described else periodicity_mismatch(surface)
    if not mismatch > MISMATCH_THRESHOLD:
        return ()
    seals = joint_seals(found.gap)[scene.axis]
    told = "is sealed there, and open but for it" if seals else "may be throttled there"
    return (f"the surface meets itself badly at its joints (mismatch {mismatch:.2g}), and {told}; prepare it better",)


def applies(scene: Seal, *, keeps: str) -> Applicability:
    """Always; says what is kept."""
    told = "elastic" if scene.solid.hardness is None else f"P/H = {scene.load.pressure / scene.hardness:.3g}"
    drop = scene.flow.pressure_drop / scene.load.pressure
    moved = f", and that the liquid, at {drop:.2g} of the load, lifts the surface" if drop > 0.1 else ""
    return Applicability(applies=True, reason=f"{keeps}; contact {told}; leaves out inertia{moved}")


def seal_model(*, words: str, flow: Flow, repeats: Callable[[Seal], int] = once, **about: Unpack[About]) -> Model[Seal]:
    """A model that presses the surface and solves the flow through so many ``repeats`` of it.

    ``words`` say what of the flow it keeps.
    """
    return contact_model(
        **about,
        kind="seal",
        residual_meaning=RESIDUAL_MEANING,
        applies=partial(applies, keeps=words),
        work=partial(leak, flow=flow),
        prepare=partial(prepare_flow, flow=flow),
        tolerance=TOLERANCE,
        cost=lambda heights: 1e-2 + 1.5e-6 * heights,
        repeats=repeats,
    )


def prepare_flow(task: Task, *, flow: Flow) -> None:
    """Compile what contact and flow need."""
    from roughfilm.contact.mechanics.press import Press

    prepare(task)
    x = np.cos(2 * np.pi * np.arange(16) / 16)
    flow(Press(np.add.outer(x, x), (1.0, 1.0), 1.0).at(0.05), task.scene)
