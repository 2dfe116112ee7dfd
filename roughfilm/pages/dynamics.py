"""The page of stiffness, damping and stability over speed."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from roughfilm.figures.base import svg
from roughfilm.figures.motion import dynamics as figures
from roughfilm.pages.render import render
from roughfilm.rom.bearing.dynamics.point import DynamicPoint
from roughfilm.rom.bearing.dynamics.store import dimensionless_of
from roughfilm.rom.bearing.dynamics.sweep import DynamicCurve
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.words.dynamics import answer_of, critical_mass, number_of, own_point, whirl_ratio
from roughfilm.words.numbers import digits
from roughfilm.words.stribeck import speed_scale

COLUMNS = (
    ("eccentricity", "", "eccentricity", 1.0),
    ("attitude", "°", "attitude_angle", 1.0),
    ("least film", "µm", "film_min", 1e6),
    ("peak pressure", "MPa", "pressure_max", 1e-6),
    ("carried by contact", "%", "contact_share", 100.0),
    ("contact pressure", "MPa", "contact_pressure_max", 1e-6),
    ("power", "kW", "power_loss", 1e-3),
    ("side leakage", "ml/s", "side_leakage", 1e6),
    ("Sommerfeld number", "", "sommerfeld_number", 1.0),
    ("temperature, film", "°C", "temperature", 1.0),
    ("temperature, outlet", "°C", "outlet_temperature", 1.0),
)
"""Title, unit, name and factor of each column of the table of the equilibrium."""


def write_page(scene: Bearing, entries: Mapping[str, Any], curves: Sequence[DynamicCurve], path: Path) -> None:
    """Write the page of curves and of the object of ``--json``; InputError if the file cannot be written."""
    scale, first = speed_scale(scene), curves[0].points[0]
    shaft = "whirl_ratio" in first.numbers
    columns = [column for column in COLUMNS if column[2] in first.numbers]
    render(
        "dynamics.html.j2",
        path,
        name=scene.name or "bearing",
        entries=entries,
        unit=scale.unit,
        shaft=shaft,
        answers=[answer_of(scene, curve) for curve in curves],
        cards=[_card(scene, curve) for curve in curves],
        columns=columns,
        rows={
            f"{curve.pressure / 1e6:.4g} MPa": [
                (
                    point is own_point(scene, curve),
                    [
                        digits(scale.factor * point.speed),
                        *(number_of(point, name, factor) for _, _, name, factor in columns),
                        *([whirl_ratio(point), critical_mass(point)] if shaft else []),
                    ],
                )
                for point in curve.points
            ]
            for curve in curves
        },
        coefficients=svg(figures.coefficients(scene, curves, dimensionless=False)),
        dimensionless=svg(figures.coefficients(scene, curves, dimensionless=True)) if shaft else None,
        over_frequency=svg(figures.over_frequency(scene, curves)) if shaft else None,
        places=svg(figures.places(scene, curves)) if shaft else None,
        stability=svg(figures.stability(scene, curves)) if shaft else None,
        heated="temperature" in first.numbers,
        temperatures=svg(figures.temperatures(scene, curves)) if "temperature" in first.numbers else None,
        rough=scene.roughness is not None,
        contact=scene.asperities is not None,
        pads=getattr(scene.geometry, "pivot", None) is not None,
    )


def _card(scene: Bearing, curve: DynamicCurve) -> dict[str, Any]:
    """The matrices of a load at the speed nearest to that of the scene."""
    point, scale = own_point(scene, curve), speed_scale(scene)
    return {
        "load": f"{curve.pressure / 1e6:.4g} MPa",
        "at": f"{digits(scale.factor * point.speed)} {scale.unit}",
        "stiffness": _matrix(scene, point, "stiffness", 1e-6),
        "damping": _matrix(scene, point, "damping", 1e-3),
    }


def _matrix(scene: Bearing, point: DynamicPoint, matrix: str, factor: float) -> list[tuple[str, str, str]]:
    """Name, number and dimensionless number of each entry of a matrix."""
    ratios = dimensionless_of(scene, point)
    return [
        (
            name.partition("_")[2],
            number_of(point, name, factor),
            f"{ratios[f'dimensionless_{name}']:.4g}".replace("-", "−") if ratios else "",
        )
        for name in point.numbers
        if name.partition("_")[0] == matrix
    ]
