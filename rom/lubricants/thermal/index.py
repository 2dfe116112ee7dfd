"""The viscosity index of an oil (ASTM D2270, ISO 2909), from the viscosities at 40 and 100 °C and back."""

import math
from bisect import bisect_right

LEAST_HOT = 2.0
"""Kinematic viscosity at 100 °C from which a viscosity index is defined, mm²/s."""

MOST_HOT = 1e5
"""Largest kinematic viscosity at 100 °C that is sought, mm²/s."""

MOST_INDEX = 500.0
"""Largest viscosity index that is taken."""

SEGMENTS = (
    (2.0, (1.14673, 1.7576, -0.109), (0.84155, 1.5521, -0.077)),
    (3.8, (3.38095, -15.4952, 33.196), (0.78571, 1.7929, -0.183)),
    (4.4, (2.50000, -7.2143, 13.812), (0.82143, 1.5679, 0.119)),
    (5.0, (0.10100, 16.6350, -45.469), (0.04985, 9.1613, -18.557)),
    (6.4, (3.35714, -23.5643, 78.466), (0.22619, 7.7369, -16.656)),
    (7.0, (0.01191, 21.4750, -72.870), (0.79762, -0.7321, 14.610)),
    (7.7, (0.41858, 16.1558, -56.040), (0.05794, 10.5156, -28.240)),
    (9.0, (0.88779, 7.5527, -16.600), (0.26665, 6.7015, -10.810)),
    (12.0, (0.76720, 10.7972, -38.180), (0.20073, 8.4658, -22.490)),
    (15.0, (0.97305, 5.3135, -2.200), (0.28889, 5.9741, -4.930)),
    (18.0, (0.97256, 5.2500, -0.980), (0.24504, 7.4160, -16.730)),
    (22.0, (0.91413, 7.4759, -21.820), (0.20323, 9.1267, -34.230)),
    (28.0, (0.87031, 9.7157, -50.770), (0.18411, 10.1015, -46.750)),
    (40.0, (0.84703, 12.6752, -133.310), (0.17029, 11.4866, -80.620)),
    (55.0, (0.85921, 11.1009, -83.190), (0.17130, 11.3680, -76.940)),
    (70.0, (0.83531, 14.6731, -216.246), (0.16841, 11.8493, -96.947)),
)
"""From which ν at 100 °C, mm²/s, the quadratics of L and H hold, and their coefficients, the highest power first."""


def reference_viscosities(hot: float) -> tuple[float, float]:
    """The kinematic viscosities at 40 °C, L and H, of oils with the indices 0 and 100, mm²/s.

    Parameters
    ----------
    hot : kinematic viscosity at 100 °C of all three oils, mm²/s, at least 2.

    Examples
    --------
    >>> print(*(f"{one:.2f}" for one in reference_viscosities(8.86)))
    119.96 69.48
    """
    _, *quadratics = SEGMENTS[max(bisect_right(SEGMENTS, hot, key=lambda one: one[0]) - 1, 0)]
    low, high = (float((a * hot + b) * hot + c) for a, b, c in quadratics)
    return low, high


def viscosity_index(warm: float, hot: float) -> float:
    """The viscosity index of an oil.

    Below 100 it is 100 (L - ν40)/(L - H), above it 100 + ((H/ν40)^(1/log10 ν100) - 1)/0.00715, not rounded.

    Parameters
    ----------
    warm, hot : kinematic viscosities at 40 and 100 °C, mm²/s; at 100 °C at least 2.

    Examples
    --------
    >>> print(f"{viscosity_index(73.30, 8.86):.1f} {viscosity_index(22.83, 5.05):.1f}")
    92.4 156.5
    """
    low, high = reference_viscosities(hot)
    if warm >= high:
        return 100 * (low - warm) / (low - high)
    return 100 + (10 ** (math.log(high / warm) / math.log(hot)) - 1) / 0.00715


def kinematic_viscosity_100(warm: float, index: float) -> float | None:
    """The kinematic viscosity at 100 °C, mm²/s, of an oil with a viscosity index; None below 2 mm²/s.

    Parameters
    ----------
    warm : kinematic viscosity at 40 °C, mm²/s.
    index : viscosity index, at least 0.

    Examples
    --------
    >>> print(f"{kinematic_viscosity_100(32, 95):.3f}")
    5.290
    """
    from scipy.optimize import brentq  # slow to import

    def excess(logarithm: float) -> float:
        return viscosity_index(warm, math.exp(logarithm)) - index

    if excess(math.log(LEAST_HOT)) > 0:
        return None
    # The index rises with ν100, but for steps of 0.1 % between two of the quadratics.
    return float(math.exp(brentq(excess, math.log(LEAST_HOT), math.log(max(warm, 2 * LEAST_HOT)), xtol=1e-14)))
