"""Mutated scenes, what the commands answer to each, and whether the answer is sound.

An answer is sound if it is a finite number, or an error of one line for each fault: no traceback, no warning of NumPy,
no number that is not finite, and no more CPU time than ``LIMIT_S``.
"""

import contextlib
import json
import re
import signal
import traceback
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from attack.mutations import mutated
from typer.testing import CliRunner

from roughfilm import rom
from roughfilm.cli.main import app
from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.rom.ladder.model import ladder
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene, read_scene, scene_entries
from roughfilm.rom.ladder.store import as_bytes, as_entries

LIMIT_S = 60.0
"""CPU time of reading a scene, of one solution or of one command, s, beyond which it counts as endless."""

MAX_LINE = 400
"""Largest length of a line of an error."""

MODELS_TRIED = 3
"""Number of models that solve a scene, the cheapest first."""

NODES = 16
"""Resolution, where a model allows it."""

ADVISED_EACH = 25
"""Every scene of so many is given to ``advise`` too, which takes longer than all else."""

CONTROLS = re.compile("[\x00-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
"""Characters that change a terminal or the direction of a text."""

ERRORS = InputError, ConvergenceError, UnavailableError


class Endless(BaseException):
    """A step took more CPU time than ``LIMIT_S``."""


@dataclass(frozen=True)
class Answer:
    """What happened to one scene: ``answered``, ``refused``, ``not solved`` or ``fault``, and the words on it."""

    seed: int
    scene: str
    mutations: tuple[str, ...]
    outcome: str
    words: str = ""


def answered(seed: int, folder: Path) -> Answer:
    """Write the scene of a seed into a folder, give it to the commands and judge their answers."""
    name, mutations, data = mutated(seed)
    path = folder / "scene.toml"
    path.write_bytes(data)
    with _limited():
        try:
            _allow_time()
            outcome, words = _judged(path, advised=seed % ADVISED_EACH == 0)
        except Endless:
            outcome, words = "fault", f"endless: {''.join(traceback.format_exc().splitlines(keepends=True)[-8:])}"
        except BaseException:
            outcome, words = "fault", traceback.format_exc()
    return Answer(seed=seed, scene=name, mutations=mutations, outcome=outcome, words=words)


@contextlib.contextmanager
def _limited() -> Iterator[None]:
    """Interrupt what takes more CPU time than ``LIMIT_S``, and turn warnings into errors."""

    def stop(_number: int, _frame: object) -> None:
        raise Endless

    before = signal.signal(signal.SIGPROF, stop)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def _allow_time() -> None:
    """Let the next step take up to ``LIMIT_S``."""
    signal.setitimer(signal.ITIMER_PROF, LIMIT_S)


def _judged(path: Path, *, advised: bool) -> tuple[str, str]:
    """The outcome of a scene file and the words on it; any other error than those of the project is raised."""
    try:
        scene = load_scene(path)
    except InputError as error:
        words = str(error)
        assert words.strip(), "no message"
        _run_command("solve", path)
        return "refused", words
    assert read_scene(scene_entries(scene)) == scene, "the complete entries give another scene"
    solved, words = 0, []
    models = []
    for model in ladder(rom, kind=scene.kind):
        try:
            if model.applies(scene).applies:
                offered = model.offered(scene)
                resolution = max(offered.least, min(NODES, offered.most))
                models.append((model.cost(scene, resolution), model.name, resolution, model))
        except ERRORS as error:
            words.append(f"{model.name}: {_in_lines(str(error))}")
    for _, _, resolution, model in sorted(models, key=lambda one: one[:3])[:MODELS_TRIED]:
        _allow_time()
        try:
            result = model.solve(scene, Request(resolution=resolution))
        except ERRORS as error:
            words.append(f"{model.name}: {_in_lines(str(error))}")
        else:
            json.dumps(as_entries(result), allow_nan=False)
            as_bytes(result)
            repr(result)
            solved += 1
    if models:
        _, name, resolution, _ = min(models, key=lambda one: one[:3])
        _run_command("solve", path, "--model", name, "--resolution", str(resolution))
    if advised:
        _run_command("advise", path)
    return ("answered" if solved else "not solved"), "\n".join(words)


def _run_command(name: str, path: Path, *options: str) -> None:
    """Run a command with ``--json`` in this process; AssertionError for an answer that is not sound."""
    _allow_time()
    done = CliRunner().invoke(app, [name, str(path), *options, "--json"])
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    assert done.exit_code in (0, 2, 3, 4), (name, done.exit_code, done.stderr)
    if done.stdout.strip():
        json.loads(done.stdout, parse_constant=_refuse)
    if done.exit_code not in (0, 3) or not done.stdout.strip():
        _in_lines(done.stderr)


def _refuse(name: str) -> None:
    raise AssertionError(f"JSON holds {name}")


def _in_lines(message: str) -> str:
    """The message, if each of its lines is short and plain; AssertionError otherwise."""
    for line in message.splitlines():
        assert len(line) <= MAX_LINE, f"line of {len(line)} characters: {line[:200]}"
        assert not CONTROLS.search(line), f"control characters: {line!r:.200}"
        assert "Traceback" not in line, line
    assert message.strip(), "no message"
    return message
