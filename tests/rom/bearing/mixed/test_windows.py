"""Several windows on one wall of a bearing."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.rom.bearing.mixed.stribeck import LiftOff, StribeckCurve, StribeckPoint
from roughfilm.rom.bearing.mixed.windows import BearingWindow, CommonPlane, curves_of_windows


class Springs:
    """Asperities of a linear contact pressure below first contact, with a film that is as smooth as if there were none.

    ``height`` is the separation of first contact, m, and ``stiffness`` the slope of the contact pressure, Pa/m.
    """

    closest = 1e-6

    def __init__(self, height, stiffness):
        self.touching, self.stiffness = height, stiffness

    def contact_pressure(self, separation):
        return self.stiffness * np.maximum(self.touching - separation, 0.0)

    def area_fraction(self, separation):
        return 1e-9 * self.contact_pressure(separation)

    def mean_gap(self, separation):
        return np.asarray(separation, dtype=float)

    def pressure_uncertainty(self, separation):
        return np.full(np.shape(separation), 0.1 if self.stiffness > 2e12 else 0.3)


def test_windows_on_one_wall_share_the_load_at_one_separation():
    wall = CommonPlane(walls=(Springs(4e-6, 1e12), Springs(5e-6, 3e12)))
    assert (wall.touching, wall.closest) == (5e-6, 1e-6)
    alpha = np.array([1.5e-6, 4.5e-6, 6e-6])
    assert wall.contact_pressure(alpha) == pytest.approx([(2.5e6 + 10.5e6) / 2, 0.75e6, 0.0])
    assert wall.largest_pressure == pytest.approx((3e6 + 12e6) / 2)
    for pressure in (1e3, 0.75e6, 3e6):
        assert wall.contact_pressure(np.array(wall.separation_at(pressure))) == pytest.approx(pressure, rel=1e-6)
    with pytest.raises(InputError, match="at the end of the table of one of the windows"):
        wall.separation_at(8e6)


def test_the_uncertainty_of_the_pressure_is_that_of_the_windows_that_carry_it():
    wall = CommonPlane(walls=(Springs(4e-6, 1e12), Springs(5e-6, 3e12)))
    carried = wall.pressure_uncertainty(np.array([4.5e-6, 1.5e-6, 6e-6]))
    assert carried == pytest.approx([0.1, (0.3 * 2.5 + 0.1 * 10.5) / 13, 0.0])


def curve(friction, lift_off, speeds=(0.1, 1.0)):
    points = tuple(
        StribeckPoint(
            pressure=1e6,
            speed=speed,
            separation=1e-6,
            least_gap=1e-6,
            load=1.0,
            film_load=1.0,
            contact_load=0.0,
            contact_share=0.0,
            friction=friction,
            friction_coefficient=friction,
            pressure_max=2e6,
            contact_pressure_max=0.0,
            contact_area=0.0,
            cavitated_fraction=0.0,
            balance=0.0,
            residual=0.0,
            cpu_s=0.0,
            uncertainty={"friction_coefficient": 0.001},
        )
        for speed in speeds
    )
    return StribeckCurve(pressure=1e6, points=points, lift_off=LiftOff(speed=lift_off, uncertainty=0.01))


def window(*arguments, **options):
    return BearingWindow(wall=None, curves=(curve(*arguments, **options),), known=0)


def test_values_are_those_of_the_whole_wall_and_the_scatter_reaches_to_the_mean_of_the_windows():
    windows = [window(friction, 0.5 + friction) for friction in (0.02, 0.03, 0.025, 0.024)]
    (plain,) = curves_of_windows(None, windows, 4.0)
    (found,) = curves_of_windows([curve(0.03, 0.9)], windows, 4.0)
    assert plain.points[0].friction_coefficient == pytest.approx(0.02475)
    assert plain.points[0].uncertainty["friction_coefficient"] == pytest.approx(0.001)
    assert found.points[0].friction_coefficient == 0.03
    assert found.points[0].uncertainty == {"friction_coefficient": 0.001}
    scatter = plain.points[0].scatter["friction_coefficient"]
    assert 0.005 < scatter < 0.01
    assert found.points[0].scatter["friction_coefficient"] == pytest.approx(scatter + 0.03 - 0.02475)
    assert found.points[0].window_interval["friction_coefficient"][1] > 0.03
    assert found.points[0].scatter["pressure_max"] == 0.0
    assert "contact_load" not in found.points[0].scatter
    assert found.lift_off.speed == pytest.approx(0.52475)
    assert found.lift_off.scatter > 0


def test_speeds_that_a_window_leaves_out_and_walls_that_never_part():
    windows = [window(0.02, 0.5), window(0.03, np.nan, speeds=(1.0,)), window(0.025, 0.5)]
    (found,) = curves_of_windows(None, windows, 3.0)
    assert [point.speed for point in found.points] == [1.0]
    assert np.isnan(found.lift_off.speed)
    assert found.lift_off.scatter is None
