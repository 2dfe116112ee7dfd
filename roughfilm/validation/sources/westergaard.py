"""Westergaard's sinusoidal ridges under load."""

from dataclasses import replace

import numpy as np

from roughfilm.contact.mechanics.discretisation import uncertainties
from roughfilm.contact.mechanics.exact.westergaard import Westergaard
from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.ladder.model import Progress
from roughfilm.validation.published import Answer, Row, Source, against_closed_form

BAR = 0.01
"""Relative accuracy that is asked of the solver."""

LOADS = (0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95)
"""Loads over that of full contact."""

POINTS, MORE_POINTS = 1024, 4096

AMPLITUDE, WAVELENGTH, MODULUS = 1e-6, 1e-3, 1e11
"""Amplitude and wavelength, m, and composite modulus, Pa."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """The contact width, the largest pressure and the mean gap at each load."""
    points = MORE_POINTS if thorough else POINTS
    x = (np.arange(points) + 0.5) * WAVELENGTH / points - WAVELENGTH / 2
    heights = AMPLITUDE * np.cos(2 * np.pi * x / WAVELENGTH)
    press = Press(np.repeat(heights[:, None], 2, axis=1), (WAVELENGTH / points, WAVELENGTH / points), MODULUS)
    unloaded = Westergaard(amplitude=AMPLITUDE, wavelength=WAVELENGTH, composite_modulus=MODULUS, load=0.0)
    rows: list[Row] = []
    for number, share in enumerate(LOADS):
        progress(number / len(LOADS), f"sinusoidal ridges, {share:g} of the load of full contact")
        exact = replace(unloaded, load=share * unloaded.full_contact_load)
        contact = press.at(exact.load)
        bars = uncertainties(contact)
        compared = (
            ("contact area fraction", "1", exact.area_fraction, contact.area_fraction, bars["area_fraction"]),
            (
                "largest pressure",
                "MPa",
                float(exact.pressure(0.0)) / 1e6,
                float(contact.pressure.max()) / 1e6,
                bars["pressure_max"] / 1e6,
            ),
            ("mean gap", "nm", exact.mean_gap * 1e9, contact.mean_gap * 1e9, bars["mean_gap"] * 1e9),
        )
        rows += against_closed_form(f"P/p* = {share:g}", share, compared, BAR)
    return Answer(rows=tuple(rows))


def _method(points: int) -> str:
    return f"the solver of the model elastic, on {points} points a wave"


SOURCE = Source(
    name="westergaard",
    title="Westergaard 1939: sinusoidal ridges",
    citation="H. M. Westergaard, J. Appl. Mech. 6 (1939) A49; K. L. Johnson, Contact Mechanics (1985), 13.2",
    obtained="The closed form, evaluated by the project's own function, which its tests hold to the literature.",
    methods=(_method(POINTS), _method(MORE_POINTS)),
    bar="1 %, asked of the solver; the closed form is exact",
    abscissa="load over that of full contact, P/p*",
    cost=(1.0, 4.0),
    answer=answer,
)
