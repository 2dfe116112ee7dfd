"""Every command fits the terminal: no line is longer, no name is cut, and the last line is the answer."""

import importlib
import shlex
import shutil

import numpy as np
import pytest
import typer
from places import ROOT, SCENES, STUDIES
from small_scenes import CONTACT, SEAL, SURFACE
from typer import rich_utils
from typer.testing import CliRunner

from roughfilm.cli.first_steps.models import TYPICAL_CPU_S, overview, typical_cpu_s
from roughfilm.cli.main import COMMANDS, MODULES, app
from roughfilm.ladder import models
from roughfilm.rom.ladder.model import Availability
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.stability.form import table_of as table_of_outcomes
from roughfilm.terminal import console
from roughfilm.terminal.console import messages, output
from roughfilm.terminal.results import print_all, table_of

WIDTHS = (80, 60)
COARSE = (
    "--set roughness.surface.points='[32, 32]' --set roughness.surface.correlation_length='0.2 mm' "
    "--set roughness.surface.anisotropy=1 --resolution 16"
)
RUNS = {
    "models": ["models", *(f"models {kind}" for kind in ("bearing", "dry_contact", "pocket", "rough_gap", "seal"))],
    "advise": ["advise pocket.toml"],
    "solve": ["solve pocket.toml", "solve pocket.toml --model inertial_reynolds"],
    "compare": ["compare contact.toml --out compared"],
    "stribeck": [f"stribeck rough_washer.toml {COARSE} --loads 1MPa --speeds 20rpm,500rpm --out washer"],
    "dynamics": ["dynamics grooved_journal.toml --resolution 32 --speeds 1000rpm,3000rpm --out rotor"],
    "march": ["march unbalanced_rotor.toml --cells 16,8 --end 5ms --no-uncertainty --out march{width}"],
    "effects": ["effects parabolic_slider.toml --resolution 64 --out effects"],
    "leakage": ["leakage seal.toml --loads 1kPa,20kPa --out leakage"],
    "surface": ["surface rough.toml --out cell.h5"],
    "fit": ["fit rough.toml --windows 16 --seeds 40"],
    "windows": ["windows rough.toml --scene seal.toml --windows 4 --size 80um --sizes 40um --jobs 1 --out windows"],
    "combine": ["combine rough.toml rough.toml", "combine rough.toml rough.toml --operation sum --out walls.h5"],
    "contact": ["contact rough.toml --modulus 10MPa --poisson 0.5 --loads 1kPa,20kPa --out contacts.h5"],
    "factors": ["factors rough.toml --gap 0.5um"],
    "batch": ["batch study.toml --out sweep --jobs 1", "batch study.toml --out sweep --jobs 1 --dry-run"],
    "report": ["report sweep"],
    "cluster": ["cluster keys keys{width}"],
    "generate": ["generate pocket.toml --resolution 24 --out cases{width}"],
    "collect": ["collect cases{width} --jobs 1"],
    "export": ["export rough.toml --out rough.vtu"],
    "doctor": ["doctor"],
    "validate": ["validate --source fowell --out numbers"],
    "cache": ["cache"],
}
"""Small examples of the commands; report needs the sweep of batch before it, collect the cases of generate."""

ONE_WIDTH = {"doctor", "compare", "dynamics", "leakage", "march", "report", "stribeck", "windows"}
"""Commands that take seconds, which are run in the narrower terminal alone."""

FILES = {"new", "schema"}
"""Commands that print a file, which has its own width."""

SLOW = {"charts", "stability"}
"""Commands that take minutes; their tables are tested alone."""


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A directory with small scenes."""
    place = tmp_path_factory.mktemp("width")
    for name in ("pocket", "rough_washer", "parabolic_slider", "grooved_journal", "unbalanced_rotor"):
        shutil.copy(SCENES / f"{name}.toml", place)
    shutil.copy(STUDIES / "pocket.toml", place / "study.toml")
    for name, text in {"rough.toml": SURFACE, "seal.toml": SEAL, "contact.toml": CONTACT}.items():
        (place / name).write_text(text)
    return place


def fits(text, width):
    lines = text.splitlines()
    assert [line for line in lines if len(line) > width] == []
    assert "…" not in text
    return lines


def at_width(monkeypatch, width):
    for one in (output, messages):
        monkeypatch.setattr(one, "_width", width)


def test_every_command_is_run():
    assert set(COMMANDS) - FILES - SLOW <= set(RUNS)


@pytest.mark.filterwarnings("ignore:No artists with labels")
@pytest.mark.parametrize("name", [name for name in RUNS if name in COMMANDS])
def test_a_command_fits_the_terminal_and_ends_with_its_answer(name, place, monkeypatch):
    monkeypatch.chdir(place)
    monkeypatch.setenv("ROUGHFILM_CACHE", "kept")  # a path is never broken
    if name == "report" and not (place / "sweep").exists():
        CliRunner().invoke(app, shlex.split(RUNS["batch"][0]))
    for width in WIDTHS[-1:] if name in ONE_WIDTH else WIDTHS:
        at_width(monkeypatch, width)
        for line in RUNS[name]:
            done = CliRunner().invoke(app, shlex.split(line.format(width=width)))
            assert done.exit_code == 0, done.output
            last = fits(done.stdout, width)[-1]
            assert last.strip(), line
            fits(done.stderr, width)


@pytest.mark.parametrize("name", COMMANDS)
def test_the_help_fits_80_columns_and_ends_with_examples_and_exit_codes(name, monkeypatch):
    monkeypatch.setattr(rich_utils, "MAX_WIDTH", 80)
    done = CliRunner().invoke(app, [name, "--help"])
    lines = fits(done.stdout, 80)
    assert lines.index(" Examples".ljust(80)) < lines.index(" Exit codes".ljust(80))


@pytest.mark.parametrize("name", COMMANDS)
def test_the_examples_of_the_help_can_be_typed(name):
    module = importlib.import_module(MODULES[name])
    group = typer.main.get_command(app)
    for line in module.EXAMPLES:
        program, *words = shlex.split(line.partition(">")[0])
        assert program == "roughfilm"
        assert [word for word in words if word.startswith("scripts/") and not (ROOT / word).exists()] == []
        context = group.make_context("roughfilm", words)
        called, command, rest = group.resolve_command(context, words)
        assert called in COMMANDS
        command.make_context(called, rest)


def test_the_list_of_models_is_one_screen_and_that_of_a_kind_less(monkeypatch):
    at_width(monkeypatch, 80)
    assert len(CliRunner().invoke(app, ["models"]).stdout.splitlines()) <= 42
    for kind in TYPICAL_CPU_S:
        assert len(CliRunner().invoke(app, ["models", kind]).stdout.splitlines()) <= 36


def test_the_readme_shows_the_list_of_models(monkeypatch):
    at_width(monkeypatch, 80)
    here = Availability(available=True)
    rows = [(one, here) for one in sorted(models(), key=lambda one: (one.kind, typical_cpu_s(one)))]
    *lines, _, _ = overview(rows)
    assert "\n".join(lines) in (ROOT / "README.md").read_text()


def test_every_model_has_a_typical_cost_in_the_order_of_the_laws():
    assert {(one.kind, one.name) for one in models()} == {
        (kind, name) for kind, costs in TYPICAL_CPU_S.items() for name in costs
    }
    for name in ("rough_pad", "rough_washer", "dry_contact", "pocket", "random_gap", "seal"):
        scene = load_scene(SCENES / f"{name}.toml")
        costs = [
            (TYPICAL_CPU_S[scene.kind][one.name], one.cost(scene, one.resolution_of(scene)))
            for one in models(scene.kind)
            if one.applies(scene).applies
        ]
        _, law = np.array(sorted(costs)).T
        assert (np.maximum.accumulate(law) <= 2 * law).all()


def test_a_wide_table_goes_on_below_with_its_first_column(monkeypatch, capsys):
    monkeypatch.setattr(output, "_width", 40)
    heads = ["model", *(f"quantity {number}" for number in range(6))]
    print_all([table_of(heads, [["reynolds_incompressible", *("1.2345 ± 0.0067" for _ in range(6))]], left=1)])
    text = capsys.readouterr().out
    fits(text, 40)
    assert text.count("reynolds_incompressible") == 6
    assert text.count("1.2345 ± 0.0067") == 6


def test_words_beside_a_long_name_go_on_below_it(monkeypatch, capsys):
    monkeypatch.setattr(output, "_width", 40)
    print_all(
        [table_of(["model", "what it adds"], [["reynolds_incompressible", "mass-conserving cavitation"]], left=2)]
    )
    assert capsys.readouterr().out == "reynolds_incompressible: mass-conserving\n  cavitation\n\n"


def test_a_file_name_is_never_broken(monkeypatch, capsys):
    monkeypatch.setattr(output, "_width", 20)
    print_all(["report: a_directory_with_a_long_name/report.html"])
    assert "a_directory_with_a_long_name/report.html" in capsys.readouterr().out


def test_the_table_of_a_map_fits(monkeypatch, capsys):
    runs = [
        {"outcome": outcome, "iterations": 12, "cpu_s": 1.5}
        for outcome in ("converged", "slow", "inaccurate", "stalled", "wrong", "refused")
    ]
    for width in WIDTHS:
        monkeypatch.setattr(output, "_width", width)
        print_all([table_of_outcomes({"a group of scenes with a long name": runs}, "group")])
        fits(capsys.readouterr().out, width)


@pytest.mark.parametrize("arguments", [["modles"], ["models", "pokcet"], ["solve", "x.toml", "--modle", "film"]])
def test_a_wrong_word_gets_the_nearest_one(arguments, monkeypatch, capsys):
    monkeypatch.setattr(console.signal, "signal", lambda *_: None)
    with pytest.raises(SystemExit) as ended:
        console.launch(app, arguments)
    assert ended.value.code == 2
    nearest = {"modles": "models", "models": "pocket", "solve": "--model"}[arguments[0]]
    assert nearest in capsys.readouterr().err
