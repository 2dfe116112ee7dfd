"""Wang and Müser's area of contact at which random roughness seals."""

import math

import numpy as np

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.synthetic.self_affine import self_affine
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.seal.leakage.percolation import thresholds
from roughfilm.validation.published import Answer, Row, Source, Study
from roughfilm.validation.reading import published

BAR = 0.005
"""Accuracy of the published area, which the source gives as near 0.415."""

HURST, CUT_OFF = 0.8, 8
"""Hurst exponent, and the shortest wavelength in points."""

USUAL, THOROUGH = (256, 8, 16), (512, 16, 24)
"""Points along a side, roll-off wavelengths along it, and number of surfaces."""

SIDE, RMS, MODULUS = 1e-3, 1e-6, 1e9
"""Side and rms height, m, and composite modulus, Pa."""

TOLERANCE, PRECISION = 1e-6, 0.02
"""Complementarity of the contacts, and relative width of the bracket of the load."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """The mean area at the threshold over surfaces and both directions."""
    points, waves, seeds = THOROUGH if thorough else USUAL
    areas = []
    for seed in range(seeds):
        progress(seed / seeds, f"threshold of contact, surface {seed + 1} of {seeds}")
        areas.append(_areas(points, waves, seed))
    found = np.array(areas)
    fact = next(one for one in published("sealing") if one["quantity"].startswith("area"))
    row = Row(
        case=f"{seeds} surfaces of {points} × {points} points, {waves} roll-off wavelengths along a side",
        series="threshold",
        at=1.0,
        quantity="contact area fraction at which roughness seals",
        unit="1",
        published=float(fact["published"]),
        ours=float(found.mean()),
        uncertainty=2 * float(found.mean(axis=1).std(ddof=1)) / math.sqrt(seeds),
        bar=BAR,
    )
    return Answer(rows=(row,), studies=(_scatter(found),))


def _areas(points: int, waves: int, seed: int) -> tuple[float, float]:
    """The area fractions at which flow from end to end stops in x and in y, with periodic sides."""
    surface = self_affine(
        size=(SIDE, SIDE),
        points=(points, points),
        seed=seed,
        hurst=HURST,
        roll_off=SIDE / waves,
        cut_off=CUT_OFF * SIDE / points,
        rms_height=RMS,
    )
    press = Press(surface.heights, surface.spacing, MODULUS)

    def at(load: float, start: Contact | None) -> Contact:
        return press.at(load, start=start, tolerance=TOLERANCE)

    begin = 0.1 * math.pi * MODULUS * RMS * waves / SIDE
    along, across, _, _ = thresholds(at, begin, 1e4 * begin, precision=PRECISION)
    return along.area_fraction, across.area_fraction


def _scatter(areas: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> Study:
    return Study(
        title="Area fraction at the threshold by surface",
        columns=("surface", "in x", "in y"),
        cells=tuple((str(number + 1), *(f"{one:.3f}" for one in pair)) for number, pair in enumerate(areas)),
    )


_METHOD = (
    f"elastic contact of self-affine surfaces, H = {HURST:g}, {CUT_OFF} points in the shortest wave; mean over "
    "surfaces and both directions, twice its standard error"
)

SOURCE = Source(
    name="wang_mueser",
    title="Wang and Müser 2021: contact area that seals",
    citation="A. Wang, M. H. Müser, Percolation and Reynolds Flow in Elastic Contacts of Isotropic and Anisotropic, "
    "Randomly Rough Surfaces, Tribology Letters 69 (2021), doi:10.1007/s11249-020-01378-7",
    obtained="The abstract: near 0.415, for roughness that extends beyond its roll-off.",
    methods=(_METHOD, _METHOD),
    bar="0.005, what 'near 0.415' is taken to mean",
    abscissa="",
    cost=(8.0, 36.0),
    answer=answer,
)
