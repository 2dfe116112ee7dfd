"""Read the result of a rough gap's OpenFOAM cases that were run."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.units import Quantity
from roughfilm.foamcases.openfoam.case_directory import read_card
from roughfilm.foamcases.rough_gap.balance import imbalance
from roughfilm.foamcases.rough_gap.case import GapCard, mesh_of
from roughfilm.foamcases.rough_gap.dictionaries import DRIVES, SLIDING_SPEED
from roughfilm.foamcases.rough_gap.fields import GapFlow, read_gap_flow
from roughfilm.foamcases.rough_gap.mesh import Columns
from roughfilm.foamcases.rough_gap.run import GapRun
from roughfilm.foamcases.rough_gap.uncertainty import uncertainties
from roughfilm.rom.ladder.model import Model
from roughfilm.rom.ladder.provenance import provenance
from roughfilm.rom.ladder.result import Field, Numerics, Result, SolverRun, with_uncertainties
from roughfilm.rom.rough_gap.flow.factors import RoughGapFactors
from roughfilm.rom.rough_gap.quantities import gap_quantities, known_uncertainties
from roughfilm.rom.rough_gap.scene import RoughGap
from roughfilm.rom.rough_gap.validity import cautions, ruptures

MAX_IMBALANCE = 0.02
"""Largest imbalance of forces without a warning, over the drag of a smooth gap."""

MAX_LOST_SHEAR = 0.05
"""Largest fraction of the shear across a thin film that the columns may miss without a warning."""

MAX_CREEPING = 1.0
"""Largest Re g' at which uncertainties are given; one mesh cannot estimate the error of inertia, which counts above."""

MAX_CLOSED_IN = 1e-3
"""Largest fraction of the open volume that contact may close in without a warning."""


CAUSES = {
    "along": (0, "under the gradient along x"),
    "across": (1, "under the gradient along y"),
    "sliding": (None, "under sliding"),
}
"""The axis of the gradient of each drive, None without one, and the drive in words."""


def factors_of(flows: dict[str, GapFlow], *, slides: bool) -> tuple[RoughGapFactors, dict[str, float]]:
    """The flow factors of a gap over those of a smooth gap, and the factors B_j computed again from wall shear.

    With N uniform layers, the flow of a parabolic velocity is too large by the fraction 2/N² in every column: the
    velocity of each cell has the error g h²/(8 η N²), and the midpoint rule adds a third of that. Three corrections,
    which are exact in the limit of small slopes, follow:

    - A is divided by 1 + 2/N².
    - B needs no correction, because the pressure under a sliding wall is too small by the same fraction.
    - In the friction d + 3e, the part 3e, which is the friction less <1/h>, is multiplied by 1 + 2/N².

    In Stokes flow, the reciprocal theorem states that the flow under a gradient G along j pulls the upper wall with the
    stress h̄ B_j G/2. In a sealed direction the flow is set to zero, whatever the mean velocity of the cells is.

    Parameters
    ----------
    flows : the flows, by the names of their drives; a sealed direction has none.
    slides : whether the upper wall is flat and can slide.

    Returns
    -------
    tuple[RoughGapFactors, dict[str, float]]
        The factors, with NaN for shear and friction if there is no sliding flow; and "B1" and "B2" by the reciprocal
        theorem, for the drives that have a flow and if the upper wall slides.
    """
    still = RoughGapFactors(mean_gap=1.0, pressure=np.zeros((2, 2)), shear=np.full(2, np.nan), friction=np.nan)
    excess = 0.0
    pulled = {}
    for j, drive in enumerate(DRIVES[:2]):
        if drive.name in flows:
            flow = flows[drive.name]
            excess = 2 / flow.layers**2
            still.pressure[:, j] = flow.flow / (1 + excess)
            if slides:
                pulled[f"B{j + 1}"] = -flow.pull(0.0) / 6
    if "sliding" not in flows:
        return still, pulled
    flow = flows["sliding"]
    columns = flow.columns
    friction = flow.pull(SLIDING_SPEED) / SLIDING_SPEED
    couette = _shear(columns)
    passes = [drive.name in flows for drive in DRIVES[:2]]
    return replace(
        still,
        shear=np.where(passes, flow.flow / (SLIDING_SPEED / 2), 0.0),
        friction=friction + 2 / flow.layers**2 * (friction - couette),
    ), pulled


def lost_shear(scene: RoughGap, columns: Columns) -> float:
    """The fraction of <1/h>, the mean shear of a thin film on the surface's own points, that a mesh misses.

    The fraction is 1 - <1/h> of the columns / <1/h> of the points, and at least 0. Friction is at least that shear.
    """
    gap = scene.walls(max(scene.surface().shape)).gap / scene.mean_gap
    whole = float(np.divide(1.0, gap, out=np.zeros(gap.shape), where=gap > 0).mean())
    return max(0.0, 1 - _shear(columns) / whole)


def _shear(columns: Columns) -> float:
    """The mean of 1/h over the period, with 0 in closed columns and h in mean gaps."""
    return float(np.divide(1.0, columns.height, out=np.zeros(columns.kept.shape), where=columns.kept).mean())


def read(solver: Model[RoughGap], scene: RoughGap, directory: Path, run: GapRun) -> Result:
    """Read the result of a case that was run.

    The errors are those of :func:`roughfilm.foamcases.rough_gap.fields.read_gap_flow`.
    """
    model, keeps = solver.name, solver.keeps
    card = read_card(directory, GapCard)
    walls, columns = mesh_of(scene, card.resolution)
    flows = {name: read_gap_flow(directory / name, card, columns) for name in card.judged}
    factors, reciprocal = factors_of(flows, slides=walls.slides)
    shape = (*columns.kept.shape, card.layers)
    along = flows.get("along") or GapFlow(columns=columns, velocity=np.zeros((*shape, 3)), pressure=np.zeros(shape))
    speed = scene.nominal_flow / scene.mean_gap
    errors, thin = uncertainties(factors, scene, walls, card.layers)
    reynolds = {
        f"A{i}{i}_over_reynolds": Quantity(value=float(factors.pressure[i - 1, i - 1] / of), unit="1")
        for i in (1, 2)
        if (of := thin.pressure[i - 1, i - 1]) > 0
    }
    warnings = [*cautions(scene, walls), *run.warnings]
    unit = scene.pressure_gradient * scene.mean_gap / 12
    for name, flow in flows.items():
        axis, cause = CAUSES[name]
        warnings += ruptures(scene, flow.lowest_pressure(axis) * unit, cause)
    missed = {drive.name: imbalance(flows[drive.name], drive) for drive in DRIVES if drive.name in flows}
    if max(missed.values(), default=0.0) > MAX_IMBALANCE:
        warnings.append(
            f"the forces on the walls miss {max(missed.values()):.1%} of the drive; the mesh is too coarse or skew"
        )
    inertial = card.reynolds_number * scene.rms_slope > MAX_CREEPING
    if inertial:
        warnings.append("no uncertainty: one mesh cannot estimate the error of inertia; compare with a finer mesh")
    if columns.closed_in > MAX_CLOSED_IN:
        warnings.append(f"contact closes in {columns.closed_in:.1%} of the open volume, which is left out")
    if walls.slides and (lost := lost_shear(scene, columns)) > MAX_LOST_SHEAR:
        warnings.append(
            f"the walls are nearer between the columns than at them: the mesh misses {lost:.0%} of the shear across a "
            "thin film, and friction is too small by as much; take more columns"
        )
    for name, checked in run.flows.items():
        warnings += [f"{name}: {again}" for again in map(str, checked.tries[1:])]
    return Result(
        model=model,
        quantities=with_uncertainties(
            gap_quantities(scene, walls, factors) | reynolds, {} if inertial else known_uncertainties(errors, walls)
        ),
        fields={
            "gap": Field(values=walls.gap, unit="m"),
            "flow": Field(
                values=np.hypot(*np.moveaxis(along.flow_per_width, -1, 0)) * scene.nominal_flow, unit="m^2/s"
            ),
            "vertices": Field(values=columns.vertices * scene.mean_gap, unit="m"),
            "kept": Field(values=columns.kept.astype(float), unit="1"),
            "cell_velocity": Field(values=along.velocity * speed, unit="m/s"),
            "cell_pressure": Field(values=along.pressure * unit, unit="Pa"),
        },
        numerics=Numerics(
            residual=max(run.unsettled.values(), default=0.0),
            iterations=sum(flow.tries[-1].iterations for flow in run.flows.values()),
            cpu_s=run.cpu_s,
            wall_s=run.wall_s,
            degrees_of_freedom=4 * card.cells,
            resolution=card.resolution,
            tolerance=card.tolerance,
            scheme=card.scheme,
            processes=card.processes,
            runs=tuple(
                SolverRun(
                    name=name,
                    outcome=str(t.outcome),
                    iterations=t.iterations,
                    recipe=t.recipe,
                    residual=flow.residual if t is flow.tries[-1] else None,
                    imbalance=missed[name] if t is flow.tries[-1] else None,
                )
                for name, flow in run.flows.items()
                for t in flow.tries
            ),
            details={
                **{f"velocity_relaxation_{name}": value for name, value in card.relaxation.items()},
                "reynolds_number": card.reynolds_number,
                "layers": card.layers,
                "closed_in": columns.closed_in,
                **{f"reciprocal_{name}": value for name, value in reciprocal.items()},
            },
        ),
        provenance=provenance(scene, model=model, keeps=tuple(keeps), sources=solver.sources, openfoam=run.version),
        warnings=tuple(warnings),
    )
