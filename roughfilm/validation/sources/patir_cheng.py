"""Patir and Cheng's fits of the flow factors of Gaussian surfaces."""

import math
from collections.abc import Mapping

import numpy as np

from roughfilm.contact.synthetic.gaussian import gaussian
from roughfilm.rom.homogenization.cell import solve_cell
from roughfilm.rom.ladder.model import Progress
from roughfilm.validation.published import Answer, Row, Source
from roughfilm.validation.reading import published

BAR = 0.05
"""Relative accuracy of the fits."""

GAPS = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0)
"""Nominal gaps H = h/σ."""

SEEDS, MORE_SEEDS = 6, 24

POINTS, WAVE = 384, 10
"""Number of points along a side, and correlation length across the lay, at which the autocorrelation is 0.2, points."""

RATIOS = (1 / 3, 1.0, 3.0)
"""Ratios γ of the correlation lengths along and across the flow."""

CELL_TOLERANCE = 1e-5


def answer(thorough: bool, progress: Progress) -> Answer:
    """The pressure and the shear flow factor of surfaces of three ratios γ."""
    rows: list[Row] = []
    seeds = MORE_SEEDS if thorough else SEEDS
    for number, ratio in enumerate(RATIOS):
        fit = next(
            one for one in published("patir_cheng") if math.isclose(float(one["gamma [1]"]), ratio, rel_tol=1e-5)
        )
        factors = []
        for seed in range(seeds):
            progress(
                (number + seed / seeds) / len(RATIOS), f"flow factors, γ = {ratio:.2g}, surface {seed + 1} of {seeds}"
            )
            factors.append(_factors(ratio, seed))
        rows += _rows(ratio, fit, np.array(factors))
    return Answer(rows=tuple(rows), remarks=(*_REMARKS, _second_order(rows)))


def _factors(ratio: float, seed: int) -> list[list[float]]:
    """The factors φ_x and Φ_s of one surface at each gap.

    With the rough wall at rest, flow per width is (u/2)(<h_T> − σ Φ_s) − φ_x h³ ∂p/∂x/(12η), where h is the distance of
    the mean planes and h_T = max(h + z, 0) the gap.
    """
    surface = gaussian(
        size=(POINTS * 1e-6, POINTS * 1e-6),
        points=(POINTS, POINTS),
        seed=seed,
        rms_height=1e-6,
        correlation_length=WAVE * 1e-6 * max(1.0, 1 / ratio),
        anisotropy=ratio,
    )
    heights = surface.heights / 1e-6
    found = []
    for gap in GAPS:
        local = np.maximum(gap + heights, 0.0)
        cell = solve_cell(local, (1.0, 1.0), tolerance=CELL_TOLERANCE).factors
        found.append([float(cell.pressure[0, 0]) / gap**3, float(local.mean() - cell.shear[0])])
    return found


def _rows(
    ratio: float, fit: Mapping[str, str], factors: np.ndarray[tuple[int, ...], np.dtype[np.float64]]
) -> list[Row]:
    """The means over the surfaces, with twice their standard errors."""
    mean, error = factors.mean(axis=0), factors.std(axis=0, ddof=1) / math.sqrt(len(factors))
    number = {name.partition(" [")[0]: float(text) for name, text in fit.items()}
    rows = []
    for which, gap in enumerate(GAPS):
        for kind, words in enumerate(("pressure flow factor φx", "shear flow factor Φs")):
            value = pressure_factor(number, gap) if kind == 0 else shear_factor(number, gap)
            rows.append(
                Row(
                    case=f"γ = {ratio:.2g}, H = {gap:g}",
                    series=f"γ = {ratio:.2g}",
                    at=gap,
                    quantity=words,
                    unit="1",
                    published=value,
                    ours=float(mean[which, kind]),
                    uncertainty=2 * float(error[which, kind]),
                    bar=BAR * value,
                )
            )
    return rows


def pressure_factor(fit: Mapping[str, float], gap: float) -> float:
    """φ_x = 1 − C exp(−r H) for γ <= 1 and 1 + C H^−r above."""
    if fit["gamma"] <= 1:
        return 1 - fit["C"] * math.exp(-fit["r"] * gap)
    return float(1 + fit["C"] * gap ** -fit["r"])


def shear_factor(fit: Mapping[str, float], gap: float) -> float:
    """Φ_s = A1 H^α1 exp(−α2 H + α3 H²) for H <= 5 and A2 exp(−H/4) above."""
    if gap > 5:
        return fit["A2"] * math.exp(-0.25 * gap)
    power = float(gap ** fit["alpha1"])
    return fit["A1"] * power * math.exp(-fit["alpha2"] * gap + fit["alpha3"] * gap**2)


def _second_order(rows: list[Row]) -> str:
    """The widest gap against the theory of second order in σ/h, which is exact for wide gaps."""
    words = []
    for ratio in RATIOS:
        across = 1 / (1 + ratio)  # <n₁²> of the waves of a surface with an elliptical autocorrelation
        theory = 1 + (3 - 9 * across) / GAPS[-1] ** 2, 3 * across / GAPS[-1]
        found = [row for row in rows if row.series == f"γ = {ratio:.2g}" and row.at == GAPS[-1]]
        words += [
            f"{row.quantity.split()[-1]} at γ = {ratio:.2g}: {value:.3f} (ours {row.ours:.3f}, fit {row.published:.3f})"
            for row, value in zip(found, theory, strict=True)
        ]
    return (
        f"At H = {GAPS[-1]:g} theory of second order in σ/h (Elrod 1979, Tripp 1983), independent of both, gives "
        f"{'; '.join(words)}."
    )


_REMARKS = (
    "H is the distance of the mean planes over the combined rms height σ, not the mean of the truncated gap; heights "
    "that would overlap are cut off, as in the papers, and are not pressed elastically.",
    "The fits go back to simulations of 1978 in boxes with closed sides; homogenized cells are periodic. "
    "The uncertainty of ours is twice the standard error of the mean over the surfaces.",
)


def _method(seeds: int) -> str:
    return f"homogenized cells of {POINTS} × {POINTS} points, {seeds} surfaces of each γ"


SOURCE = Source(
    name="patir_cheng",
    title="Patir and Cheng 1978: flow factors",
    citation="N. Patir, H. S. Cheng, J. Lubrication Technology 100 (1978) 12-17 and 101 (1979) 220-230",
    obtained="The coefficients in flowFactorsPatirCheng.C of foam-extend 4.0 (GPL-3), not read in the papers.",
    methods=(_method(SEEDS), _method(MORE_SEEDS)),
    bar="5 %, the upper end of the 2 to 5 % that the fits are worth",
    abscissa="nominal gap H = h/σ",
    cost=(7.0, 20.0),
    answer=answer,
)
