"""The mesh of a gap follows an exact conformal map, keeps its walls and corners, and folds nowhere in silence."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.foamcases.conformal import harmonic, laplace
from roughfilm.foamcases.conformal.cells import centres, convex
from roughfilm.foamcases.conformal.orthogonal import between_ends, orthogonal
from roughfilm.foamcases.conformal.wall import wall_of
from roughfilm.rom.pocket.groove import channel, cylindrical, splined
from roughfilm.rom.thin_film.gap import Gap

FILM, LENGTH = 3e-5, 1e-3


def groove_in_film(*, width, depth, shift=None, position=0.0):
    """A groove by w+, d+ and xd+, cylindrical without a shift."""
    sizes = {"width": width * LENGTH, "depth": depth * FILM}
    shape = cylindrical(**sizes) if shift is None else splined(**sizes, shift=shift * width * LENGTH)
    return channel(length=LENGTH, film=FILM, grooves=[(position, shape)])


def straight(period, *points):
    """A gap with a film of 1 and straight lines between points (x, depth)."""
    x, depth = (np.array(column) for column in zip(*points, strict=True))

    def thickness(place):
        return 1 + np.interp(place - period * np.round(place / period), x, depth, period=period)

    return Gap(
        film=1.0, breaks=(-period / 2, *map(float, x), period / 2), corners=tuple(map(float, x)), thickness=thickness
    )


HARD = [
    groove_in_film(width=0.2, depth=2.0),
    groove_in_film(width=0.15, depth=1.25),
    groove_in_film(width=0.15, depth=1.25, shift=-0.3),
    groove_in_film(width=0.3, depth=2.0),
]
SLOT = straight(30.0, (-2, 0), (-1.98, 2), (1.98, 2), (2, 0))
STEEP = [
    SLOT,
    straight(30.0, (-2, 0), (-1.9, 6), (1.9, 6), (2, 0)),
    straight(30.0, (-1, 0), (0, 2), (1, 0)),
    straight(30.0, (-3, 0), (2.95, 3), (3, 0)),
    straight(30.0, (-12, 0), (-11.9, 1), (-8.1, 1), (-8, 0), (3, 0), (3.2, 4), (6, 0.2), (9, 3), (10, 0)),
    groove_in_film(width=0.15, depth=2.49),
    groove_in_film(width=0.1, depth=6.0, shift=-0.3),
    groove_in_film(width=0.9, depth=3.0, shift=0.4),
    channel(length=2 * FILM, film=FILM, grooves=[(0.0, splined(width=1.8 * FILM, depth=FILM, shift=0.5 * FILM))]),
]


class Mapped:
    """The gap onto which z = ζ + a sin k(ζ - iH) maps the rectangle 0 <= Im ζ <= H; its upper wall stays straight."""

    length, height, a = 4.0, 0.6, 0.12
    k = 2 * np.pi / length

    def z(self, zeta):
        return zeta + self.a * np.sin(self.k * (zeta - 1j * self.height))

    def zeta(self, z):
        found = z.copy()
        for _ in range(60):
            found -= (self.z(found) - z) / (1 + self.a * self.k * np.cos(self.k * (found - 1j * self.height)))
        return found

    def gap(self):
        along = np.linspace(-self.length, self.length, 40001) + 0j
        wall = self.z(along)
        film = self.height - wall.imag[20000]

        def thickness(x):
            inside = x * 1.0 - self.length * np.round(x / self.length)
            return self.height - np.interp(inside, wall.real, wall.imag)

        return Gap(film=film, breaks=(-self.length / 2, self.length / 2), corners=(), thickness=thickness)


def test_columns_and_layers_are_those_of_an_exact_conformal_map():
    exact = Mapped()
    gap = exact.gap()
    vertices = orthogonal(gap, 60, 12) * gap.film
    vertices[..., 1] += exact.height - gap.film
    zeta = exact.zeta(vertices[..., 0] + 1j * vertices[..., 1])
    assert zeta.imag == pytest.approx(np.broadcast_to(np.linspace(0, exact.height, 13), zeta.shape), abs=1e-4)
    assert np.ptp(zeta.real, axis=1).max() < 1e-3


def test_the_energy_is_the_height_of_the_rectangle_over_its_length_at_second_order():
    exact = Mapped()
    errors = []
    for columns in (20, 40):
        sides = np.linspace(0, exact.length, columns + 1), np.linspace(0, 1, columns // 2 + 1)
        xi, eta = np.meshgrid(*sides, indexing="ij")
        z = exact.z(xi + 1j * exact.height * eta**2)
        found = laplace.solve(np.stack([z.real, z.imag], axis=-1))
        errors.append(found.energy * exact.length / exact.height - 1)
        assert (found.lower[-1] - found.lower[0], found.upper[-1]) == pytest.approx((1, 1))
    assert errors[0] > 3 * errors[1] > 0


def test_a_harmonic_function_is_found_from_its_sides():
    height, wave = 0.3, 2 * np.pi * 3
    places = harmonic.samples(height, 20)
    xi, eta = np.sort(np.random.default_rng(1).uniform(0, 1, 50)), np.linspace(0, 1, 21)

    def exact(xi, eta):
        return np.cos(wave * xi) * np.exp(-wave * height * eta) + np.sin(wave * xi) * np.sinh(wave * height * eta) + eta

    found = harmonic.fill(exact(places, 0.0), exact(places, 1.0), height, xi, eta)
    expected = exact(xi[:, None], eta)
    assert np.abs(found - expected).max() < 1e-9 * np.abs(expected).max()


def test_a_flat_gap_gets_rectangles():
    gap = Gap(film=1.0, breaks=(-5.0, 5.0), corners=(), thickness=np.ones_like)
    vertices = orthogonal(gap, 50, 10)
    x, y = np.meshgrid(np.linspace(-5, 5, 51), np.linspace(0, 1, 11), indexing="ij")
    assert vertices == pytest.approx(np.stack([x, y], axis=-1), abs=1e-7)


@pytest.mark.parametrize("gap", [*HARD, *STEEP])
def test_cells_fill_the_gap_and_are_convex(gap):
    vertices = orthogonal(gap, 60, 12)
    assert convex(vertices).all()
    lower, upper = vertices[:, 0], vertices[:, -1]
    assert lower[:, 1] == pytest.approx(1 - gap.thickness(lower[:, 0] * gap.film) / gap.film, abs=1e-12)
    assert np.all(upper[:, 1] == 1)
    assert (upper[0, 0], upper[-1, 0]) == pytest.approx((gap.breaks[0] / gap.film, gap.breaks[-1] / gap.film))
    assert vertices[-1] - vertices[0] == pytest.approx(
        np.broadcast_to([gap.length / gap.film, 0], vertices[0].shape), abs=1e-12
    )
    for corner in gap.corners:
        assert np.abs(lower[:, 0] - corner / gap.film).min() < 1e-9
    assert abs(vertices.shape[0] - 1 - 60) <= 2 * (len(gap.corners) + 1)


def test_the_area_of_an_arc_is_exact_to_second_order():
    gap = groove_in_film(width=0.3, depth=0.75)
    radius = (5.0**2 + 0.75**2) / 1.5
    angle = np.arcsin(5.0 / radius)
    segment = radius**2 * (angle - np.sin(angle) * np.cos(angle))
    outline = orthogonal(gap, 240, 48)[:, 0]
    below = np.trapezoid(1 - outline[:, 1], outline[:, 0])
    assert below == pytest.approx(1000 / 30 + segment, rel=1e-4)


def largest_angle(vertices):
    """The largest angle, degrees, between a face and the normal to the line that joins the centres beside it."""
    middle, angles = centres(vertices), []
    for axis in (0, 1):
        face = np.diff(vertices, axis=1 - axis)
        face = face[1:-1] if axis == 0 else face[:, 1:-1]
        joined = np.diff(middle, axis=axis)
        sine = (face * joined).sum(axis=-1) / np.linalg.norm(face, axis=-1) / np.linalg.norm(joined, axis=-1)
        angles.append(np.degrees(np.arcsin(np.abs(sine))).max())
    return max(angles)


@pytest.mark.parametrize("gap", HARD)
def test_faces_are_near_normal_to_the_line_between_centres_where_vertical_columns_lean(gap):
    vertices = orthogonal(gap, 120, 24)
    vertical = vertices.copy()
    vertical[..., 0] = vertices[:, :1, 0]
    y = 1 - gap.thickness(vertical[:, 0, 0] * gap.film) / gap.film
    vertical[..., 1] = 1 - (1 - y)[:, None] * np.linspace(1, 0, 25)
    assert largest_angle(vertices) < 6
    assert largest_angle(vertical) > 25


@pytest.mark.parametrize("gap", [HARD[0], SLOT])
def test_a_symmetric_gap_gets_a_symmetric_mesh(gap):
    vertices = orthogonal(gap, 60, 12)
    assert vertices[..., 0] + vertices[::-1, :, 0] == pytest.approx(0, abs=1e-6)
    assert vertices[..., 1] - vertices[::-1, :, 1] == pytest.approx(0, abs=1e-6)


def test_the_place_of_the_period_does_not_change_the_shape_of_the_cells():
    """A slot across the end of the period, where the first column lies in it, gets the columns of one in the middle."""
    across = straight(30.0, (-13, 2), (-12.98, 0), (12.98, 0), (13, 2))
    vertices = orthogonal(across, 120, 24)
    assert convex(vertices).all()
    depth = 1 - vertices[:, 0, 1]
    assert depth[0] == pytest.approx(3, abs=1e-9)
    centred = orthogonal(straight(30.0, (-2, 0), (-1.98, 2), (1.98, 2), (2, 0)), 120, 24)
    assert np.diff(vertices[:, -1, 0]).min() == pytest.approx(np.diff(centred[:, -1, 0]).min(), rel=0.15)


@pytest.mark.parametrize(("length", "depth"), [(33.0, 2.99), (12.0, 3.0)])
def test_a_ridge_without_land_is_refused_in_one_line(length, depth):
    """Also of two half circles that fill the period."""
    ridge = channel(length=length, film=1.0, grooves=[(at, cylindrical(width=6.0, depth=depth)) for at in (-3.0, 3.0)])
    with pytest.raises(
        InputError, match=r"geometry: got a ridge so sharp at x = .* fold there; give the grooves more land"
    ):
        orthogonal(ridge, 60, 12)


def test_steep_walls_have_as_many_points_as_flat_ones():
    wall = wall_of(SLOT)
    assert np.diff(wall.arc).max() < 0.05
    assert wall.length == pytest.approx(30 - 4 + 3.96 + 2 * np.hypot(0.02, 2))
    turned = wall.points(np.array([1.0, 1.0 + wall.length]))
    assert turned[1] - turned[0] == pytest.approx([30, 0])


def linear_pad(length, rise, pocket=0.0):
    """A pad of film 1 from 0 to ``length`` that narrows by ``rise``, with a parabolic pocket in its middle."""

    def thickness(x):
        pocketed = np.maximum(0.0, 1 - ((x / length - 0.5) / 0.2) ** 2)
        return 1 + rise * (1 - x / length) + pocket * pocketed

    corners = (0.3 * length, 0.7 * length) if pocket else ()
    return Gap(film=1.0, breaks=(0.0, *corners, length), corners=corners, thickness=thickness)


@pytest.mark.parametrize("gap", [linear_pad(5.0, 1.0), linear_pad(30.0, 0.0, 2.0), linear_pad(3000.0, 1.0, 1.0)])
def test_a_gap_with_ends_begins_and_ends_with_vertical_columns(gap):
    vertices = between_ends(gap, 60, 12)
    assert convex(vertices).all()
    lower, upper = vertices[:, 0], vertices[:, -1]
    assert np.all(vertices[0, :, 0] == 0)
    assert np.all(vertices[-1, :, 0] == gap.length)
    assert lower[:, 1] == pytest.approx(1 - gap.thickness(lower[:, 0]), abs=1e-9)
    assert np.all(upper[:, 1] == 1)
    assert [np.abs(lower[:, 0] - corner).min() for corner in gap.corners] == pytest.approx([0.0] * len(gap.corners))
    assert abs(vertices.shape[0] - 1 - 60) <= 4


def test_columns_of_a_wedge_are_arcs_about_its_apex():
    """The conformal map of a wedge is the logarithm: columns are arcs, away from ends, which are vertical."""
    gap = linear_pad(12.0, 1.2)
    vertices = between_ends(gap, 60, 12)[25:35]
    radius = np.hypot(vertices[..., 0] - 22.0, vertices[..., 1] - 1.0)
    assert np.ptp(radius, axis=1).max() < 1e-3
