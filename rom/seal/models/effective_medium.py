"""Leakage by Persson's contact theory and an effective medium, from the spectrum alone."""

import math

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.moments import wave_power
from roughfilm.rom.dry_contact.gaussian import skewed, with_lay
from roughfilm.rom.dry_contact.model import Answer, Task, contact_model
from roughfilm.rom.ladder.model import Applicability, Effect
from roughfilm.rom.ladder.result import with_uncertainties
from roughfilm.rom.seal.leakage.scatter import MEAN_SEALING_LOAD, SEALING_LOADS
from roughfilm.rom.seal.model import gap_distribution, leakage_uncertainties, quantities
from roughfilm.rom.seal.scene import Seal

RELATIVE_UNCERTAINTY = 0.75
"""Relative uncertainty of the leakage within the range of the model.

The leakage of 95 of 100 random surfaces without a lay, up to a third of the mean sealing load, is 0.35 to 1.75 times
that of the model (236 cases by ``direct_leakage``).
"""

RESIDUAL_MEANING = "residual of the equation of the effective medium, over its positive terms"

FLAT_SURFACE = "got a flat surface, which has no spectrum; it is sealed, take direct_leakage"


def work(task: Task) -> Answer:
    """The estimate from the spectrum of the task's heights; InputError for a flat surface."""
    from roughfilm.rom.seal.leakage.effective_medium import effective_medium  # scipy is slow to import

    scene: Seal = task.scene
    own = task.heights.shape == scene.surface().shape
    spectrum = scene.spectrum() if own else wave_power(task.heights, task.spacing)
    if spectrum is None:
        raise InputError(f"effective_medium: {FLAT_SURFACE}")
    medium = effective_medium(spectrum, composite_modulus=scene.composite_modulus, load=scene.load.pressure)
    rms = float(task.heights.std())
    doubts = out_of_range(scene, task)
    uncertainty = math.inf if doubts else RELATIVE_UNCERTAINTY * medium.permeability
    return Answer(
        quantities=with_uncertainties(
            quantities(scene, medium.permeability, medium.sealed, medium.area_fraction, medium.mean_gap, rms),
            leakage_uncertainties(scene, uncertainty),
        ),
        fields=gap_distribution(rms, medium.gaps, medium.fractions),
        residual=medium.residual,
        iterations=1,
        warnings=doubts,
    )


def out_of_range(scene: Seal, task: Task) -> tuple[str, ...]:
    """The reasons for which the leakage may be wrong by more than ``RELATIVE_UNCERTAINTY``, one sentence each."""
    warnings = [] if scene.solid.hardness is None else ["the solid is treated as elastic"]
    load = scene.load.pressure / scene.pressure_unit
    if load > MEAN_SEALING_LOAD / 3:
        low, high = SEALING_LOADS["without a lay"]
        warnings.append(
            f"P = {load:.2g} E* g' is above a third of the mean sealing load, {MEAN_SEALING_LOAD} ({low} to {high} "
            "without a lay) E* g', and the leakage may be wrong by orders of magnitude: out of its range, take "
            "direct_leakage"
        )
    deviations = (with_lay(task.heights, task.spacing), skewed(task.heights))
    warnings += [f"{sentence}: out of its range, take direct_leakage" for sentence in deviations if sentence]
    return tuple(warnings)


def prepare(_task: Task) -> None:
    """Import modules whose import time is not part of the cost."""
    import roughfilm.rom.seal.leakage.effective_medium  # noqa: F401


def applies(scene: Seal) -> Applicability:
    """The neglected effects and the error; the model applies to every rough surface."""
    if scene.spectrum() is None:
        return Applicability(applies=False, reason=FLAT_SURFACE)
    reason = (
        "keeps elastic contact of all scales on average over all isotropic Gaussian surfaces of this spectrum; leaves "
        "out plasticity, lay, and the sealing area of the individual surface: error within a factor of three up "
        "to a third of the mean load that seals, orders of magnitude near it"
    )
    return Applicability(applies=True, reason=reason)


MODEL = contact_model(
    kind="seal",
    name="effective_medium",
    summary="leakage from the spectrum: gaps by Persson's theory, averaged as an effective medium",
    keeps=frozenset({Effect.DEFORMATION, Effect.ROUGHNESS}),
    complete=False,
    sources=(
        "10.1140/epje/i2010-10558-6",
        "10.1103/PhysRevLett.108.244301",
        "10.1007/s11249-020-01378-7",
        "10.1016/j.jmps.2011.08.004",
    ),
    residual_meaning=RESIDUAL_MEANING,
    applies=applies,
    work=work,
    prepare=prepare,
    tolerance=1e-9,
    cost=lambda heights: 6e-3 + 3e-7 * heights,
)
