"""Dapp and Müser's exponent of the flow resistance of a saddle point before contact closes it."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.mechanics.contact import Contact
from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.homogenization.paths import sealed
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.seal.leakage.direct import direct_flow
from roughfilm.validation.published import Answer, Curve, Row, Source, Study
from roughfilm.validation.reading import published

GRIDS, FINER_GRIDS = (256, 512), (512, 1024)
"""Points along a side of the cell, which has one saddle in each direction; the last grid gives the exponent."""

BRACKET = (1.2, 1.6)
"""Loads between which the saddle closes, E* times the amplitude over the wavelength."""

BISECTIONS = 16

DISTANCES = np.geomspace(0.5, 0.005, 21)
"""Distances from the load Lc that closes the saddle, (Lc − L)/Lc."""

RANGES = (0.03, 0.06, 0.12)
"""Largest distances of the points to which the power law is fitted; the first gives the exponent."""

TOLERANCE = 1e-10
"""Complementarity of the contact: the gap in the saddle is a thousandth of the amplitude."""


@dataclass(frozen=True, kw_only=True)
class Closing:
    """A saddle on one grid: the load that closes it, and at each load before the flow through it.

    Attributes
    ----------
    load : Lc, in E* times the amplitude over the wavelength.
    loads, permeability, gap, open_points : L, K, the gap in the middle of the saddle, and the number of open points
        across it, at each distance.
    """

    load: float
    loads: Array
    permeability: Array
    gap: Array
    open_points: tuple[int, ...]

    def exponent(self, farthest: float) -> float:
        """The exponent β of K = C (Lc − L)^β exp(b (Lc − L)) fitted to distances up to ``farthest``; Lc is fitted too.

        The exponential is the leading correction to the power law.
        """
        chosen = 1 - self.loads / self.load <= farthest
        loads, flow = self.loads[chosen], np.log(self.permeability[chosen])
        closes = float(loads.max())

        def misfit(unknown: Array) -> Array:
            left = closes * (1 + np.exp(unknown[2])) - loads
            return np.asarray(unknown[0] + unknown[1] * np.log(left) + unknown[3] * left - flow)

        start = np.array([0.0, 3.0, np.log(self.load / closes - 1), 0.0])
        return float(least_squares(misfit, start, x_scale=np.array([1.0, 1.0, 0.1, 1.0])).x[1])

    @property
    def local(self) -> Array:
        """The local exponents d ln K/d ln(Lc − L) between neighbouring loads."""
        return np.asarray(np.diff(np.log(self.permeability)) / np.diff(np.log(self.load - self.loads)))


def answer(thorough: bool, progress: Progress) -> Answer:
    """The exponent, with its change with the range of the fit and with the grid as uncertainty."""
    grids = FINER_GRIDS if thorough else GRIDS
    work = [float(points**2) for points in grids]
    found = []
    for number, points in enumerate(grids):

        def step(fraction: float, words: str, number: int = number) -> None:
            progress((sum(work[:number]) + fraction * work[number]) / sum(work), words)

        found.append(closing(points, step))
    exponents = {points: [one.exponent(far) for far in RANGES] for points, one in zip(grids, found, strict=True)}
    own = exponents[grids[-1]]
    spread = max(abs(own[0] - other) for other in (own[1], exponents[grids[0]][0]))
    fact = next(one for one in published("sealing") if one["quantity"].startswith("exponent"))
    row = Row(
        case=f"square lattice of crests, {grids[-1]} × {grids[-1]} points",
        series="saddle",
        at=1.0,
        quantity="exponent of the resistance",
        unit="1",
        published=float(fact["published"]),
        ours=own[0],
        uncertainty=spread,
        bar=float(fact["uncertainty"]),
    )
    return Answer(
        rows=(row,),
        remarks=_remarks(found[-1], grids[-1], own),
        studies=(_fits(exponents),),
        curves=(_curve(found[-1], row.published),),
    )


def closing(points: int, progress: Progress) -> Closing:
    """Press z = cos x + cos y on a plane, until contact closes the saddles between its crests, and solve the flow."""
    x = np.cos(2 * np.pi * np.arange(points) / points)
    press = Press(x[:, None] + x, (1 / points, 1 / points), 1.0)
    low, high = BRACKET
    contact: Contact | None = None
    for number in range(BISECTIONS):
        progress(0.4 * number / BISECTIONS, f"saddle of {points} × {points} points, closing load")
        middle = (low + high) / 2
        contact = press.at(middle, start=contact, tolerance=TOLERANCE)
        low, high = (low, middle) if sealed(contact.gap)[1] else (middle, high)
    closes = (low + high) / 2
    loads, flows, gaps, counts = closes * (1 - DISTANCES), [], [], []
    for number, load in enumerate(loads):
        progress(0.4 + 0.6 * number / len(loads), f"saddle of {points} × {points} points, flow")
        contact = press.at(float(load), start=contact, tolerance=TOLERANCE)
        flows.append(direct_flow(contact.gap, press.spacing, 1).permeability)
        gaps.append(float(contact.gap[points // 2, 0]))
        counts.append(int(np.count_nonzero(contact.gap[:, 0])))
    return Closing(
        load=closes, loads=loads, permeability=np.array(flows), gap=np.array(gaps), open_points=tuple(counts)
    )


def _remarks(one: Closing, points: int, exponents: list[float]) -> tuple[str, ...]:
    far, near = one.local[0], one.local[-1]
    of_gap = np.diff(np.log(one.gap))[-1] / np.diff(np.log(one.load - one.loads))[-1]
    return (
        f"The local exponent falls from {far:.2f} at half of the closing load to {near:.3f} at {100 * DISTANCES[-1]:g} "
        f"% before it, where {one.open_points[-1]} of {points} points across the saddle are open; there the gap in the "
        f"middle of the saddle follows the power {of_gap:.2f}.",
        f"Fitted with the leading correction up to {', '.join(f'{100 * far:g} %' for far in RANGES)} before the "
        f"closing load: {', '.join(f'{value:.3f}' for value in exponents)}. The closing load is fitted too.",
    )


def _fits(exponents: dict[int, list[float]]) -> Study:
    return Study(
        title="Exponent by grid and by the farthest load of the fit",
        columns=("points along a side", *(f"up to {100 * far:g} % before closing" for far in RANGES)),
        cells=tuple((str(points), *(f"{one:.3f}" for one in own)) for points, own in exponents.items()),
    )


def _curve(one: Closing, exponent: float) -> Curve:
    middle = np.sqrt(DISTANCES[1:] * DISTANCES[:-1])
    return Curve(
        title="local exponent of the resistance",
        abscissa="distance from the closing load, (Lc − L)/Lc",
        ordinate="d ln K/d ln(Lc − L)",
        x=tuple(middle.tolist()),
        ours=tuple(one.local.tolist()),
        published_x=(float(middle[-1]), float(middle[0])),
        published=(exponent, exponent),
        logarithmic=True,
    )


def _method(grids: tuple[int, ...]) -> str:
    points = " and ".join(f"{one} × {one}" for one in grids)
    return f"elastic contact and direct flow through one period of z = cos x + cos y, on {points} points"


SOURCE = Source(
    name="dapp_mueser",
    title="Dapp and Müser 2015: saddle before it closes",
    citation="W. B. Dapp, M. H. Müser, EPL 109 (2015) 44001, doi:10.1209/0295-5075/109/44001",
    obtained="The abstract: resistance ~ (Lc − L)^−3.45 for the load L and the load Lc that closes the saddle, without "
    "adhesion.",
    methods=(_method(GRIDS), _method(FINER_GRIDS)),
    bar="0.05",
    abscissa="",
    cost=(7.0, 25.0),
    answer=answer,
)
