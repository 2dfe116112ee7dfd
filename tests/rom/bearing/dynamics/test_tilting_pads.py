"""Tilting pads against finite differences that share no code with the library."""

import math
from dataclasses import dataclass, field

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from roughfilm.rom.bearing.dynamics.sweep import dynamics
from roughfilm.rom.ladder.scene import read_scene

VISCOSITY, TURNING = 19.016e-3, 900 * math.pi / 30


@dataclass
class Pad:
    """A pad over its angle and half of its width, with p >= 0, and a balance of mass wherever p > 0.

    Its coordinates q are the place of the shaft and the tilt about the pivot; h = c (1 - m cos(θ - θ_k)) + q·n.
    """

    begin: float
    offset: float
    pivot: float
    arc: float
    preload: float
    cells: int
    radius: float = 0.2
    width: float = 0.263144
    clearance: float = 277.949e-6
    tilt: float = 0.0
    full: np.ndarray = field(init=False)

    def __post_init__(self):
        self.shape = self.cells - 1, self.cells // 2
        self.full = np.ones(math.prod(self.shape), bool)
        self.along, self.across = self.radius * self.arc / self.cells, self.width / self.cells
        within = self.arc * np.arange(self.cells + 1) / self.cells
        self.angle, about = self.begin + within, np.sin(within - self.pivot * self.arc)
        self.bore = self.clearance * (1 - self.preload * np.cos(within - self.offset * self.arc))
        self.normals = -np.array([np.cos(self.angle), np.sin(self.angle), self.radius * about])
        self.share = np.ones(self.shape[1])
        self.share[-1] = 0.5  # the last row of nodes lies on the line of symmetry
        self.weights = np.broadcast_to(2 * self.along * self.across * self.share, self.shape).ravel()

    def thickness(self, place):
        return self.bore + np.array([*place, self.tilt]) @ self.normals

    def conductances(self, faces, nodes):
        """The matrix of the net outflow by pressure, from h³ or its change at faces along and at nodes."""
        numbers = np.arange(math.prod(self.shape)).reshape(self.shape)
        east = faces[1:-1, None] * self.share * self.across / self.along
        north = np.broadcast_to(nodes[1:-1, None], (self.shape[0], self.shape[1] - 1)) * self.along / self.across
        diagonal = (faces[1:] + faces[:-1])[:, None] * self.share * self.across / self.along
        diagonal = diagonal + nodes[1:-1, None] * np.where(self.share < 1, 1, 2) * self.along / self.across
        pairs = [(numbers[:-1], numbers[1:], east), (numbers[:, :-1], numbers[:, 1:], north)]
        pairs += [(second, first, value) for first, second, value in pairs]
        pairs += [(numbers, numbers, -diagonal)]
        rows, columns, values = (np.concatenate([np.ravel(pair[part]) for pair in pairs]) for part in range(3))
        return -coo_matrix((values, (rows, columns))).tocsc() / (12 * VISCOSITY)

    def solve(self, place):
        """Forces on the coordinates, and their stiffness and damping matrices."""
        h = self.thickness(place)
        middle = (h[1:] + h[:-1]) / 2

        def entrained(at_faces):
            drawn = TURNING * self.radius / 2 * np.diff(at_faces)[:, None]
            return -(drawn * self.across * self.share).ravel()

        matrix, right = self.conductances(middle**3, h**3), entrained(middle)
        for _ in range(100):
            part = np.flatnonzero(self.full)
            pressure = np.zeros(len(right))
            factors = splu(matrix[part][:, part]) if len(part) else None
            if factors is not None:
                pressure[part] = factors.solve(right[part])
            full = np.where(self.full, pressure > 0, matrix @ pressure < right)
            if (full == self.full).all():
                break
            self.full = full
        else:
            raise AssertionError("the set of full nodes does not settle")
        on_nodes = np.repeat(self.normals[:, 1:-1], self.shape[1], axis=1)
        stiffness, damping = np.zeros((3, 3)), np.zeros((3, 3))
        for number, normal in enumerate(self.normals if factors is not None else ()):
            at_faces = (normal[1:] + normal[:-1]) / 2
            changed = self.conductances(3 * middle**2 * at_faces, 3 * h**2 * normal) @ pressure
            sources = entrained(at_faces) - changed, -on_nodes[number] * self.weights / 2
            for coefficients, source in zip((stiffness, damping), sources, strict=True):
                change = np.zeros(len(right))
                change[part] = factors.solve(source[part])
                coefficients[:, number] = -on_nodes @ (self.weights * change)
        return on_nodes @ (self.weights * pressure), stiffness, damping

    def settle(self, place):
        """Tilt the pad until its moment is zero; a pad without pressure stays where it is."""
        for _ in range(50):
            forces, stiffness, damping = self.solve(place)
            if abs(forces[2]) <= 1e-10 * self.radius * np.hypot(*forces[:2]):
                return forces, stiffness, damping
            most = 0.3 * self.thickness(place).min() / self.radius
            self.tilt += float(np.clip(forces[2] / stiffness[2, 2], -most, most))
        raise AssertionError("the pad does not settle")

    def search(self, place):
        """The tilt of a film with pressure and without moment, which a tilt further closes with a restoring one."""
        self.tilt = 0.0
        largest = 0.97 * self.thickness(place).min() / np.abs(self.normals[2]).max()

        def moment(tilt):
            self.tilt = float(tilt)
            return self.solve(place)[0][2]

        tilts = np.linspace(-largest, largest, 25)
        moments = [moment(tilt) for tilt in tilts]
        crossings = [k for k in range(24) if moments[k] > 0 > moments[k + 1]]
        self.tilt = float(brentq(moment, *tilts[crossings[-1] :][:2])) if crossings else 0.0
        self.solve(place)


def reduced(parts, frequency):
    """K + iωB of the shaft while the pads, without inertia, follow."""
    total = np.zeros((2, 2), complex)
    for _, stiffness, damping in parts:
        z = stiffness + 1j * frequency * damping
        total += z[:2, :2] - (np.outer(z[:2, 2], z[2, :2]) / z[2, 2] if z[2, 2] else 0)
    return total


def equilibrium(pads, load, place):
    """The place of the shaft under a load, and the parts of each pad there."""
    for _ in range(50):
        parts = [pad.settle(place) for pad in pads]
        net = sum(part[0][:2] for part in parts) + load
        if np.hypot(*net) <= 1e-9 * np.hypot(*load):
            return place, parts
        place = place + np.clip(np.linalg.solve(reduced(parts, 0.0).real, net), -1e-5, 1e-5)
    raise AssertionError("the shaft does not settle")


def independent(pads, load, frequency, cells=(24, 48)):
    """The place of the shaft and K + iωB, extrapolated from two grids with the second order."""
    place, tilts, found = np.array([0.0, -60e-6]), None, []
    for count in cells:
        ours = [Pad(cells=count, **pad) for pad in pads]
        for number, pad in enumerate(ours):
            if tilts is None:
                pad.search(place)
            else:
                pad.tilt = tilts[number]
        place, parts = equilibrium(ours, np.array([0.0, -load]), place)
        tilts = [pad.tilt for pad in ours]
        found.append((place, reduced(parts, frequency)))
    return [fine + (fine - coarse) / 3 for coarse, fine in zip(*found, strict=True)]


@dataclass(frozen=True)
class Bearing:
    """Equal pads, the first of them with its middle at an angle, degrees, under a load, N."""

    pads: int
    arc: float
    first: float
    preload: float
    load: float
    offset: float = 0.5
    pivot: float = 0.5
    ratio: float = 1.0

    @property
    def each(self):
        begins = np.radians(self.first - self.arc / 2 + 360 / self.pads * np.arange(self.pads))
        shared = {"arc": math.radians(self.arc), "preload": self.preload, "offset": self.offset, "pivot": self.pivot}
        return [{"begin": begin, **shared} for begin in begins]

    @property
    def point(self):
        scene = read_scene(
            {
                "name": "tilting pads",
                "kind": "bearing",
                "geometry": {
                    "shape": "lobes",
                    "lobes": self.pads,
                    "arc": f"{self.arc} deg",
                    "first": f"{self.first} deg",
                    "preload": self.preload,
                    "offset": self.offset,
                    "pivot": self.pivot,
                    "radius": "200 mm",
                    "width": "263.144 mm",
                    "clearance": "277.949 um",
                },
                "lubricant": {"viscosity": "19.016 mPa*s"},
                "motion": {"speed": "900 rpm"},
                "load": {"force": f"{self.load} N"},
            }
        )
        nominal = self.load / (2 * 0.2 * 0.263144)
        (curve,) = dynamics(scene, [abs(scene.motion.speed)], [nominal], frequency_ratio=self.ratio)
        return curve.points[0]


ON_A_PAD = Bearing(pads=5, arc=60, first=-90, preload=0.3, load=112815)
BETWEEN_PADS = Bearing(pads=4, arc=72, first=-135, preload=0.2, load=80e3, offset=0.6, pivot=0.6, ratio=0.5)


@pytest.mark.parametrize("bearing", [ON_A_PAD, BETWEEN_PADS], ids=["load on a pad", "load between pads"])
def test_tilting_pads_have_the_stiffness_and_damping_of_independent_finite_differences(bearing):
    frequency = bearing.ratio * TURNING
    place, impedance = independent(bearing.each, bearing.load, frequency)
    truth = {"eccentricity": np.hypot(*place) / 277.949e-6}
    for name, matrix in (("stiffness", impedance.real), ("damping", impedance.imag / frequency)):
        truth |= {f"{name}_{axis}": matrix[k, k] for k, axis in enumerate(("xx", "yy"))}
    point = bearing.point
    errors = {name: abs(point.numbers[name] / value - 1) for name, value in truth.items()}
    stated = {name: point.uncertainty[name] / abs(value) for name, value in truth.items()}
    assert all(error < 0.005 for error in errors.values()), errors
    assert all(errors[name] < stated[name] + 5e-4 for name in truth), (errors, stated)  # theirs are good to 5e-4


def test_the_stiffness_of_slow_motions_is_that_of_equilibria_whose_loads_differ():
    pads = [Pad(cells=16, **pad) for pad in ON_A_PAD.each]
    place = np.array([0.0, -0.43 * 277.949e-6])
    for pad in pads:
        pad.search(place)
    load, more = np.array([0.0, -ON_A_PAD.load]), np.array([0.0, -30.0])
    low, _ = equilibrium(pads, load - more, place)
    high, _ = equilibrium(pads, load + more, place)
    _, parts = equilibrium(pads, load, place)
    assert reduced(parts, 0.0).real @ (high - low) == pytest.approx(2 * more, rel=1e-4, abs=1e-2)
