"""The truth of a small measured map: the contact of the complete map, without tilt, holes and preparation.

A random surface was drawn first and the map sampled from it, so that the heights between the points and in the holes
are known. A map that is one period is pressed as it is; one whose edges do not match is continued by its mirror images,
as between frictionless walls, so that no height is changed and no step is made.
"""

import math
from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.ladder import models
from roughfilm.rom.dry_contact.scene import DryContact
from roughfilm.rom.ladder.model import best_for
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from scripts.studies.coverage.finer import limits
from scripts.studies.coverage.surfaces import in_file
from scripts.studies.coverage.truth import Truth

FACTORS = (2, 4, 8)
"""Numbers of points along a side over those of the map; half of them for a map of ``MANY`` points and more."""

MANY = 1000


def truth(scene: DryContact) -> Truth:
    """Return the limit of fine grids of the contact of the complete map; the models' own equations are not judged."""
    surface, origin = scene.surface(), scene.surface().source["prepared_from"]
    period = np.load(Path(origin["complete"]))
    applying = [model for model in models(scene.kind) if not model.outside and model.applies(scene).applies]
    best = best_for(scene, applying)
    points = tuple(origin["points"])
    runs = []
    for factor in (one // 2 if math.prod(points) >= MANY else one for one in FACTORS):
        heights = complete(period, points, factor, whole=origin["whole"])
        geometry = in_file(heights, (surface.spacing[0] / factor, surface.spacing[1] / factor))
        runs.append(best.solve(read_scene({**scene_entries(scene), "geometry": geometry})))
    found = limits(runs)
    return Truth(
        values={name: value for name, (value, _) in found.items()},
        uncertainty={name: bar for name, (_, bar) in found.items()},
        method=f"{best.name} on the complete map at up to 4 or 8 times as many points a side, extrapolated",
        own={model.name: {} for model in applying},
    )


def complete(period: Array, points: tuple[int, ...], factor: int, *, whole: bool) -> Array:
    """Return the heights of the first ``points`` of a periodic surface at the centres of pixels finer by a factor.

    They are one period if ``whole``, otherwise they are continued by their mirror images in both directions.
    """
    waves = np.fft.fft2(period)
    for axis, count in enumerate(period.shape):
        number = np.fft.fftfreq(count) * count
        place = (np.arange(factor * points[axis]) + 0.5) / factor - 0.5
        matrix = np.exp(2j * np.pi * np.outer(place / count, number)) / count
        matrix[:, count // 2] = 0.0  # the wave of two points, which has no phase
        waves = np.moveaxis(np.tensordot(matrix, waves, (1, axis)), 0, axis)
    heights = np.asarray(waves.real)
    if not whole:
        heights = np.concatenate([heights, heights[::-1]])
        heights = np.concatenate([heights, heights[:, ::-1]], axis=1)
    return np.ascontiguousarray(heights)
