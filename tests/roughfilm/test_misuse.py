"""What is no scene, no path, no number and no array is said in one line, whatever it is."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from places import SCENES

import roughfilm as rf
from roughfilm.contact.surfaces.profile import Profile

CYCLE: dict[str, Any] = {"name": "c", "kind": "pocket"}
CYCLE["geometry"] = CYCLE
LOOP: list[Any] = []
LOOP.append(LOOP)
DEEP: dict[str, Any] = {}
_inner = DEEP
for _ in range(3000):
    _inner["a"] = _inner = {}

NO_PATHS: list[Any] = [
    None,
    True,
    0,
    1.5,
    1j,
    b"bytes",
    bytearray(b"x"),
    [1],
    (16,),
    {},
    set(),
    object(),
    int,
    np.zeros(2),
]
NO_PATHS += [iter([1]), range(3), np.float32(2), ..., slice(1), "a" * 5000, "zero\0byte", Path("a/" + "b" * 300)]
PATHS = (rf.load_scene, rf.load_study, rf.load_result, rf.read_table, rf.collect_study, rf.run_study, rf.write_study)
CONTAINERS: list[Any] = [
    CYCLE,
    {"name": "x", "kind": "pocket", "geometry": LOOP},
    {"name": "x", "kind": "pocket", "a": DEEP},
]
NO_HEIGHTS: list[Any] = [None, 1j, b"x", "x", np.zeros((4, 4), complex), np.zeros((4, 4), "M8[s]"), np.array([["a"]])]
NO_HEIGHTS += [
    [[1.0, 2.0], [3.0]],
    np.zeros((4, 4), object),
    np.full((4, 4), np.nan),
    np.zeros(4),
    np.zeros((0, 0)),
    DEEP,
]
NO_SPACINGS: list[Any] = [
    1e-6,
    None,
    "a",
    (1e-6,),
    (1j, 1),
    ("a", "b"),
    (np.nan, 1),
    (0, 1),
    (1, 2, 3),
    b"ab",
    {},
    object(),
]
NO_CELLS: list[Any] = [
    (16,),
    16,
    (16, 16, 16),
    None,
    "16",
    b"ab",
    (16.5, 16),
    (0, 16),
    (True, 16),
    {16, 17},
    np.zeros(2),
]


def line(error: pytest.ExceptionInfo[rf.InputError]) -> str:
    """The message, which is one line that can be read."""
    message = str(error.value)
    assert "\n" not in message
    assert len(message) < 400
    return message


@pytest.mark.parametrize("call", PATHS, ids=lambda call: call.__name__)
def test_what_is_no_path(call: Any) -> None:
    for value in NO_PATHS:
        arguments = (value, "out") if call in (rf.run_study, rf.write_study) else (value,)
        with pytest.raises(rf.InputError) as error:
            call(*arguments)
        line(error)


def test_entries_that_hold_themselves() -> None:
    for entries in CONTAINERS:
        with pytest.raises(rf.InputError) as error:
            rf.read_scene(entries)
        assert "nested too deeply or hold themselves" in line(error)


def test_what_is_no_kind() -> None:
    for value in (1, b"pocket", np.array(["pocket", "seal"]), ["pocket"], LOOP, CYCLE, object()):
        with pytest.raises(rf.InputError, match=r"^kind: got ") as error:
            rf.models(value)  # type: ignore[arg-type]
        line(error)


def test_what_are_no_heights() -> None:
    for heights in NO_HEIGHTS:
        with pytest.raises(rf.InputError) as error:
            rf.Surface(heights=heights, spacing=(1e-6, 1e-6))
        line(error)
    for spacing in NO_SPACINGS:
        with pytest.raises(rf.InputError) as error:
            rf.Surface(heights=np.zeros((4, 4)), spacing=spacing)
        line(error)


NO_LENGTHS: list[Any] = ["1um", *NO_SPACINGS[2:], 1j, np.nan, 0, -1e-6, 10**400]
NO_LINES: list[Any] = [
    *(heights for heights in NO_HEIGHTS if np.shape(heights if isinstance(heights, np.ndarray) else ()) != (4,)),
    ["a", "b"],
    np.zeros(4, complex),
    np.zeros((4, 4)),
    [np.inf, 0.0, 1.0],
    [1e-40, 0.0],
    [1e-6],
]


def test_what_is_no_profile() -> None:
    for heights in NO_LINES:
        with pytest.raises(rf.InputError, match=r"^profile: ") as error:
            Profile(heights=heights, spacing=1e-6)
        line(error)
    for spacing in [*NO_LENGTHS, None]:
        with pytest.raises(rf.InputError, match=r"^profile: ") as error:
            Profile(heights=np.zeros(4), spacing=spacing)
        line(error)


def test_masked_points_of_a_profile_are_not_measured() -> None:
    """A number under a mask means nothing; the height is interpolated between the neighbours."""
    profile = Profile(heights=np.ma.masked_array([1e-6, 9.0, 3e-6], [False, True, False]), spacing=1e-6)
    assert profile.heights.tolist() == pytest.approx([1e-6, 2e-6, 3e-6], rel=1e-12)
    assert profile.source["filled"] == 1


def test_what_read_profile_does_not_take(tmp_path: Path) -> None:
    file = tmp_path / "line.npy"
    np.save(file, 1e-6 * np.sin(np.arange(500) / 10))
    for path in NO_PATHS:
        with pytest.raises(rf.InputError) as error:
            rf.read_profile(path, spacing=1e-6)
        line(error)
    for spacing in NO_LENGTHS:
        with pytest.raises(rf.InputError, match=r"spacing") as error:
            rf.read_profile(file, spacing=spacing)
        line(error)
    for invalid in ("none", 1j, b"x", [[1.0, 2.0], [3.0]], 10**400, {}, object(), ["a"]):
        with pytest.raises(rf.InputError, match=r"^invalid: got ") as error:
            rf.read_profile(file, spacing=1e-6, invalid=invalid)  # type: ignore[arg-type]
        line(error)


def test_read_profile_takes_one_code_or_a_list(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "line.csv", [1.0, -9999.0, 3.0, 4.0], header="spacing: 1 um, 1 um; heights: um")
    for invalid in (-9999, [-9999, 7], np.array([-9999])):
        profile = rf.read_profile(tmp_path / "line.csv", invalid=invalid)
        assert (1e6 * profile.heights).tolist() == pytest.approx([1, 2, 3, 4], rel=1e-12)


def test_what_fit_profile_does_not_take() -> None:
    wave = Profile(heights=1e-6 * np.sin(np.arange(500) / 10), spacing=1e-6)
    for profile in (*NO_PATHS, [1e-6] * 500):
        with pytest.raises(rf.InputError, match=r"^profile: got ") as error:
            rf.fit_profile(profile)  # type: ignore[arg-type]
        line(error)
    for anisotropy in (0, -1, "a", 1j, None, np.nan, np.inf, True, [1.0], object()):
        with pytest.raises(rf.InputError, match=r"^anisotropy: got ") as error:
            rf.fit_profile(wave, anisotropy=anisotropy)  # type: ignore[arg-type]
        line(error)
    for seed in (-1, "a", 1.5, None, True, 10**30, [1], object()):
        with pytest.raises(rf.InputError, match=r"seed: got ") as error:
            rf.fit_profile(wave, seed=seed)  # type: ignore[arg-type]
        line(error)


@pytest.mark.parametrize("height", [0.0, 1e-7, -0.1])
def test_a_constant_profile_has_no_spectrum(height: float) -> None:
    with pytest.raises(rf.InputError, match=r"^profile: all heights are the same") as error:
        rf.fit_profile(Profile(heights=np.full(500, height), spacing=1e-6))
    line(error)


def test_what_are_no_cells() -> None:
    scene = rf.load_scene(SCENES / "unbalanced_rotor.toml")
    for cells in NO_CELLS:
        with pytest.raises(rf.InputError, match=r"^cells") as error:
            rf.march(scene, 1e-4, steps=1, cells=cells)
        line(error)


NO_WORDS: list[Any] = [1, 1j, b"x", [1], np.zeros(2), np.array(["a", "b"]), {}, {"a"}, object(), LOOP]


def test_what_are_no_words() -> None:
    scene = rf.load_scene(SCENES / "pocket.toml")
    surface = rf.Surface(heights=np.zeros((4, 4)), spacing=(1e-6, 1e-6))
    calls = {
        "model": lambda word: rf.solve(scene, model=word),
        "quantity": lambda word: rf.advise(scene, quantity=word),
        "models": lambda word: rf.compare(scene, models=word),
        "operation": lambda word: rf.combine(surface, surface, operation=word),
        "level": lambda word: rf.combine(surface, surface, level=word),
        "mirror": lambda word: rf.combine(surface, surface, mirror=word),
        "uncertainty": lambda word: rf.march(rf.load_scene(SCENES / "unbalanced_rotor.toml"), uncertainty=word),
    }
    for name, call in calls.items():
        for word in NO_WORDS:
            with pytest.raises(rf.InputError, match=rf"^{name.removesuffix('s')}") as error:
                call(word)
            line(error)
    for word in (NO_WORDS[0], b"x", np.zeros(2), 1j, object()):
        with pytest.raises(rf.InputError, match=r"^key: got ") as error:
            rf.replace(scene, word, "8 um")  # type: ignore[arg-type]
        line(error)
