"""Physical laws of rough walls: conditions of contact, and bounds of the flow through a gap."""

import math
from collections.abc import Iterator

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from roughfilm.contact.foundation.arrays import Array
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.result import Result
from roughfilm.rom.parts.pressed_surface import RoughContact
from roughfilm.rom.parts.restriction import restricted
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.seal.scene import Seal
from roughfilm.stability.checks.contact import broken_conditions

ALLOWED_VIOLATION = 2e-8
"""Allowed violation of the conditions of contact, over the rms height."""

BOUND_TOLERANCE = 1e-6
"""Allowed relative excess over bounds, due to solver tolerances and to conductances that count as closed."""

COARSE_MESH_TOLERANCE = 0.1
"""Allowed relative excess over bounds of flow in three dimensions on a coarse mesh."""

COPIES = (2, 3, 5)
"""Numbers of copies of a period that are tried; a path around the period connects different copies for one of them."""

ROUND_OFF = 1e-9
"""Allowed excess of an area fraction over 1."""


def dry_contact(scene: DryContact, result: Result) -> Iterator[str]:
    """The laws that a dry contact's result violates, in words: ranges, load on the area, and conditions of contact."""
    value = {name: quantity.value for name, quantity in result.quantities.items()}
    plastic, load = "plasticity" in result.provenance["keeps"], scene.load.pressure
    area = value["area_fraction"]
    if not 0 <= value.get("plastic_fraction", 0.0) <= area * (1 + BOUND_TOLERANCE) <= (1 + BOUND_TOLERANCE) ** 2:
        yield f"area {area:.6g}, of which plastic {value.get('plastic_fraction', 0.0):.6g}"
    if plastic and area * scene.hardness < load * (1 - 1e-3):
        yield f"an area of {area:.6g} at the hardness cannot carry {load:.6g} Pa"
    if value.get("mean_gap", 0.0) < 0:
        yield f"the mean gap is {value['mean_gap']:.6g} m"
    density, edges = result.fields["pressure_density"].values, result.fields["bin_edges"].values
    if density.min() < 0 or (density * np.diff(edges)).sum() > 1 + 1e-6 or (np.diff(edges) <= 0).any():
        yield "the pressure density is no distribution"
    if "pressure" in result.fields:
        hardness = scene.hardness if plastic else math.inf
        pressure, gap = result.fields["pressure"].values, result.fields["gap"].values
        worst = _broken(scene, pressure, hardness)
        if worst > max(ALLOWED_VIOLATION, 2 * result.numerics.tolerance):
            yield f"the conditions of contact are broken by {worst:.2g} of the rms height"
        if gap.min() < 0 or gap[(pressure > 0) & (pressure < hardness)].any():
            yield "a gap below 0, or one where pressure is transmitted"


def _broken(scene: RoughContact, pressure: Array, hardness: float) -> float:
    surface = scene.surface()
    (nx, ny), (length, width) = pressure.shape, surface.size
    return broken_conditions(
        pressure,
        restricted(surface.heights, (nx, ny)),
        (length / nx, width / ny),
        composite_modulus=scene.composite_modulus,
        hardness=hardness,
        load=scene.load.pressure,
    )


def seal(scene: Seal, result: Result) -> Iterator[str]:
    """The laws that a seal's result violates, in words.

    The permeability is positive exactly if an open path exists, and it is within its bounds. Fractions are 0 to 1.
    """
    value = {name: quantity.value for name, quantity in result.quantities.items()}
    permeability, area = value["permeability"], value["area_fraction"]
    if not 0 <= area <= 1 + ROUND_OFF:
        yield f"the area is {area:.6g}"
    if (value["sealed"] == 1) != (permeability == 0) or value["leakage_per_width"] < 0:
        yield f"sealed is {value['sealed']:g} where the permeability is {permeability:.3g} m³"
    fractions = result.fields["gap_share"].values
    if fractions.min() < 0 or fractions.sum() > 1 + 1e-6:
        yield "the gap fractions are no distribution"
    if "gap" not in result.fields:
        return
    gap = result.fields["gap"].values
    gap = gap if scene.axis == 0 else gap.T
    low, high = bounds(gap)
    ends = result.model == "direct_leakage"
    open_ = leads_through(gap)
    if not ends and (permeability == 0) == open_:
        yield f"the permeability is {permeability:.3g} m³ where {'an' if open_ else 'no'} open path exists"
    if permeability > high * (1 + BOUND_TOLERANCE) or permeability < low * (1 - BOUND_TOLERANCE):
        yield f"the permeability is {permeability:.6g} m³, not {low:.6g} to {high:.6g}"


def leads_through(gap: Array) -> bool:
    """Whether an open path leads around the period in x.

    The answer follows from the connected components of several copies of the period. ``gap`` has shape (nx, ny), and is
    open where it is greater than 0.
    """
    nx, ny = gap.shape
    nodes = np.arange(nx * ny).reshape(nx, ny)
    for copies in COPIES:
        pairs = []
        for copy in range(copies):
            here = nodes + copy * nodes.size
            ahead = np.roll(here, -1, axis=0)
            ahead[-1] = nodes[0] + (copy + 1) % copies * nodes.size
            for other, open_ in (
                (ahead, (gap > 0) & (np.roll(gap, -1, axis=0) > 0)),
                (np.roll(here, -1, axis=1), (gap > 0) & (np.roll(gap, -1, axis=1) > 0)),
            ):
                pairs.append(np.array([here[open_], other[open_]]))
        one, two = np.concatenate(pairs, axis=1)
        size = copies * nodes.size
        parts = connected_components(coo_array((np.ones(one.size), (one, two)), shape=(size, size)))[1]
        parts = parts.reshape(copies, nx, ny)
        if ((parts[1] == parts[0]) & (gap > 0)).any() or ((parts[-1] == parts[0]) & (gap > 0)).any():
            return True
    return False


def bounds(gap: Array) -> tuple[float, float]:
    """The lower and the upper bound of the permeability along x, for conductances 2 h₁² h₂²/(h₁ + h₂) of the faces.

    Every line leaks separately at the lower bound; the pressure is uniform over every section at the upper bound. The
    bounds have the unit of ``gap`` (shape (nx, ny)) cubed.
    """
    ahead = np.roll(gap, -1, axis=0)
    both = gap + ahead
    faces = np.divide(2 * gap**2 * ahead**2, both, out=np.zeros_like(gap), where=both > 0)
    with np.errstate(divide="ignore"):
        lines = np.where((faces > 0).all(axis=0), 1 / np.mean(1 / faces, axis=0), 0.0)
        whole = float(1 / np.mean(1 / faces.mean(axis=1)))
    return float(lines.mean()), whole


def rough_gap(scene: RoughGap, result: Result) -> Iterator[str]:
    """The laws that a rough gap's result violates, in words.

    A is symmetric (without inertia), not negative, and not larger than that of a thin film with uniform pressure over
    every section, because Stokes flow dissipates more than a thin film, and flow with inertia more than Stokes flow.
    Friction is at least that of a smooth gap, times the square of the open fraction.
    """
    value = {name: quantity.value for name, quantity in result.quantities.items()}
    gap, mean = result.fields["gap"].values, scene.mean_gap
    a = np.array([[value["A11"], value["A12"]], [value["A21"], value["A22"]]])
    resolved = "vertices" in result.fields
    slack = COARSE_MESH_TOLERANCE if resolved else 1e-6
    size = max(a[0, 0], a[1, 1], 1e-6)
    if "inertia" not in result.provenance["keeps"] and abs(a[0, 1] - a[1, 0]) > slack * size:
        yield f"A12 = {a[0, 1]:.6g} is not A21 = {a[1, 0]:.6g}"
    if np.linalg.eigvalsh((a + a.T) / 2).min() < -slack * size:
        yield f"pressure drives liquid backwards, A = {a.tolist()}"
    if not 0 <= value["contact_area"] < 1 or gap.min() < 0:
        yield f"contact {value['contact_area']:.6g}, smallest gap {gap.min():.3g} m"
    if result.model == "smooth_gap":
        return
    for name, own in (("A11", gap), ("A22", gap.T)):
        low, high = (bound / mean**3 for bound in bounds(own))
        if value[name] > high * (1 + slack) + BOUND_TOLERANCE:
            yield f"{name} = {value[name]:.6g} is above its upper bound, {high:.6g}"
        if result.model == "homogenized" and value[name] < low * (1 - slack) - BOUND_TOLERANCE:
            yield f"{name} = {value[name]:.6g} is below its lower bound, {low:.6g}"
        if result.model == "homogenized" and (value[name] == 0) == leads_through(own):
            yield f"{name} = {value[name]:.6g} contradicts the open paths"
    open_ = float(((gap > 0) & (np.roll(gap, -1, 0) > 0) & (np.roll(gap, 1, 0) > 0)).mean())
    if "friction" in value and value["friction"] < open_**2 * (1 - slack):
        yield f"friction {value['friction']:.6g} is less than that of a smooth gap where it is open"
