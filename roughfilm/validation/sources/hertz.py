"""Hertz's contact of a sphere with a half-space."""

import math

import numpy as np

from roughfilm.contact.mechanics.discretisation import uncertainties
from roughfilm.contact.mechanics.exact.hertz import HertzSphere
from roughfilm.contact.mechanics.press import Press
from roughfilm.rom.ladder.model import Progress
from roughfilm.validation.published import Answer, Row, Source, against_closed_form

BAR = 0.01
"""Relative accuracy that is asked of the solver."""

FORCES = (1.0, 2.0, 5.0, 10.0)
"""Forces, N."""

POINTS, MORE_POINTS = 256, 512

SIDE, RADIUS, MODULUS = 400e-6, 1e-2, 1e11
"""Side of the square that is solved and radius of the sphere, m, and composite modulus, Pa."""


def answer(thorough: bool, progress: Progress) -> Answer:
    """The contact radius, the largest pressure and the approach at each force."""
    points = MORE_POINTS if thorough else POINTS
    spacing = SIDE / points
    x = (np.arange(points) - points // 2) * spacing
    square = (x**2)[:, None] + x**2
    press = Press(-square / (2 * RADIUS), (spacing, spacing), MODULUS, boundary="free")
    rows: list[Row] = []
    for number, force in enumerate(FORCES):
        progress(number / len(FORCES), f"sphere on a plane, {force:g} N")
        exact = HertzSphere(radius=RADIUS, composite_modulus=MODULUS, force=force)
        contact = press.at(force / SIDE**2)
        bars = uncertainties(contact)
        radius = math.sqrt(contact.area_fraction * SIDE**2 / math.pi)
        compared = (
            (
                "contact radius",
                "µm",
                exact.contact_radius * 1e6,
                radius * 1e6,
                radius * 1e6 * bars["area_fraction"] / contact.area_fraction / 2,
            ),
            (
                "largest pressure",
                "MPa",
                exact.largest_pressure / 1e6,
                float(contact.pressure.max()) / 1e6,
                bars["pressure_max"] / 1e6,
            ),
            ("approach", "nm", exact.approach * 1e9, contact.approach * 1e9, bars["approach"] * 1e9),
        )
        rows += against_closed_form(f"{force:g} N", force, compared, BAR)
    return Answer(rows=tuple(rows))


def _method(points: int) -> str:
    return f"the solver of the model elastic with free surroundings, on {points} × {points} points"


SOURCE = Source(
    name="hertz",
    title="Hertz 1882: sphere on a half-space",
    citation="H. Hertz, J. reine angew. Math. 92 (1882) 156-171; K. L. Johnson, Contact Mechanics (1985), 4.2",
    obtained="The closed form, evaluated by the project's own function, which its tests hold to the literature.",
    methods=(_method(POINTS), _method(MORE_POINTS)),
    bar="1 %, asked of the solver; the closed form is exact",
    abscissa="force, N",
    cost=(1.0, 2.0),
    answer=answer,
)
