"""Families of synthetic surfaces that replace the ten unpublished ones of Paper F, and their eight heights."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from roughfilm.contact.parameters.heights import height_statistics
from roughfilm.contact.parameters.roughness_parameters import parameters
from roughfilm.contact.preparation.recipe import read_recipe
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.distribution import rms_slope, with_skewness
from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.contact.synthetic.plateau_honed import plateau_honed
from roughfilm.contact.synthetic.self_affine import self_affine
from scripts.studies.thesis_clipping import prepare_as_in_the_thesis

SIDE = 42e-6
"""Side of the surfaces, as in the source, m."""

POINTS = 128
SHORTEST_WAVE = SIDE / 16
"""Shortest wavelength of the self-affine families, 8 nodes, m."""

MIN_AVERAGE, MAX_AVERAGE = 0.06e-6, 0.48e-6
"""Least and greatest Sa of the surfaces of the source, m."""

SEEDS = tuple(range(501, 509))

HEIGHTS = ("Sa", "Sq", "St", "Sz", "Sp", "Spm", "Sv", "Svm")
"""Names of the heights of Figs. F.7 and F.10; St is the total height and Sz = Spm + Svm, as in the source."""

MEASURED = ("isotropic.al3d", "ground_striated.x3p", "oblique_grooves.x3p", "milled_NT1100.opd")
MEASURED_AVERAGE = 0.17e-6
"""Sa to which measured surfaces are scaled, the mean of the source, m."""

Family = Callable[[int, int], Surface]
"""Type of a function family(seed, points) that returns a surface of side ``SIDE`` and any height."""


@dataclass(frozen=True, kw_only=True)
class Made:
    """A surface with its family and the seed that distinguishes it within the family."""

    family: str
    seed: int
    surface: Surface

    @property
    def name(self) -> str:
        """Family and seed."""
        return f"{self.family} {self.seed}"


def _random(
    seed: int, points: int, *, length: float, skewness: float = 0.0, anisotropy: float = 1.0, lay: float = 0.0
) -> Surface:
    made = gaussian(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=seed,
        rms_height=1e-6,
        correlation_length=length,
        anisotropy=anisotropy,
        lay_angle=np.radians(lay),
        amplitudes="random",
    )
    return with_skewness(made, skewness) if skewness else made


def _fractal(seed: int, points: int, *, hurst: float, roll_off: float) -> Surface:
    return self_affine(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=seed,
        hurst=hurst,
        roll_off=roll_off,
        cut_off=SHORTEST_WAVE,
        rms_height=1e-6,
        amplitudes="random",
    )


def _plateau(seed: int, points: int) -> Surface:
    return plateau_honed(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=seed,
        plateau_rms_height=0.3e-6,
        plateau_correlation_length=5e-6,
        valley_rms_height=1e-6,
        valley_correlation_length=6e-6,
        material_ratio=0.6,
        valley_anisotropy=2.0,
        half_angle=np.radians(45),
    )


FAMILIES: Mapping[str, Family] = {
    "smooth": partial(_random, length=8e-6),
    "fine": partial(_random, length=4e-6),
    "peaky": partial(_random, length=6e-6, skewness=1.0),
    "valley-rich": partial(_random, length=6e-6, skewness=-1.0),
    "plateau": _plateau,
    "striated": partial(_random, length=4e-6, anisotropy=4.0),
    "oblique": partial(_random, length=4e-6, anisotropy=4.0, lay=30.0),
    "H 0.8, 42 µm": partial(_fractal, hurst=0.8, roll_off=SIDE),
    "H 0.8, 14 µm": partial(_fractal, hurst=0.8, roll_off=SIDE / 3),
    "H 0.5, 21 µm": partial(_fractal, hurst=0.5, roll_off=SIDE / 2),
    "H 0.3, 42 µm": partial(_fractal, hurst=0.3, roll_off=SIDE),
}
"""Families by name: random surfaces with Sal of 4 to 8 µm across the lay, and self-affine ones by Hurst exponent and
roll-off. Their Sq/g′ is close to the 1.4 to 2.9 µm that follow from the source's loads at W/(E* g′) = 0.28."""


def scaled(surface: Surface, average: float) -> Surface:
    """Return the surface with a mean of 0, scaled to Sa = ``average``, m."""
    heights = surface.heights - surface.heights.mean()
    return surface.with_heights(heights * (average / height_statistics(heights).average))


def made_surfaces(
    families: Sequence[str] = tuple(FAMILIES), seeds: Sequence[int] = SEEDS, points: int = POINTS
) -> list[Made]:
    """Return independent surfaces; Sa in a family is from ``MIN_AVERAGE`` to ``MAX_AVERAGE``, by a constant factor.

    Sa only sets the unit of heights and loads: elasticity is linear, and a surface s times as high needs s times the
    load for the same spots of contact. The order of Sa differs between families.
    """
    averages = np.geomspace(MIN_AVERAGE, MAX_AVERAGE, len(seeds)) if len(seeds) > 1 else np.array([MEASURED_AVERAGE])
    return [
        Made(family=family, seed=seed, surface=scaled(FAMILIES[family](seed + 1000 * number, points), average))
        for number, family in enumerate(families)
        for seed, average in zip(seeds, np.random.default_rng(number + 7).permutation(averages), strict=True)
    ]


def measured_surfaces(folder: Path | None, points: int = POINTS, names: Sequence[str] = MEASURED) -> list[Made]:
    """Return the measured surfaces of a folder, prepared, with the longer side scaled to ``SIDE`` and Sa scaled."""
    if folder is None:
        return []
    recipe = read_recipe({"grid": {"points": [points, points]}, "edges": {"method": "blended"}})
    made = []
    for number, file in enumerate(folder / name for name in names):
        if file.is_file():
            one = prepare_as_in_the_thesis(read_surface(file), recipe).surface
            part = SIDE / max(one.size)
            shrunk = Surface(heights=one.heights, spacing=(one.spacing[0] * part, one.spacing[1] * part), periodic=True)
            made.append(Made(family=file.stem, seed=number, surface=scaled(shrunk, MEASURED_AVERAGE)))
    return made


@dataclass(frozen=True, kw_only=True)
class Numbers:
    """Parameters of a surface.

    Attributes
    ----------
    heights : heights by the names of ``HEIGHTS``, m. A peak of Spm is a node that no other one within Sal in x and in y
        exceeds, so that the five peaks are different bumps (`contact.parameters.peaks`); the source does not say how.
    slope : rms slope g′.
    decay : autocorrelation length Sal, m.
    aspect : texture aspect ratio Str.
    skewness : skewness Ssk.
    """

    heights: Mapping[str, float]
    slope: float
    decay: float
    aspect: float
    skewness: float


def numbers_of(surface: Surface) -> Numbers:
    """Return all parameters of one surface."""
    found = {name: one.value for name, one in parameters(surface).items()}
    heights = {name: found[name] for name in HEIGHTS} | {"Sz": found["Spm"] + found["Svm"]}
    return Numbers(
        heights=heights, slope=rms_slope(surface), decay=found["Sal"], aspect=found["Str"], skewness=found["Ssk"]
    )
