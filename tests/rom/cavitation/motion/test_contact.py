"""Films between walls that touch: the liquid between flattened asperities has the volume of their mean gap."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from moving_films import CLEARANCE, SPEED, course, damping_of_slow_motions, journal, plates, steady

from roughfilm.rom.cavitation.balance import CAVITY
from roughfilm.rom.cavitation.motion.coefficients import coefficients
from roughfilm.rom.cavitation.motion.march import begun, march
from roughfilm.rom.cavitation.motion.past import held

AMBIENT = 1e4


@dataclass(frozen=True)
class Flattened:
    """Asperities on plates of unit size, which keep a part of their approach as plastic displacement."""

    kept: float = 0.4
    touching: float = 2.0
    closest: float = 0.2

    def contact_pressure(self, separation):
        return np.clip(self.touching - separation, 0.0, None) ** 1.5

    def mean_gap(self, separation):
        return separation + self.kept * np.clip(self.touching - separation, 0.0, None)


def pressed(place=1.0):
    """Plates in contact, and their film at rest."""
    film = replace(plates(64, ambient=AMBIENT), contact=Flattened())
    return film, steady(film, [place], tolerance=1e-12)


def test_the_damping_is_that_of_the_mean_gap():
    """B = η L³/h³ of parallel plates, times the 0.6 of a change of the separation that displaces liquid."""
    film, at = pressed()
    found = coefficients(film, at, speed=0.0)
    assert found.damping[0, 0] == pytest.approx(0.6 * (1 - 1 / 64**2), rel=1e-7)  # a sum over the nodes
    assert found.stiffness[0, 0] == pytest.approx(1.5, rel=1e-4)


def test_what_flattened_walls_displace_leaves_between_them():
    film, at = pressed()
    moved = course(film, place=lambda time: np.array([1 - 0.1 * time]))
    volumes, times = [], []
    for moving in march(film, moved, begun(film, at), 1.0, largest_step=0.1, error=None):
        instant = moving.instant
        volumes.append(float((film.grid.areas * held(film, instant)).sum()))
        times.append(moving.now.time)
        leaving = -float(instant.balance[[0, -1]].sum())
        assert leaving == pytest.approx(0.6 * 0.1, rel=1e-9)
    assert np.array(volumes) == pytest.approx(1.4 - 0.06 * np.array(times), rel=1e-9)


def test_the_damping_of_a_cavitated_journal_in_contact_is_the_difference_of_slow_motions():
    law = Flattened(touching=0.4 * CLEARANCE, closest=0.02 * CLEARANCE)
    film, place = replace(journal((32, 6), halved=True), contact=law), np.array([0.5, -0.6]) * CLEARANCE
    at = steady(film, place, tolerance=1e-12)
    found = coefficients(film, at, speed=SPEED).damping
    assert (at.kind == CAVITY).any()
    assert (at.faces.thickness < law.touching).any()
    np.testing.assert_allclose(found, damping_of_slow_motions(film, place), rtol=1e-4, atol=1e-5 * found.max())
