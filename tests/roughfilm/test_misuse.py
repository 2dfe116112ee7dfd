"""What is no scene, no path, no number and no array is said in one line, whatever it is."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from places import SCENES

import roughfilm as rf

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
