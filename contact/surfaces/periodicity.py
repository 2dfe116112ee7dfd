"""The periodicity mismatch of a surface: steps across its opposite edges, compared with steps inside it."""

from pathlib import Path

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.surfaces.surface import Surface

MISMATCH_THRESHOLD = 0.1
"""Mismatch above which a warning is given.

About 4 in 100 periodic random surfaces lie above it, and all windows cut from them without joining the edges."""

INTERIOR_QUANTILE = 0.98
"""Quantile of the interior structure function with which the joint is compared; scratches lie above it."""

LAG_DIVISOR = 16
"""Length of the surface over the longest lag; longer lags leave too few interior places for comparison."""


Places = tuple[Array | None, Array | None]
"""For the joints across x and across y, the first pixel behind the joint on every line across it; None for pixel 0."""


def periodicity_mismatch(surface: Surface, seams: Places = (None, None)) -> float:
    """The excess of the structure function across the joint of opposite edges over its interior values.

    For a direction and a lag l, S(i) = ⟨(h_{k+l} − h_k)²⟩ over the l pairs of lines k = i − l … i − 1 that straddle
    place i. The joint is place 0 of the repeated surface; its excess is (S(0) − s) / (2 Sq²), where s is the 98 %
    quantile of S inside. The mismatch is the largest excess over both directions and the lags 1, 2, 4 … up to a
    sixteenth of the surface.

    Parameters
    ----------
    surface : without invalid pixels; they would count as 0 m.
    seams : where opposite edges meet, by default at pixel 0. Along a seam S is taken over pairs that straddle the seam,
        and inside over those that straddle the seam moved by i pixels.

    Returns
    -------
    float : 0 if the joint is no rougher than the interior; about 1 for uncorrelated edges of a smooth surface.

    Notes
    -----
    Lags above one pixel detect ridges that end at a joint smoothed by blending. The measure fails where the interior is
    as rough as the joint: white noise, or square grooves of which one has another width.
    """
    return max(mismatches(surface, seams))


def mismatches(surface: Surface, seams: Places = (None, None)) -> tuple[float, float]:
    """The mismatch of the joints across x and across y, of which :func:`periodicity_mismatch` is the larger one."""
    centred = surface.heights - surface.heights.mean()
    variance = float(np.mean(centred**2))
    if variance == 0:
        return 0.0, 0.0
    x, y = (
        mismatch_across(lines, seam) / (2 * variance) for lines, seam in zip((centred, centred.T), seams, strict=True)
    )
    return x, y


def mismatch_across(lines: Array, seam: Array | None = None) -> float:
    """The largest excess of the structure function at one joint, the unit of the heights squared.

    Parameters
    ----------
    lines : heights, shape (lines across the joint, places along it).
    seam : first line behind the joint at every place; by default line 0.
    """
    straight = _straightened(lines, seam)
    lags = (2**power for power in range(max(1, lines.shape[0] // LAG_DIVISOR).bit_length()))
    return max(0.0, *(_excess(straight, lag) for lag in lags))


def _straightened(lines: Array, seam: Array | None) -> Array:
    """The lines, each moved along itself so that the seam becomes line 0."""
    if seam is None:
        return lines
    count = lines.shape[0]
    return np.take_along_axis(lines, (np.arange(count)[:, None] + seam) % count, axis=0)


def _excess(lines: Array, lag: int) -> float:
    count = lines.shape[0]
    squares = np.mean((np.roll(lines, -lag, axis=0) - lines) ** 2, axis=1)
    sums = np.concatenate([[0.0], np.cumsum(squares)])
    inside = (sums[lag : count - lag + 1] - sums[: count - 2 * lag + 1]) / lag
    joint = (sums[count] - sums[count - lag]) / lag
    return float(joint - np.quantile(inside, INTERIOR_QUANTILE))


def not_periodic(surface: Surface, name: str | Path, remedy: str) -> tuple[str, ...]:
    """The sentence on a surface whose opposite edges meet in steps where it is repeated; none if they do not.

    Parameters
    ----------
    surface : without invalid pixels.
    name : file or argument of the surface, which begins the sentence.
    remedy : how its edges are joined, which ends it.
    """
    mismatch = 0.0 if surface.periodic else periodicity_mismatch(surface)
    if not mismatch > MISMATCH_THRESHOLD:
        return ()
    return (f"{name}: is not periodic (mismatch {mismatch:.2g}), so that its edges meet in steps; {remedy}",)


def joint_mismatch(surface: Surface) -> float:
    """The periodicity mismatch along the joint of a surface.

    A prepared surface has it in its record, since seams join it away from pixel 0; for all others it is
    `periodicity_mismatch` at pixel 0.
    """
    known = surface.source.get("record", {}).get("periodicity_mismatch")
    return periodicity_mismatch(surface) if known is None else float(known["after"])


def is_joined_at_pixel_0(surface: Surface) -> bool:
    """Whether opposite edges meet between the last pixel and pixel 0: everywhere but on surfaces joined along seams."""
    edges = surface.source.get("record", {}).get("edges", {})
    return bool(edges.get("method") != "seams")
