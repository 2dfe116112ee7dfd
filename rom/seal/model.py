"""Models of a seal: contact of the surface, and leakage from the permeability of its gap."""

import math
from collections.abc import Callable
from functools import partial
from typing import Unpack

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.solid import beyond_elasticity, contact_outside
from roughfilm.rom.dry_contact.model import Answer, Task, contact_model, once, one
from roughfilm.rom.dry_contact.pressed import RESIDUAL_TOLERANCE, prepare
from roughfilm.rom.ladder.model import About, Applicability, Model
from roughfilm.rom.ladder.result import NO_COARSER_GRID, Field, with_uncertainties
from roughfilm.rom.seal.leakage.passage import Passage, dimensionless, mass_flow
from roughfilm.rom.seal.scene import Seal

RESIDUAL_MEANING = "relative solver error of the leakage, or residual of the contact conditions, whichever is larger"

LOST_WAVES = (
    "the uncertainty of the leakage is unknown: waves that this grid lacks may open a gap that is sealed without them; "
    "raise the resolution"
)
"""The warning for a sealed gap on a grid that lacks waves of the surface."""

GAP_BINS = 80
"""Number of bins of gaps."""

MAX_BINNED_GAP = 8.0
"""Largest gap of the bins over the rms height."""

FlowSolver = Callable[[Contact, Seal], Passage]
"""flow(contact, scene): the flow through the gap of a contact along the scene's axis."""


def leak(task: Task, *, flow: FlowSolver) -> Answer:
    """Solve the contact of the surface, then the flow through its gap.

    The uncertainty of contact area and mean gap is that by the pixels; it is unknown on a coarser grid than the
    surface's own, which omits waves.
    """
    from roughfilm.contact.mechanics.discretisation import uncertainties
    from roughfilm.contact.mechanics.press import Press  # numba is slow to import
    from roughfilm.rom.homogenization.flux import flux
    from roughfilm.rom.seal.leakage.pixels import with_pixels

    scene: Seal = task.scene
    contact = Press(task.heights, task.spacing, scene.composite_modulus, hardness=scene.hardness).at(
        scene.load.pressure, tolerance=task.tolerance
    )
    passage = with_pixels(flow(contact, scene), contact, scene.axis)
    driven = flux(contact.gap, contact.spacing, passage.corrector, scene.axis) if not passage.sealed else None
    size = np.zeros(contact.gap.shape) if driven is None else np.hypot(*driven)
    uncertainty = with_lost_waves(passage, scene, task)
    by_pixels = uncertainties(contact) if task.heights.shape == scene.surface().shape else {}
    per_permeability = scene.flow.pressure_drop / (12 * scene.liquid.viscosity * scene.flow.length)
    return Answer(
        quantities=with_uncertainties(
            quantities(
                scene, passage.permeability, passage.sealed, contact.area_fraction, contact.mean_gap, task.heights.std()
            ),
            {
                **leakage_uncertainties(scene, uncertainty),
                **{name: by_pixels[name] for name in ("area_fraction", "mean_gap") if name in by_pixels},
            },
        ),
        fields={
            **gap_distribution(float(task.heights.std()), contact.gap),
            "gap": Field(values=contact.gap, unit="m"),
            "flow": Field(values=size * per_permeability, unit="m^2/s"),
        },
        residual=max(contact.complementarity, passage.unsolved),
        iterations=max(contact.iterations + passage.iterations, 1),
        warnings=(
            *_warnings(scene, contact),
            *(() if math.isfinite(passage.uncertainty) else (NO_COARSER_GRID,)),
            *((LOST_WAVES,) if uncertainty == math.inf > passage.uncertainty else ()),
            *beyond_elasticity(float(contact.pressure.max()), scene.composite_modulus),
        ),
        # A few tips beyond the limit hardly change the gap between them.
        outside=contact_outside(scene.load.pressure, contact.area_fraction, scene.composite_modulus),
    )


def with_lost_waves(passage: Passage, scene: Seal, task: Task) -> float:
    """The uncertainty of the permeability, m³, including the waves of the surface that the task's grid lacks.

    With the permeabilities K of the passage, k of the effective medium with the waves of the grid and k' with all
    waves, these waves add the larger of K |k'/k - 1| and |k' - k|. They may open a sealed gap: its uncertainty is
    infinite.
    """
    whole = scene.spectrum()
    if task.heights.shape == scene.surface().shape or whole is None:
        return passage.uncertainty
    from roughfilm.contact.mechanics.moments import wave_power  # scipy is slow to import
    from roughfilm.rom.seal.leakage.effective_medium import effective_medium

    if passage.sealed:
        return math.inf
    part = wave_power(task.heights, task.spacing)
    less, more = (
        effective_medium(waves, composite_modulus=scene.composite_modulus, load=scene.load.pressure).permeability
        for waves in (part, whole)
    )
    relative = passage.permeability * abs(more / less - 1) if less > 0 else 0.0
    return passage.uncertainty + max(relative, abs(more - less))


def gap_distribution(rms: float, gaps: Array, fractions: Array | None = None) -> dict[str, Field]:
    """The fraction of the nominal area with a gap in each of the bins that all models share, without contact.

    ``rms`` is that of the heights, m; ``fractions`` are the area fractions of the gaps, by default equal ones.
    """
    edges = np.linspace(0.0, MAX_BINNED_GAP * (rms or 1e-9), GAP_BINS + 1)
    weights = np.full(gaps.shape, 1 / gaps.size) if fractions is None else fractions
    some = gaps > 0
    areas, _ = np.histogram(gaps[some], edges, weights=weights[some])
    return {"gap_edges": Field(values=edges, unit="m"), "gap_share": Field(values=areas.astype(float), unit="1")}


def leakage_of(scene: Seal, permeability: float) -> float:
    """The leakage of the scene's liquid at a permeability, kg/(s m)."""
    return mass_flow(
        permeability,
        density=scene.liquid.density,
        viscosity=scene.liquid.viscosity,
        pressure_drop=scene.flow.pressure_drop,
        length=scene.flow.length,
    )


def leakage_uncertainties(scene: Seal, uncertainty: float) -> dict[str, float]:
    """The uncertainties of permeability and leakage, in their units, from that of the permeability, m³."""
    leakage = leakage_of(scene, uncertainty)
    whole = {} if scene.flow.width is None else {"leakage": scene.flow.width * leakage}
    return {"permeability": uncertainty, "leakage_per_width": leakage, **whole}


def quantities(
    scene: Seal, permeability: float, sealed: bool, area: float, mean_gap: float | None, rms: float
) -> dict[str, Quantity]:
    """The quantities of all models; ``smooth_leakage`` is that of a smooth gap of the rms height.

    ``leakage`` of the whole seal, kg/s, is the leakage per width times the width of the seal, if that is known.
    """
    values = {
        "leakage_per_width": Quantity(value=leakage_of(scene, permeability), unit="kg/(m*s)"),
        "sealed": one(float(sealed)),
        "permeability": Quantity(value=permeability, unit="m^3"),
        "area_fraction": one(area),
        "smooth_leakage": Quantity(value=leakage_of(scene, float(rms) ** 3), unit="kg/(m*s)"),
    }
    if scene.flow.width is not None:
        values["leakage"] = Quantity(value=scene.flow.width * leakage_of(scene, permeability), unit="kg/s")
    if rms > 0:
        values["dimensionless_leakage"] = one(dimensionless(permeability, float(rms)))
    if mean_gap is not None:
        values["mean_gap"] = Quantity(value=mean_gap, unit="m")
    return values


def _warnings(scene: Seal, contact: Contact) -> tuple[str, ...]:
    from roughfilm.contact.surfaces.periodicity import (  # scipy is slow to import
        MISMATCH_THRESHOLD,
        is_joined_at_pixel_0,
        joint_mismatch,
    )
    from roughfilm.rom.seal.leakage.joint import EDGE_REMEDY, joint_seals

    surface = scene.surface()
    mismatch = 0.0 if scene.geometry.described else joint_mismatch(surface)
    if not mismatch > MISMATCH_THRESHOLD:
        return ()
    at_edge = is_joined_at_pixel_0(surface) and joint_seals(contact.gap)[scene.axis]
    effect = "seals only at the edge" if at_edge else "may leak less at the edge"
    return (f"the surface is not periodic (edge mismatch {mismatch:.2g}) and {effect}; {EDGE_REMEDY}",)


def applies(scene: Seal, *, keeps: str) -> Applicability:
    """The effects that are included; the model applies to every seal."""
    contact = "elastic" if scene.solid.hardness is None else f"P/H = {scene.load.pressure / scene.hardness:.3g}"
    drop = scene.flow.pressure_drop / scene.load.pressure
    lift = f", and that the liquid lifts the surface: pressure drop over load = {drop:.2g}" if drop > 0.1 else ""
    return Applicability(applies=True, reason=f"{keeps}; contact {contact}; leaves out inertia{lift}")


def seal_model(
    *, words: str, flow: FlowSolver, repeats: Callable[[Seal], int] = once, **about: Unpack[About]
) -> Model[Seal]:
    """A model that solves the contact of the surface and the flow through ``repeats(scene)`` periods of it.

    ``words`` describe the flow that it solves.
    """
    return contact_model(
        **about,
        kind="seal",
        residual_meaning=RESIDUAL_MEANING,
        applies=partial(applies, keeps=words),
        work=partial(leak, flow=flow),
        prepare=partial(prepare_flow, flow=flow),
        tolerance=RESIDUAL_TOLERANCE,
        cost=lambda heights: 1e-2 + 1.5e-6 * heights,
        repeats=repeats,
    )


def prepare_flow(task: Task, *, flow: FlowSolver) -> None:
    """Compile the kernels of contact and flow."""
    from roughfilm.contact.mechanics.press import Press

    prepare(task)
    x = np.cos(2 * np.pi * np.arange(16) / 16)
    flow(Press(np.add.outer(x, x), (1.0, 1.0), 1.0).at(0.05), task.scene)
