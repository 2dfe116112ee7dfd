"""The stability of rigid rotors against the eigenvalues of their motion."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roughfilm.rom.bearing.dynamics.whirl import RATIOS_OF_MEMORY, Whirl, condensed, grows, rigid_whirl, whirl_of

K = np.array([[1.5, 7.3], [-2.2, 1.5]])
B = np.array([[14.7, 1.6], [1.6, 4.5]])
entries = st.floats(-3, 3, allow_subnormal=False)


def growth(mass: float, stiffness: np.ndarray, damping: np.ndarray) -> float:
    """The largest real part of the eigenvalues of M z'' + B z' + K z = 0."""
    zero, one = np.zeros((2, 2)), np.eye(2)
    matrix = np.block([[zero, one], [-stiffness / mass, -damping / mass]])
    return float(np.linalg.eigvals(matrix).real.max())


@settings(max_examples=60, deadline=None)
@given(st.tuples(*[entries] * 4), st.tuples(*[st.floats(0.2, 3)] * 2), st.floats(-0.4, 0.4))
def test_a_rotor_is_stable_exactly_below_the_critical_mass(k, diagonal, cross):
    stiffness = np.array(k).reshape(2, 2)
    damping = np.array([[diagonal[0], cross], [cross, diagonal[1]]])
    inverse = rigid_whirl(stiffness, damping).inverse_mass
    if abs(np.linalg.det(stiffness)) < 0.05 or (math.isfinite(inverse) and abs(inverse) < 0.05):
        return  # too near to a limit for eigenvalues to decide
    if math.isinf(inverse):
        masses = {0.02: 1.0, 1.0: 1.0, 50.0: 1.0} if np.linalg.det(stiffness) < 0 else {}
    elif inverse < 0:
        masses = {0.02: -1.0, 1.0: -1.0, 50.0: -1.0}
    else:
        masses = {0.9 / inverse: -1.0, 1.1 / inverse: 1.0}
    for mass, sign in masses.items():
        assert sign * growth(mass, stiffness, damping) > 0


def test_at_the_critical_mass_the_rotor_whirls_without_growth_or_decay():
    whirl = rigid_whirl(K, B)
    mass, frequency = 1 / whirl.inverse_mass, math.sqrt(whirl.frequency_squared)
    assert growth(mass, K, B) == pytest.approx(0, abs=1e-9)
    assert abs(np.linalg.det(K - mass * frequency**2 * np.eye(2) + 1j * frequency * B)) < 1e-9


def test_a_symmetric_stiffness_carries_any_mass_and_a_negative_one_none():
    assert rigid_whirl((K + K.T) / 2 + 4 * np.eye(2), B).inverse_mass <= 0
    assert rigid_whirl(np.diag([1.0, -1.0]), B).inverse_mass == math.inf


def pads() -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and damping of a shaft and two pads."""
    between = np.array([[0.5, -0.3], [0.2, 0.6]])
    stiffness = np.block([[K, between], [between.T, np.diag([2.0, 3.0])]])
    return stiffness, np.block([[B, 0.5 * between], [0.5 * between.T, np.diag([1.0, 1.5])]])


def whirl_on_pads(stiffness: np.ndarray, damping: np.ndarray) -> Whirl:
    """The whirl of a shaft, the first two coordinates, on pads that follow it, at the speed 1."""
    kept = np.arange(len(stiffness)) < 2
    if grows(stiffness[2:, 2:], damping[2:, 2:], 1.0):
        return Whirl(inverse_mass=math.inf, frequency_squared=math.nan)
    return whirl_of(lambda frequency: condensed(stiffness, damping, kept, frequency), 1.0)


def test_condensed_pads_follow_without_force():
    k, b = pads()
    kept = np.array([True, True, False, False])
    for frequency in (0.3, 2.0):
        stiffness, damping = condensed(k, b, kept, frequency)
        z = k + 1j * frequency * b
        pads_follow = -np.linalg.solve(z[2:, 2:], z[2:, :2])
        force = z @ np.vstack([np.eye(2), pads_follow])
        assert force[2:] == pytest.approx(np.zeros((2, 2)), abs=1e-12)
        assert force[:2] == pytest.approx(stiffness + 1j * frequency * damping, rel=1e-12)
    slow, limit = condensed(k, b, kept, 1e-6), condensed(k, b, kept, 0.0)
    for one, other in zip(slow, limit, strict=True):
        assert one == pytest.approx(other, rel=1e-6)


def test_the_whirl_of_a_shaft_on_pads_is_where_its_eigenvalues_cross():
    k, b = pads()
    whirl = whirl_on_pads(k, b)
    assert whirl.inverse_mass > 0
    frequency = math.sqrt(whirl.frequency_squared)
    inertia = np.diag([1.0, 1.0, 0, 0]) * frequency**2 / whirl.inverse_mass
    singular = np.linalg.svd(k - inertia + 1j * frequency * b, compute_uv=False)
    assert singular[-1] < 1e-8 * singular[0]


def motion(mass: float, stiffness: np.ndarray, damping: np.ndarray) -> float:
    """The largest real part of the roots of M z'' + B z' + K z = 0 with a mass on two coordinates only."""
    count = len(stiffness)
    inverse = np.linalg.inv(damping[2:, 2:])
    along, pads_of = damping[:2, :2] - damping[:2, 2:] @ inverse @ damping[2:, :2], inverse @ damping[2:, :2]
    matrix = np.zeros((count + 2, count + 2))  # velocities of the shaft, then all coordinates
    pulled = stiffness[:2] - damping[:2, 2:] @ inverse @ stiffness[2:]
    matrix[:2, :2], matrix[:2, 2:] = -along / mass, -pulled / mass
    matrix[2:4, :2] = np.eye(2)
    matrix[4:, :2], matrix[4:, 2:] = -pads_of, -inverse @ stiffness[2:]
    return float(np.linalg.eigvals(matrix).real.max())


@pytest.mark.parametrize("seed", range(24))
def test_a_rotor_on_pads_is_stable_exactly_below_the_critical_mass(seed):
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(4, 4))
    b = root @ root.T + 0.1 * np.eye(4)
    k = np.diag(rng.uniform(1, 4, 4)) + rng.uniform(0.2, 1.2) * rng.normal(size=(4, 4))
    whirl = whirl_on_pads(k, b)
    if math.isinf(whirl.inverse_mass):
        assert motion(1e-3, k, b) > 0
    elif whirl.inverse_mass > 0:
        assert motion(0.95 / whirl.inverse_mass, k, b) < 0 < motion(1.05 / whirl.inverse_mass, k, b)
    else:
        assert max(motion(mass, k, b) for mass in (1e-2, 1.0, 1e2)) < 0


def test_negative_damping_of_slow_motions_alone_leaves_a_light_rotor_stable():
    """A soft pad that opposes its shaft takes energy out of the motion again where it cannot follow."""
    k = np.array([[2.0, 0.0, 0.3], [0.0, 2.0, 0.0], [-0.3, 0.0, 0.05]])
    b = np.diag([0.5, 0.5, 0.4])
    slow = condensed(k, b, np.array([True, True, False]), 1e-3)[1]
    assert slow[0, 0] < 0
    assert math.isfinite(whirl_on_pads(k, b).inverse_mass)
    assert motion(1e-3, k, b) < 0


def test_pads_that_do_not_move_leave_the_whirl_of_the_shaft():
    for turned in (K, (K + K.T) / 2 + 4 * np.eye(2)):
        k, b = np.eye(3), np.eye(3)
        k[:2, :2], b[:2, :2] = turned, B
        whirl, rigid = whirl_on_pads(k, b), rigid_whirl(turned, B)
        if rigid.inverse_mass > 0:
            assert whirl.inverse_mass == pytest.approx(rigid.inverse_mass, rel=1e-7)
            assert whirl.frequency_squared == pytest.approx(rigid.frequency_squared, rel=1e-7)
        else:
            assert whirl.inverse_mass <= 0


def delayed(seed):
    """Stiffness and damping at a frequency of a film, a part of whose force follows within a turn, at the speed 1."""
    rng = np.random.default_rng(seed)
    stiffness, damping = np.array([[2.6, 2.3], [-9.2, 25.8]]), np.array([[1.8, -3.5], [-3.5, 29.0]])
    lag, late = rng.uniform(2, 8), rng.normal(size=(2, 2)) * [[2.0, 4.0], [20.0, 40.0]]

    def impedance(frequency):
        follows = np.exp(-1j * lag * frequency) / (1 + 2j * frequency) ** 3
        return stiffness + 1j * frequency * damping + late * follows

    return impedance, lambda frequency: (impedance(frequency).real, impedance(frequency).imag / frequency)


def growing(impedance, mass):
    """The number of growing motions of a mass, by the turns of det(Z - M ν²) from slow to fast motions."""
    frequencies = np.concatenate([np.linspace(1e-4, 20, 40001), np.geomspace(20, 1e5, 4001)[1:]])
    each = frequencies[:, None, None]
    turned = np.unwrap(np.angle(np.linalg.det(impedance(each) - mass * each**2 * np.eye(2))))
    return round((2 * math.pi - float(turned[-1] - turned[0])) / math.pi)


CLOSE = (19, 78, 195, 267, 407, 440, 466, 504, 592)
"""Seeds with two limits of stability between neighbouring ratios."""


@pytest.mark.parametrize("seed", [*range(12), *CLOSE])
def test_a_rotor_on_a_film_with_memory_is_stable_exactly_below_the_critical_mass(seed):
    impedance, at = delayed(seed)
    whirl = whirl_of(at, 1.0, RATIOS_OF_MEMORY)
    if math.isinf(whirl.inverse_mass):
        assert growing(impedance, 1e-3) > 0
    elif whirl.inverse_mass > 0:
        mass = 1 / whirl.inverse_mass
        assert [growing(impedance, part * mass) > 0 for part in (0.3, 0.6, 0.97, 1.03)] == [False, False, False, True]
    else:
        assert not any(growing(impedance, mass) for mass in (1e-2, 1.0, 1e2))
