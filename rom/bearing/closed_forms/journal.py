"""Closed-form solutions of journal bearings: infinitely wide, and infinitely short."""

import math
from dataclasses import dataclass

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError


@dataclass(frozen=True, kw_only=True)
class JournalSolution:
    """Solution of a journal bearing: load, N/m, and the angle from the narrowest place to the load line, degrees."""

    load: float
    attitude_angle: float


def sommerfeld(
    *, radius: float, clearance: float, eccentricity: float, speed: float, viscosity: float
) -> JournalSolution:
    """The solution of a full journal bearing without cavitation (full Sommerfeld condition).

    W = 12 π η u (R/c)² ε/((2 + ε²) √(1 - ε²)), at an attitude angle of 90°.

    Parameters
    ----------
    radius, clearance : radius R of the shaft and radial clearance c, m.
    eccentricity : relative eccentricity ε, 0 <= ε < 1.
    speed : surface speed of the shaft, m/s.
    viscosity : viscosity, Pa s.

    Raises
    ------
    InputError
        If the eccentricity is out of range.

    Source: Sommerfeld 1904, Zeitschrift für Mathematik und Physik 50, 97-155.
    """
    _check_eccentricity(eccentricity)
    denominator = (2 + eccentricity**2) * math.sqrt(1 - eccentricity**2)
    load = 12 * math.pi * viscosity * speed * (radius / clearance) ** 2 * eccentricity / denominator
    return JournalSolution(load=load, attitude_angle=90.0)


@dataclass(frozen=True, kw_only=True)
class JournalCoefficients:
    """The linear response of the film force on a shaft, dF = -K dq - B dq/dt.

    The coordinate x runs along the load and y across it, at 90° from x in the direction of rotation.

    Attributes
    ----------
    stiffness : K, N/m (N/m² of an infinitely wide bearing), shape (2, 2).
    damping : B, N s/m (N s/m²), shape (2, 2).
    """

    stiffness: Array
    damping: Array


def sommerfeld_coefficients(
    *, radius: float, clearance: float, eccentricity: float, speed: float, viscosity: float
) -> JournalCoefficients:
    """The stiffness and damping of a full, infinitely wide journal bearing without cavitation.

    With the load f(ε) of :func:`sommerfeld`, whose attitude angle of 90° does not depend on ε, the film force on a
    shaft is f (1 - 2 γ'/ω) across the line of centres and -12 π η (R³/c²) ε'/(1 - ε²)^(3/2) along it, where γ is the
    angle of that line. Hence K_xy = f'(ε)/c, K_yx = -f/(c ε), B_xx = 2 f/(ω c ε), B_yy = 12 π η (R/c)³/(1 - ε²)^(3/2),
    and all others are 0.

    Parameters
    ----------
    radius, clearance : radius R of the shaft and radial clearance c, m.
    eccentricity : relative eccentricity ε, 0 < ε < 1.
    speed : surface speed of the shaft, ω R, m/s, not 0.
    viscosity : viscosity, Pa s.

    Raises
    ------
    InputError
        If the eccentricity is out of range.

    Source: Sommerfeld 1904, Zeitschrift für Mathematik und Physik 50, 97-155, for the load; Pinkus and Sternlicht 1961,
    Theory of Hydrodynamic Lubrication, for the squeeze.
    """
    _check_eccentricity(eccentricity, above_zero=True)
    ratio, e = radius / clearance, eccentricity
    load = sommerfeld(radius=radius, clearance=clearance, eccentricity=e, speed=speed, viscosity=viscosity).load
    slope = load * (1 / e - 2 * e / (2 + e**2) + e / (1 - e**2))
    squeezed = 12 * math.pi * viscosity * ratio**3 / (1 - e**2) ** 1.5
    return JournalCoefficients(
        stiffness=np.array([[0.0, slope], [-load / e, 0.0]]) / clearance,
        damping=np.array([[2 * load / (speed / radius * clearance * e), 0.0], [0.0, squeezed]]),
    )


def ocvirk(*, clearance: float, eccentricity: float, width: float, speed: float, viscosity: float) -> JournalSolution:
    """The solution of an infinitely short journal bearing whose film fills the half that narrows.

    W = η u B³ ε √(π² (1 - ε²) + 16 ε²)/(4 c² (1 - ε²)²) at the attitude angle arctan(π √(1 - ε²)/(4 ε)), at any
    radius.

    Parameters
    ----------
    clearance : radial clearance c, m.
    eccentricity : relative eccentricity ε, 0 <= ε < 1.
    width : width B, m, small beside the radius.
    speed : surface speed of the shaft, m/s.
    viscosity : viscosity, Pa s.

    Returns
    -------
    The load, N, and the attitude angle, degrees. The side flow is u B c ε.

    Raises
    ------
    InputError
        If the eccentricity is out of range.

    Source: Ocvirk 1952, Short-bearing approximation for full journal bearings, NACA TN 2808.
    """
    _check_eccentricity(eccentricity)
    e = eccentricity
    root = math.sqrt(math.pi**2 * (1 - e**2) + 16 * e**2)
    load = viscosity * speed * width**3 / (4 * clearance**2) * e / (1 - e**2) ** 2 * root
    angle = math.degrees(math.atan2(math.pi * math.sqrt(1 - e**2), 4 * e))
    return JournalSolution(load=load, attitude_angle=angle)


def ocvirk_coefficients(
    *, radius: float, clearance: float, eccentricity: float, width: float, speed: float, viscosity: float
) -> JournalCoefficients:
    """The stiffness and damping of the infinitely short journal bearing of :func:`ocvirk`.

    With q = (π² (1 - ε²) + 16 ε²)^(-3/2) and s = √(1 - ε²), K c/W and B c ω/W are

        K_xx = 4 q (π² (1 + 2 ε²) + 32 ε² (1 + ε²)/(1 - ε²)),
        K_xy = π q (π² (1 - ε²) (1 + 2 ε²) + 32 ε² (1 + ε²))/(ε s),
        K_yx = -π q (π² (1 - ε²)² - 16 ε⁴)/(ε s),
        K_yy = 4 q (π² (2 - ε²) + 16 ε²),
        B_xx = 2 π q (π² (1 - ε²)² + 48 ε²)/(ε s),
        B_xy = B_yx = 8 q (π² (1 + 2 ε²) - 16 ε²),
        B_yy = 2 π q s (π² (1 + 2 ε²) - 16 ε²)/ε.

    Parameters
    ----------
    radius, clearance : radius of the shaft and radial clearance c, m.
    eccentricity : relative eccentricity ε, 0 < ε < 1.
    width : width B, m, small beside the radius.
    speed : surface speed of the shaft, ω R, m/s, not 0.
    viscosity : viscosity, Pa s.

    Raises
    ------
    InputError
        If the eccentricity is out of range.

    Source: Friswell, Penny, Garvey and Lees 2010, Dynamics of Rotating Machines, section 5.5.1; their axes are turned.
    """
    _check_eccentricity(eccentricity, above_zero=True)
    e, pi = eccentricity, math.pi
    load = ocvirk(clearance=clearance, eccentricity=e, width=width, speed=speed, viscosity=viscosity).load
    s, q = math.sqrt(1 - e**2), (pi**2 * (1 - e**2) + 16 * e**2) ** -1.5
    bracket = pi**2 * (1 + 2 * e**2) - 16 * e**2
    stiffness = [
        [
            4 * (pi**2 * (1 + 2 * e**2) + 32 * e**2 * (1 + e**2) / (1 - e**2)),
            pi * (pi**2 * (1 - e**2) * (1 + 2 * e**2) + 32 * e**2 * (1 + e**2)) / (e * s),
        ],
        [-pi * (pi**2 * (1 - e**2) ** 2 - 16 * e**4) / (e * s), 4 * (pi**2 * (2 - e**2) + 16 * e**2)],
    ]
    damping = [
        [2 * pi * (pi**2 * (1 - e**2) ** 2 + 48 * e**2) / (e * s), 8 * bracket],
        [8 * bracket, 2 * pi * s * bracket / e],
    ]
    return JournalCoefficients(
        stiffness=np.array(stiffness) * q * load / clearance,
        damping=np.array(damping) * q * load / (clearance * speed / radius),
    )


def short_journal_squeeze(
    *, radius: float, clearance: float, eccentricity: float, width: float, approach: float, viscosity: float
) -> float:
    """The load, N, of an infinitely short journal bearing whose shaft moves straight at the bore without rotation.

    The half of the film that narrows is full: W = η V R B³ J/c³ with
    J = ((1 + 2 ε²) (π/2 + arcsin ε) + 3 ε √(1 - ε²))/(1 - ε²)^(5/2), which is the integral of cos² ψ/(1 - ε cos ψ)³
    over -π/2 < ψ < π/2. A negative eccentricity is that of a shaft that comes from the far side.

    Parameters
    ----------
    radius, clearance : radius R of the shaft and radial clearance c, m.
    eccentricity : relative eccentricity ε, -1 < ε < 1.
    width : width B, m, small beside the radius.
    approach : velocity V of the shaft, c ε', m/s.
    viscosity : viscosity, Pa s.

    Raises
    ------
    InputError
        If the eccentricity is out of range.

    Source: Booth 1965, The journal orbit: analysis of short bearings, doi:10.1243/PIME_PROC_1965_180_117_02.
    """
    _check_eccentricity(abs(eccentricity))
    e = eccentricity
    s = math.sqrt(1 - e**2)
    integral = ((1 + 2 * e**2) * (math.pi / 2 + math.asin(e)) + 3 * e * s) / s**5
    return viscosity * approach * radius * width**3 / clearance**3 * integral


def short_journal_squeeze_time(
    *, radius: float, clearance: float, eccentricities: tuple[float, float], width: float, load: float, viscosity: float
) -> float:
    """The time, s, in which a load moves the shaft of :func:`short_journal_squeeze` between two eccentricities.

    t = η R B³ (G(ε₂) - G(ε₁))/(c² W), G = ε (π/2 + arcsin ε)/(1 - ε²)^(3/2) + 1/(1 - ε²), whose derivative is J.

    Parameters
    ----------
    radius, clearance : radius R of the shaft and radial clearance c, m.
    eccentricities : relative eccentricities ε₁ and ε₂ at the beginning and at the end, both between -1 and 1.
    width : width B, m, small beside the radius.
    load : constant load W, N.
    viscosity : viscosity, Pa s.

    Raises
    ------
    InputError
        If an eccentricity is out of range.

    Source: the integral of :func:`short_journal_squeeze`.
    """
    for eccentricity in eccentricities:
        _check_eccentricity(abs(eccentricity))
    first, last = (e * (math.pi / 2 + math.asin(e)) / math.sqrt(1 - e**2) ** 3 + 1 / (1 - e**2) for e in eccentricities)
    return viscosity * radius * width**3 / (clearance**2 * load) * (last - first)


def long_journal_squeeze(
    *, radius: float, clearance: float, eccentricity: float, approach: float, viscosity: float
) -> float:
    """The load, N/m, of an infinitely wide journal bearing whose shaft moves straight at the bore without rotation.

    W = 12 π η V (R/c)³/(1 - ε²)^(3/2). The film is full: with the ambient pressure at the widest place its pressure,
    6 η V R² ((1 - ε cos ψ)⁻² - (1 + ε)⁻²)/(ε c³) at the angle ψ from the narrowest place, is nowhere below it.

    Parameters
    ----------
    radius, clearance : radius R of the shaft and radial clearance c, m.
    eccentricity : relative eccentricity ε, 0 <= ε < 1.
    approach : velocity V of the shaft towards the narrowest place, c ε', m/s.
    viscosity : viscosity, Pa s.

    Raises
    ------
    InputError
        If the eccentricity is out of range.

    Source: Pinkus and Sternlicht 1961, Theory of Hydrodynamic Lubrication, chapter 7.
    """
    _check_eccentricity(eccentricity)
    return 12 * math.pi * viscosity * approach * (radius / clearance) ** 3 / math.sqrt(1 - eccentricity**2) ** 3


def long_journal_squeeze_time(
    *, radius: float, clearance: float, eccentricities: tuple[float, float], load: float, viscosity: float
) -> float:
    """The time, s, in which a load moves the shaft of :func:`long_journal_squeeze` between two eccentricities.

    t = 12 π η R³ (ε₂/√(1 - ε₂²) - ε₁/√(1 - ε₁²))/(c² W).

    Parameters
    ----------
    radius, clearance : radius R of the shaft and radial clearance c, m.
    eccentricities : relative eccentricities ε₁ and ε₂ at the beginning and at the end, both 0 or more and below 1.
    load : constant load W, N/m.
    viscosity : viscosity, Pa s.

    Raises
    ------
    InputError
        If an eccentricity is out of range.

    Source: the integral of :func:`long_journal_squeeze`.
    """
    for eccentricity in eccentricities:
        _check_eccentricity(eccentricity)
    first, last = (e / math.sqrt(1 - e**2) for e in eccentricities)
    return 12 * math.pi * viscosity * radius**3 / (clearance**2 * load) * (last - first)


def _check_eccentricity(eccentricity: float, *, above_zero: bool = False) -> None:
    """Raise InputError unless 0 <= ε < 1, or 0 < ε < 1."""
    if eccentricity < 0 or eccentricity >= 1 or (above_zero and eccentricity == 0):
        least = "above 0" if above_zero else "0 or more"
        raise InputError(f"eccentricity: got {eccentricity!r}; it must be {least} and below 1")
