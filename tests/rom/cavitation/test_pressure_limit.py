"""Films whose viscosity grows with pressure, near and beyond the pressure above which no steady film exists."""

import math
from dataclasses import replace

import pytest
from scipy.special import gamma, gammaincc

from roughfilm.contact.foundation.errors import ConvergenceError
from roughfilm.ladder import find
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.cavitation.pressure_limit import pressure_limit, reduced_pressure
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene

VISCOSITY, SPEED, LENGTH, FILM = 0.1, 20.0, 0.05, 10e-6

ISOVISCOUS_PRESSURE = 6 * VISCOSITY * SPEED * LENGTH / FILM**2 / 24
"""Peak of the infinitely wide wedge with h(0)/h(L) = k = 2 at constant viscosity: 6ηuL/h² (k - 1)/(4k(k + 1)), Pa."""


def wedge(piezoviscosity: dict[str, object], law: str = "incompressible") -> Bearing:
    entries = {
        "name": "wedge",
        "kind": "bearing",
        "geometry": {"shape": "linear", "length": "50 mm", "width": "50 mm", "film": "10 um", "rise": "10 um"},
        "lubricant": {"viscosity": "0.1 Pa*s", "compressibility": {"law": law}, "piezoviscosity": piezoviscosity},
        "motion": {"speed": "20 m/s"},
    }
    scene = read_scene(entries)
    assert isinstance(scene, Bearing)
    return scene


def barus(share: float, law: str = "incompressible") -> Bearing:
    """The wedge whose peak at constant viscosity, infinitely wide, is a share of 1/α."""
    return wedge({"law": "barus", "pressure_coefficient": f"{share / ISOVISCOUS_PRESSURE!r} Pa^-1"}, law)


@pytest.mark.parametrize("share", [0.5, 0.9, 0.999])
def test_the_peak_by_the_law_of_barus_is_that_of_the_transformed_film(share: float) -> None:
    """p = -ln(1 - α q)/α, with q of constant viscosity."""
    found = find("bearing", "infinitely_wide").solve(barus(share), Request(resolution=1024))
    exact = -math.log1p(-share) * ISOVISCOUS_PRESSURE / share
    assert found["pressure_max"].value == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize(
    ("model", "share", "law"),
    [
        ("infinitely_wide", 1.001, "incompressible"),
        ("infinitely_wide", 2.0, "incompressible"),
        ("infinitely_wide", 2.0, "dowson_higginson"),
        ("reynolds_cavitating", 1.8, "incompressible"),
        ("reynolds_cavitating", 3.0, "dowson_higginson"),
    ],
)
def test_a_film_without_a_solution_is_refused_with_its_pressure_and_the_limit(
    model: str, share: float, law: str
) -> None:
    with pytest.raises(
        ConvergenceError, match=r"^lubricant.piezoviscosity: .* by the law barus .* lower the viscosity"
    ):
        find("bearing", model).solve(barus(share, law), Request(resolution=64))


def test_a_compressible_film_may_exist_beyond_the_limit_of_an_incompressible_one() -> None:
    found = find("bearing", "infinitely_wide").solve(barus(1.03, "dowson_higginson"), Request(resolution=256))
    assert found["pressure_max"].value > 0.5e9


def test_the_reduced_pressure_of_laws() -> None:
    problem = barus(0.5).problem()
    alpha = 0.5 / ISOVISCOUS_PRESSURE
    assert pressure_limit(problem) == pytest.approx(1 / alpha, rel=1e-9)
    assert reduced_pressure(problem, 1e8) == pytest.approx(-math.expm1(-alpha * 1e8) / alpha, rel=1e-9)
    assert reduced_pressure(problem, 0.0) == 0
    assert pressure_limit(wedge({"law": "constant"}).problem()) == math.inf
    index, depth, scale = 0.6, math.log(VISCOSITY) + 9.67, 1 / 5.1e-9
    integral = math.exp(depth) * depth ** (-1 / index) * gammaincc(1 / index, depth) * gamma(1 / index) / index
    assert pressure_limit(wedge({"law": "roelands", "index": index}).problem()) == pytest.approx(
        scale * integral, rel=1e-6
    )
    thin = replace(wedge({"law": "roelands", "index": index}).problem(), viscosity=5e-5)
    assert pressure_limit(thin) == math.inf, "this viscosity falls with pressure"
