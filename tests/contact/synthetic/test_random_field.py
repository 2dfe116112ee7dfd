"""A random field is deterministic, has the powers and heights of its tables, and is refused in one line."""

import numpy as np
import pytest

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.synthetic.description import description_entries, make, read_description, read_entries
from roughfilm.contact.synthetic.random_field import at_scores, octave_of

SIZE = 8e-5
ENTRIES = {
    "kind": "random_field",
    "size": ["80 um", "80 um"],
    "points": [40, 40],
    "seed": 3,
    "spectrum": {
        "period": ["80 um", "80 um"],
        "waves_x": [0, 1, 4, 8],
        "waves_y": [0, 1, 4, 8],
        "decibels": [
            [-20, -10, 0, 0, 0, -10, -20],
            [-20, -10, 0, 0, 0, -10, -20],
            [-22, -14, -10, -10, -10, -14, -22],
            [-26, -22, -20, -20, -20, -22, -26],
        ],
    },
    "population": {
        "windows": 20,
        "rms_height": "1 um",
        "octaves": [0, -6, -12],
        "scores": [-3, -1, 0, 1, 3],
        "heights": [-3, -1, 0, 1, 3],
    },
}
MODE = {"octaves": [2.0, 2.0, 2.0], "steps": [0.0, 0.0, 0.0, 0.0]}


def changed(table: str = "", **entries):
    whole = {**ENTRIES, "spectrum": dict(ENTRIES["spectrum"]), "population": dict(ENTRIES["population"])}
    (whole[table] if table else whole).update(entries)
    return whole


def octaves(surface):
    waves = np.abs(np.fft.fft2(surface.heights, norm="forward")) ** 2
    waves[0, 0] = 0.0
    q = [2 * np.pi * np.fft.fftfreq(n, d) for n, d in zip(surface.shape, surface.spacing, strict=True)]
    return np.bincount(octave_of(q[0][:, None], q[1][None, :], (SIZE, SIZE), 3).ravel(), waves.ravel())


def test_every_seed_without_modes_has_the_powers_of_the_octaves_and_normal_heights():
    wanted = 10 ** (np.array([0.0, -0.6, -1.2]))
    wanted *= 1e-12 / wanted.sum()
    for seed in range(3):
        surface = make(read_entries(changed(seed=seed)))
        assert octaves(surface) == pytest.approx(wanted, rel=0.02)
        assert surface.heights.mean() == pytest.approx(0.0, abs=1e-18)
        assert surface.source["distribution"]["skewness"] == pytest.approx(0.0, abs=1e-6)
        assert surface.source["distribution"]["kurtosis"] == pytest.approx(3.0, abs=0.02)


def test_a_mode_that_lifts_all_octaves_makes_the_rms_height_lognormal_of_student():
    described = read_entries(changed("population", modes=[MODE]))
    logarithms = np.log([make(described.model_copy(update={"seed": seed})).heights.std() / 1e-6 for seed in range(150)])
    # 2 decibels of power are 0.2303 in the logarithm of the rms height; sqrt(1 + 1/20) and Student's t of 19 degrees
    # of freedom widen it by sqrt(19/17). The variance of 150 values is within 40 % with a probability of 99.9 %.
    expected = (0.1 * np.log(10)) ** 2 * (1 + 1 / 20) * 19 / 17
    assert logarithms.var() == pytest.approx(expected, rel=0.4)
    assert logarithms.mean() == pytest.approx(0.0, abs=3.3 * np.sqrt(expected / 150))


def test_equal_seeds_give_equal_bytes_and_others_do_not():
    one, again = (make(read_entries(ENTRIES)) for _ in range(2))
    assert one.heights.tobytes() == again.heights.tobytes()
    assert not np.allclose(make(read_entries(changed(seed=4))).heights, one.heights)


def test_a_finer_grid_has_the_same_waves():
    coarse, fine = make(read_entries(ENTRIES)), make(read_entries(changed(points=[80, 80])))
    difference = fine.heights[::2, ::2] - coarse.heights
    assert difference.std() < 0.05 * coarse.heights.std()


def test_the_source_of_a_surface_is_its_description():
    described = read_entries(changed("population", modes=[MODE]))
    assert read_entries(make(described).source["synthetic"]) == described
    assert read_entries(description_entries(described)) == described


def test_heights_between_and_beyond_scores_grow():
    x = np.linspace(-6, 6, 400)
    z = at_scores(np.array([-2.0, -1.0, 0.5, 2.0]), np.array([-5.0, -1.0, 0.0, 0.1]), x)
    assert (np.diff(z) > 0).all()
    assert np.interp([-2.0, -1.0, 0.5, 2.0], x, z) == pytest.approx([-5.0, -1.0, 0.0, 0.1], abs=0.02)
    assert np.diff(z)[0] / np.diff(x)[0] == pytest.approx(4.0)


@pytest.mark.parametrize(
    ("table", "entries", "words"),
    [
        ("spectrum", {"waves_x": [1, 2, 4, 8]}, "increase from 0"),
        ("spectrum", {"decibels": [[0.0] * 7] * 3}, "4 rows of 7 numbers"),
        ("spectrum", {"waves": [0]}, "did you mean 'waves_"),
        ("population", {"windows": 2}, "from 4 windows"),
        ("population", {"heights": [-3, -1, -2, 1, 3]}, "heights: must increase"),
        ("population", {"heights": [-3, 3, 4]}, "got 3 for 5 scores"),
        ("population", {"modes": [{**MODE, "steps": [0.0]}]}, "3 octaves and 4 steps"),
        ("population", {"modes": [{**MODE, "step": [0.0]}]}, "did you mean 'steps'"),
        ("population", {"rms_height": "-1 um"}, "above zero"),
        ("population", {"octaves": [float("nan")] * 3}, r"octaves\.0: got nan; a dimensionless number must be"),
        ("population", {"octaves": []}, "write 1 entry or more"),
        ("", {"points": [12, 12]}, "below two pixels"),
        ("", {"seed": -1}, "write a whole number from 0"),
    ],
)
def test_wrong_entries_are_refused_in_one_line(table, entries, words):
    with pytest.raises(InputError, match=words) as refused:
        make(read_entries(changed(table, **entries)))
    assert "\n" not in str(refused.value)


def test_the_example_is_read(tmp_path):
    path = tmp_path / "field.toml"
    path.write_text('kind = "random_field"\nsize = ["1 um", "1 um"]\npoints = [8, 8]\nseed = 1\n', encoding="utf-8")
    with pytest.raises(InputError, match="spectrum"):
        read_description(path)
