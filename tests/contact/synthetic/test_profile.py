"""Ground profiles have the height parameters of the table and a self-affine spectrum, by the seed."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.parameters.roughness_parameters import profile_parameters
from roughfilm.contact.synthetic.profile import STEEL_PROFILES, ground_profile

GIVEN = {"length": 0.42e-3, "points": 512, "roll_off": 60e-6}


@pytest.mark.parametrize(
    ("name", "average", "rms", "skewness", "kurtosis"),
    [
        ("A", 0.93e-6, 1.2e-6, -1.0, 4.4),
        ("B", 0.3e-6, 0.38e-6, -0.25, 3.2),
        ("C", 0.14e-6, 0.18e-6, -0.022, 3.5),
        ("D", 0.35e-6, 0.45e-6, -0.069, 3.1),
    ],
)
@pytest.mark.parametrize("seed", [2007, 574])
def test_steel_profiles_have_the_parameters_of_the_table(name, average, rms, skewness, kurtosis, seed):
    profile = ground_profile(STEEL_PROFILES[name], seed=seed, **GIVEN)
    assert profile.shape == (512,)
    found = {key: quantity.value for key, quantity in profile_parameters(profile, 0.42e-3 / 512).items()}
    assert found["Ra"] == pytest.approx(average, rel=1e-6)
    assert found["Rq"] == pytest.approx(rms, rel=1e-6)
    assert found["Rsk"] == pytest.approx(skewness, abs=1e-6)
    assert found["Rku"] == pytest.approx(kurtosis, rel=1e-6)


@pytest.mark.parametrize("points", [512, 513])
@pytest.mark.parametrize(
    ("hurst", "roll_off", "cut_off"), [(0.8, 60e-6, None), (0.5, 100e-6, 8e-6), (1.0, 42e-6, 5e-6)]
)
def test_the_spectrum_is_flat_then_falls_as_asked(points, hurst, roll_off, cut_off):
    """By the mean over 20 seeds: level below the roll-off, slope −1 − 2H above, and next to nothing beyond."""
    power = np.mean(
        [
            np.abs(
                np.fft.rfft(
                    ground_profile(
                        STEEL_PROFILES["D"],
                        length=0.42e-3,
                        points=points,
                        seed=seed,
                        roll_off=roll_off,
                        hurst=hurst,
                        cut_off=cut_off,
                    )
                )
            )
            ** 2
            for seed in range(811, 831)
        ],
        axis=0,
    )
    wave = np.arange(power.size)
    first, last = 0.42e-3 / roll_off, 0.42e-3 / (cut_off or 4 * 0.42e-3 / points)
    level = power[1 : int(first) + 1]
    assert level.std() < 0.2 * level.mean()
    falls = (wave > first) & (wave < last)
    slope, _ = np.polyfit(np.log(wave[falls]), np.log(power[falls]), 1)
    assert slope == pytest.approx(-1 - 2 * hurst, abs=0.15)
    if cut_off:
        assert power[wave > last].sum() < 2e-3 * power.sum()


def test_the_seed_decides_and_the_ends_meet():
    one, same, other = (ground_profile(STEEL_PROFILES["B"], seed=seed, **GIVEN) for seed in (601, 601, 607))
    assert (one == same).all()
    assert (one != other).mean() > 0.9
    assert abs(one[0] - one[-1]) <= np.abs(np.diff(one)).max()
    assert np.corrcoef(one, other)[0, 1] < 0.6


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"length": 0.0}, "length"),
        ({"points": 10}, "points"),
        ({"seed": -1}, "seed"),
        ({"hurst": 1.2}, "hurst"),
        ({"roll_off": 1e-3}, "roll_off"),
        ({"roll_off": 1e-6}, "roll_off"),
        ({"cut_off": 1e-6}, "cut_off"),
        ({"cut_off": 70e-6}, "roll_off"),
    ],
)
def test_what_makes_no_sense_is_refused(changes, words):
    with pytest.raises(InputError, match=words) as caught:
        ground_profile(STEEL_PROFILES["C"], **(GIVEN | {"seed": 613} | changes))
    assert "\n" not in str(caught.value)
