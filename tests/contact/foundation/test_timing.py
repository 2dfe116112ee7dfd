"""What is imported during a solution is a one-time cost of its process."""

import builtins
import json
import subprocess
import sys
import textwrap
import threading

import pytest
from places import SCENES

from roughfilm.contact.foundation.timing import claimed_costs, imports_apart

IMPORTS = textwrap.dedent(
    """
    import json, sys
    from roughfilm import load_scene
    from roughfilm.contact.foundation.timing import running_cost
    from roughfilm.ladder import find
    from roughfilm.rom.ladder.request import Request

    during = []
    sys.addaudithook(lambda event, _: during.append(running_cost()) if event == "import" else None)
    for path, model, resolution in json.loads(sys.argv[1]):
        scene = load_scene(path)
        found = find(scene.kind, model)
        during.clear()
        result = found.solve(scene, Request(resolution=resolution))
        print(json.dumps([model, len(during), during.count(""), list(result.numerics.one_time)]))
    """
)
"""Solve scenes; print for each how many modules are imported meanwhile, and how many of them as part of its work."""

SOLVED = [
    ("pocket", "film_slope", 40),
    ("parabolic_slider", "reynolds_cavitating", 16),
    ("rough_gap", "smooth_gap", None),
    ("dry_contact", "persson", None),
]


@pytest.fixture
def named(tmp_path, monkeypatch):
    """Writes modules that import each other, and returns the name of the first."""

    def write(name):
        (tmp_path / f"{name}_below.py").write_text("value = sum(range(1000))")
        (tmp_path / f"{name}.py").write_text(f"from {name}_below import value")
        monkeypatch.syspath_prepend(tmp_path)
        return name

    return write


def test_imports_of_a_block_are_a_one_time_cost_and_those_outside_are_not(named):
    inside, outside = named("imported_inside"), named("imported_outside")
    claimed_costs()
    __import__(outside)
    assert claimed_costs() == {}
    with imports_apart():
        __import__(inside)
        assert sys.modules[inside].value == 499500
        assert list(claimed_costs()) == ["start"]
        __import__(inside)  # for the second time
    assert claimed_costs() == {}


def test_python_imports_as_before_once_the_last_of_several_blocks_has_ended(named):
    plain, entered, ended = builtins.__import__, threading.Event(), threading.Event()

    def other():
        with imports_apart():
            entered.set()
            ended.wait(60)

    thread = threading.Thread(target=other)
    with imports_apart():
        thread.start()
        assert entered.wait(60)
    claimed_costs()
    __import__(named("imported_meanwhile"))
    assert list(claimed_costs()) == ["start"]
    ended.set()
    thread.join()
    assert builtins.__import__ is plain


def test_the_import_of_another_library_is_used_and_stays(named, monkeypatch):
    plain, seen = builtins.__import__, []

    def hook(name, *where, **more):
        seen.append(name)
        return plain(name, *where, **more)

    monkeypatch.setattr(builtins, "__import__", hook)
    with imports_apart():
        __import__(name := named("imported_by_a_hook"))
    assert builtins.__import__ is hook
    assert name in seen


def test_no_import_counts_as_work_of_a_model():
    tasks = [(str(SCENES / f"{scene}.toml"), model, resolution) for scene, model, resolution in SOLVED]
    done = subprocess.run([sys.executable, "-c", IMPORTS, json.dumps(tasks)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    assert [(model, uncounted) for model, _imported, uncounted, _costs in lines] == [(one, 0) for _, one, _ in SOLVED]
    assert all("start" in costs for _, imported, _, costs in lines if imported)
