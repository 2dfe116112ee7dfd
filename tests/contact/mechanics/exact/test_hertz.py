"""A sphere and a cylinder: pressures that bear the force and deform the solid to the stated gap, by quadrature."""

import dataclasses

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipkm1

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.mechanics.exact.hertz import HertzCylinder, HertzSphere

SPHERE = HertzSphere(radius=7e-3, composite_modulus=1.15e11, force=3.2)
CYLINDER = HertzCylinder(radius=7e-3, composite_modulus=1.15e11, force_per_length=2e4)


def integral(function, start, end, points=None):
    return quad(function, start, end, points=points, epsabs=0, epsrel=1e-10, limit=400)[0]


def displaced_by_rings(r):
    """Boussinesq: a ring of radius s under pressure p lowers radius r by 4 p s K(m)/(πE*(r + s)), m = 4rs/(r + s)²."""

    def ring(s):
        return SPHERE.pressure(s) * s / (r + s) * ellipkm1(((r - s) / (r + s)) ** 2)

    inside = [r] if 0 < r < SPHERE.contact_radius else None
    return 4 / (np.pi * SPHERE.composite_modulus) * integral(ring, 0, SPHERE.contact_radius, inside)


def displaced_by_lines(x):
    """Flamant: −2/(πE*) ∫ p(s) ln|x − s| ds, less that of the middle."""

    def lowered(to):
        inside = [to] if abs(to) < CYLINDER.half_width else None
        a = CYLINDER.half_width
        return integral(lambda s: CYLINDER.pressure(s) * np.log(abs(to - s) / a), -a, a, inside)

    return -2 / (np.pi * CYLINDER.composite_modulus) * (lowered(x) - lowered(0.0))


def test_the_pressure_of_a_sphere_bears_its_force():
    a = SPHERE.contact_radius
    assert integral(lambda r: 2 * np.pi * r * SPHERE.pressure(r), 0, a) == pytest.approx(SPHERE.force, rel=1e-9)
    assert SPHERE.pressure(0.0) == pytest.approx(SPHERE.largest_pressure)
    assert (SPHERE.pressure([a, 1.5 * a, -2 * a]) == 0).all()


@pytest.mark.parametrize("part", [0.01, 0.4, 0.95, 1.0, 1.05, 2.0, 30.0])
def test_a_sphere_displaces_as_its_pressure_does(part):
    r = part * SPHERE.contact_radius
    assert SPHERE.displacement(r) == pytest.approx(displaced_by_rings(r), rel=1e-7)
    gap = r**2 / (2 * SPHERE.radius) + displaced_by_rings(r) - SPHERE.approach
    assert SPHERE.gap(r) == pytest.approx(gap, abs=1e-7 * max(SPHERE.approach, gap))


def test_far_from_a_sphere_only_its_force_counts():
    r = 1000 * SPHERE.contact_radius
    point = SPHERE.force / (np.pi * SPHERE.composite_modulus * r)
    assert SPHERE.displacement(r) == pytest.approx(point, rel=1e-5)


def test_work_of_a_sphere_is_its_energy():
    """dF/dδ = 2E*a, and F grows as δ^(3/2)."""
    step = 1e-6
    more = dataclasses.replace(SPHERE, force=SPHERE.force * (1 + step))
    less = dataclasses.replace(SPHERE, force=SPHERE.force * (1 - step))
    stiffness = 2 * step * SPHERE.force / (more.approach - less.approach)
    assert stiffness == pytest.approx(2 * SPHERE.composite_modulus * SPHERE.contact_radius, rel=1e-6)


def test_the_pressure_of_a_cylinder_bears_its_force():
    a = CYLINDER.half_width
    assert integral(CYLINDER.pressure, -a, a) == pytest.approx(CYLINDER.force_per_length, rel=1e-9)
    assert CYLINDER.pressure(0.0) == pytest.approx(CYLINDER.largest_pressure)
    assert (CYLINDER.pressure([a, 1.5 * a, -2 * a]) == 0).all()


@pytest.mark.parametrize("part", [-0.3, 0.95, 1.0, 1.1, 4.0, 40.0])
def test_a_cylinder_displaces_as_its_pressure_does(part):
    x = part * CYLINDER.half_width
    down = displaced_by_lines(x)
    assert CYLINDER.displacement(x) == pytest.approx(down, rel=1e-7)
    gap = x**2 / (2 * CYLINDER.radius) + down
    assert CYLINDER.gap(x) == pytest.approx(gap, abs=1e-7 * max(CYLINDER.half_width**2 / CYLINDER.radius, gap))


@pytest.mark.parametrize("contact", [SPHERE, CYLINDER])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf"), True])
def test_what_makes_no_sense_is_refused(contact, value):
    for field in dataclasses.fields(contact):
        with pytest.raises(InputError, match=field.name):
            dataclasses.replace(contact, **{field.name: value})
