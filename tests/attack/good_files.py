"""A small good file of every kind that the project reads, and how the commands read it."""

import json
import shutil
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import h5py
import numpy as np
from places import SCENES, STUDIES, SURFACES
from typer.testing import CliRunner

from roughfilm.batch.jobs import Failure, FailureRecord, Identity, read_failure
from roughfilm.batch.plan import read_batch
from roughfilm.charts.store import known as known_answers
from roughfilm.cli.main import app
from roughfilm.cli.openfoam_and_other_tools.export import _mesh
from roughfilm.cli.surfaces.factors import _read_contacts
from roughfilm.cli.upkeep.cache import _described
from roughfilm.contact.foundation.cache import Entry
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.units import Quantity
from roughfilm.contact.mechanics import store as contacts
from roughfilm.contact.mechanics.press import Press
from roughfilm.contact.preparation.recipe import load_recipe
from roughfilm.contact.read import read_height_map
from roughfilm.contact.surfaces.files import read_surface
from roughfilm.contact.surfaces.store import save_surface
from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.synthetic.description import make, read_description
from roughfilm.foamcases.openfoam.dialect import COM
from roughfilm.foamcases.openfoam.residuals import Judged, Residuals
from roughfilm.foamcases.openfoam.settling import mean_velocity
from roughfilm.foamcases.pocket.fields import read_channel
from roughfilm.generated.manifest import read_manifest
from roughfilm.generated.write import study_of_scene, write_cases
from roughfilm.interface.motion import march
from roughfilm.ladder import find, models
from roughfilm.pages.sweep import study_of
from roughfilm.rom.bearing.mixed import store as stribeck
from roughfilm.rom.bearing.mixed.stribeck import StribeckPoint
from roughfilm.rom.homogenization.factors import FlowFactors
from roughfilm.rom.homogenization.table.factor_table import FactorTable, Point
from roughfilm.rom.homogenization.table.store import Making, known_points, load_table_and_source, save_table
from roughfilm.rom.ladder.kind import kind_of
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.rom.ladder.store import as_entries, load, save
from roughfilm.rom.parts.columns_file import read_rows
from roughfilm.rom.seal.leakage.percolation import Side, Threshold
from roughfilm.rom.seal.leakage.series import NUMBERS, LeakageSeries, Row, load_series, save_series, stored_series
from roughfilm.rom.studies.study import load_study
from roughfilm.rom.studies.table import Column, read_table, write_hdf5
from roughfilm.sampling.quantities import Row as WindowRow
from roughfilm.sampling.rows import store_row, stored_row

SHAFT = SCENES / "unbalanced_rotor.toml"
HEIGHTS = np.random.default_rng(7).normal(scale=1e-6, size=(12, 8))
SPACING = (1e-6, 1e-6)
INPUTS = Inputs(
    heights=HEIGHTS,
    spacing=SPACING,
    settings={"model": "elastic", "boundary": "periodic", "composite_modulus": 1e11, "hardness": None},
)
DEPTHS = {"position": "m", "depth": "m"}

STUDY = """
name = "small"
kind = "pocket"
[geometry]
length = "1 mm"
film = "30 um"
width = "0.3 length"
depth = ["0.25 film", "0.5 film", "0.75 film"]
profile = "cylindrical"
[lubricant]
viscosity = "0.01 Pa*s"
density = "1000 kg/m^3"
[motion]
reynolds_number = [20, 60]
[study]
models = ["reynolds", "inertial_reynolds"]
"""

FIELD = """FoamFile
{{
    version     2.0;
    format      ascii;
    class       vol{name}Field;
    object      {symbol};
}}
dimensions      [0 1 -1 0 0 0 0];
internalField   nonuniform List<{kind}>
{count}
(
{values}
)
;
boundaryField
{{
}}
"""


@dataclass(frozen=True)
class GoodFile:
    """A kind of file.

    Attributes
    ----------
    make : make(folder), which writes a good file, with what belongs to it, and returns its path.
    read : read(path), which reads it as the commands do, and returns the answer.
    signed : whether the file has a digest of its bytes.
    """

    make: Callable[[Path], Path]
    read: Callable[[Path], Any]
    signed: bool = False


def _copied(source: Path) -> Callable[[Path], Path]:
    return lambda folder: Path(shutil.copy(source, folder / source.name))


def _written(name: str, text: str) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        (folder / name).write_text(text, encoding="utf-8")
        return folder / name

    return write


def _saved(name: str, values: Any) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        np.save(folder / name, values)
        return folder / name

    return write


def _file(name: str, fill: Callable[[Path], object]) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        fill(folder / name)
        return folder / name

    return write


@cache
def _result() -> Any:
    return find("pocket", "film").solve(load_scene(SCENES / "pocket.toml"), Request(resolution=100))


def _older_result(path: Path) -> None:
    save(_result(), path.with_name("new.h5"))
    with h5py.File(path.with_name("new.h5")) as new, h5py.File(path, "w") as old:
        old.attrs.update(new.attrs, schema=3)
        for name in new:
            new.copy(name, old)
    path.with_name("new.h5").unlink()


def _read_result(path: Path) -> Any:
    result = load(path)
    kind_of(result).listed(result)
    repr(result)
    mesh, _ = _mesh(path, None, None, None, None, None)
    fields = {name: (one.values.tobytes(), one.unit) for name, one in result.fields.items()}
    return as_entries(result), fields, mesh.points.tobytes()


def _table(path: Path) -> None:
    write_hdf5(
        {
            "case": Column(values=["a", "b"], unit=""),
            "load": Column(values=[1.0, float("nan")], unit="Pa"),
        },
        path,
    )


def _factors(gap: float) -> FlowFactors:
    return FlowFactors(
        mean_gap=gap, pressure=gap**3 * np.eye(2), shear=np.array([gap, 0.0]), couette=1 / gap, shear_couette=0.0
    )


def _factor_table(path: Path) -> None:
    points = [
        Point(
            separation=gap,
            contact=0.0,
            factors=_factors(gap),
            uncertainty=_factors(1e-3 * gap),
            unsolved=0.0,
            iterations=3,
            residual=1e-9,
            cpu_s=0.1,
        )
        for gap in (2e-6, 4e-6, 8e-6)
    ]
    table = FactorTable(points=points, peak=float(HEIGHTS.max()), rms=float(HEIGHTS.std()))
    save_table(path, INPUTS, table, Making(surface="small", kind="flow factors", complete=True, cpu_s=0.3))


def _read_factor_table(path: Path) -> Any:
    table, source = load_table_and_source(path)
    known_points(path, INPUTS)
    table(np.array([5e-6]))
    return repr([(point.factors, point.uncertainty, point.slopes, point.load) for point in table.points]), source


def _leakage(path: Path) -> None:
    rows = {load: Row(**dict.fromkeys(NUMBERS, 0.5) | {"load": load}) for load in (1e6, 2e6)}
    side = Side(load=3e6, area_fraction=0.4)
    save_series(path, INPUTS, LeakageSeries(rows=rows, thresholds={"direct_x": Threshold(open=side, sealed=None)}))


def _stribeck(path: Path) -> None:
    points = [
        StribeckPoint(**dict.fromkeys(stribeck.NUMBERS, 0.5) | {"speed": speed}, uncertainty={"friction": 0.1})
        for speed in (0.1, 0.2)
    ]
    stribeck.save_points(path, INPUTS, points)


def _row(path: Path) -> None:
    row = WindowRow(quantities={"Sq": Quantity(value=1.5e-6, unit="m", uncertainty=1e-8)}, cpu_s=0.1)
    store_row(row, "0", path.parents[1])


def _read_row(path: Path) -> Any:
    """The row of a window, or the error by which it is computed again."""
    row = stored_row("0", path.parents[1])
    if row is None:
        raise InputError(f"{path}: is no row of a window")
    return row.quantities


def _march(path: Path) -> Any:
    """The minimum film thickness of a march that begins, or goes on, in a file."""
    return march(load_scene(SHAFT), 1e-4, steps=2, cells=(16, 8), uncertainty=False, file=path)["film_min"].tolist()


def _manifest(path: Path) -> None:
    write_cases(study_of_scene(load_scene(SCENES / "pocket.toml"), Request(resolution=30)), path.parent, COM)


def _contacts(path: Path) -> None:
    press = Press(HEIGHTS, SPACING, 1e11)
    for pressure in (1e8, 3e8):
        contact = press.at(pressure)
        contacts.add(path, INPUTS, [(contacts.row_of(contact, 0.1), contact)])


def _read_contacts_file(path: Path) -> Any:
    inputs, loads = _read_contacts(path)
    found = [contacts.load_contact(path, load) for load in loads]
    rows = contacts.finished(path, INPUTS)
    return inputs.digest, [(one.load, one.gap.tobytes(), one.pressure.tobytes()) for one in found], rows


def _read_surface(path: Path) -> Any:
    surface = read_surface(path)
    _mesh(path, None, None, None, None, None)
    return surface.heights.tobytes(), surface.spacing, surface.invalid.tobytes(), surface.periodic


def _instrument(path: Path) -> None:
    import surfalize  # slow to import

    surfalize.Surface(1e6 * HEIGHTS, 1.5, 1.5).save(path)


def _read_heights(path: Path) -> Any:
    return read_height_map(path, SPACING, periodic=True).heights.tobytes()


@cache
def _batch() -> dict[str, bytes]:
    """The files of a finished batch, by their names."""
    with TemporaryDirectory() as place:
        (Path(place) / "study.toml").write_text(STUDY, encoding="utf-8")
        done = Path(place) / "done"
        ended = CliRunner().invoke(app, ["batch", f"{place}/study.toml", "--out", str(done)])
        assert ended.exit_code == 0, ended.output
        return _files(done)


def _files(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def _batch_with(part: str) -> Callable[[Path], Path]:
    """A directory of a batch; the file to damage is the one whose name ends so."""

    def write(folder: Path) -> Path:
        for name, data in _batch().items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(data)
        if part != "table.h5":
            (folder / "table.h5").unlink()
        return min(path for path in folder.rglob("*") if str(path).endswith(part))

    return write


def _read_batch(path: Path) -> Any:
    folder = next(place for place in path.parents if (place / "cases").exists())
    study_of(batch := read_batch(folder))
    return repr(batch.table)


def _failure(path: Path) -> None:
    identity = Identity(setting="film", scene={"kind": "pocket"}, code="1", versions={"numpy": "2"}, needs="")
    record = FailureRecord(failure=Failure(kind="ConvergenceError", message="stalled"), identity=identity)
    path.write_text(json.dumps(asdict(record)), encoding="utf-8")


@cache
def _case() -> dict[str, bytes]:
    """The files of a case with fields, by their names."""
    with TemporaryDirectory() as place:
        case = Path(place) / "case"
        scene = load_scene(SCENES / "pocket.toml")
        find("pocket", "stokes").write(scene, case, Request(resolution=20), dialect=COM)
        card = json.loads((case / "case.json").read_text(encoding="utf-8"))
        count = card["columns"] * card["layers"]
        (case / "100").mkdir()
        for name, symbol, kind, value in (("Vector", "U", "vector", "(0.5 0 0)"), ("Scalar", "p", "scalar", "0.25")):
            values = "\n".join([value] * count)
            text = FIELD.format(name=name, symbol=symbol, kind=kind, count=count, values=values)
            (case / "100" / symbol).write_text(text, encoding="ascii")
        return _files(case)


def _case_with(part: str) -> Callable[[Path], Path]:
    def write(folder: Path) -> Path:
        for name, data in _case().items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(data)
        return folder / part

    return write


def _read_case(path: Path) -> Any:
    folder = next(place for place in path.parents if (place / "Allrun").exists())
    channel = read_channel(folder)
    return channel.velocity.tobytes(), channel.pressure.tobytes()


def _read_log(path: Path) -> Any:
    residuals = Residuals(path, Judged())
    residuals.read()
    return residuals.main


LOG = "".join(
    f"Solving for {name}, Initial residual = {10.0**-step:g}, Final residual = 0, No Iterations 1\n"
    for step in range(5)
    for name in ("Ux", "Uy", "p")
)
VELOCITY = "# Time  volAverage(U)\n" + "".join(f"{step} (0.5 {step} 0)\n" for step in range(5))
ANSWERS = {
    "identity": {"code": "1"},
    "answers": {"truth": {"found": {"value": 1.0, "uncertainty": 0.1, "source": "s", "cpu_s": 0.0}, "taken": {}}},
}

KINDS = {
    "scene": GoodFile(_copied(SCENES / "pocket.toml"), load_scene),
    "scene of a bearing": GoodFile(_copied(SCENES / "textured_slider.toml"), load_scene),
    "study": GoodFile(_copied(STUDIES / "groove_depth.toml"), lambda path: load_study(path, models)),
    "description": GoodFile(
        _copied(SURFACES / "self_affine.toml"),
        lambda path: _small(path) and None,
    ),
    "recipe": GoodFile(_copied(SURFACES / "recipe.toml"), load_recipe),
    "result": GoodFile(_file("result.h5", lambda path: save(_result(), path)), _read_result, signed=True),
    "older result": GoodFile(_file("older.h5", _older_result), _read_result),
    "table": GoodFile(_file("table.h5", _table), lambda path: repr(read_table(path)), signed=True),
    "flow factors": GoodFile(_file("factors.h5", _factor_table), _read_factor_table, signed=True),
    "leakage": GoodFile(
        _file("leakage.h5", _leakage),
        lambda path: (load_series(path), stored_series(path, INPUTS)),
        signed=True,
    ),
    "Stribeck curves": GoodFile(
        _file("stribeck.h5", _stribeck), lambda path: stribeck.known_points(path, INPUTS), signed=True
    ),
    "contacts": GoodFile(_file("contacts.h5", _contacts), _read_contacts_file, signed=True),
    "surface": GoodFile(
        _file(
            "surface.h5",
            lambda path: save_surface(Surface(heights=HEIGHTS, spacing=SPACING, invalid=HEIGHTS > 2e-6), path),
        ),
        _read_surface,
        signed=True,
    ),
    "heights in NPY": GoodFile(_saved("heights.npy", HEIGHTS), _read_heights),
    "profile in NPY": GoodFile(_saved("profile.npy", HEIGHTS[:, 0]), _read_heights),
    "heights in CSV": GoodFile(
        _written(
            "heights.csv",
            "# spacing: 1.5 um, 1.5 um; heights: um\n"
            + "\n".join(",".join(f"{1e6 * value:.4f}" for value in row) for row in HEIGHTS),
        ),
        _read_surface,
    ),
    **{
        f"instrument file {suffix}": GoodFile(_file(f"measured.{suffix}", _instrument), _read_surface)
        for suffix in ("al3d", "sdf", "x3p")
    },
    "points in CSV": GoodFile(
        _written("points.csv", "position (um), depth (um)\n0, 0\n10, 5\n20, 0\n"),
        lambda path: _rows(path),
    ),
    "points in NPY": GoodFile(
        _saved("points.npy", np.array([[0.0, 0.0], [1e-5, 5e-6], [2e-5, 0.0]])), lambda p: _rows(p)
    ),
    "plan of a batch": GoodFile(_batch_with("study.json"), _read_batch),
    "table of a batch": GoodFile(_batch_with("table.h5"), _read_batch, signed=True),
    "result of a batch": GoodFile(_batch_with("reynolds.h5"), _read_batch),
    "failure": GoodFile(_file("film.failed.json", _failure), read_failure),
    "kept table": GoodFile(
        _file("kept.h5", _factor_table), lambda path: _described(Entry(path=path, size=1, use=0.0)), signed=False
    ),
    "kept leakage": GoodFile(_file("kept.h5", _leakage), lambda path: _described(Entry(path=path, size=1, use=0.0))),
    "card of a case": GoodFile(_case_with("case.json"), _read_case),
    "velocity of a case": GoodFile(_case_with("100/U"), _read_case),
    "pressure of a case": GoodFile(_case_with("100/p"), _read_case),
    "points of a case": GoodFile(_case_with("constant/polyMesh/points"), _read_case),
    "log": GoodFile(_written("log.simpleFoam", LOG), _read_log),
    "mean velocity": GoodFile(
        _file(
            "postProcessing/flow/0/volFieldValue.dat",
            lambda path: (path.parent.mkdir(parents=True), path.write_text(VELOCITY, encoding="ascii")),
        ),
        lambda path: mean_velocity(path.parents[3]).tobytes(),
    ),
    "row of a window": GoodFile(_file("rows/0.json", _row), _read_row),
    "manifest": GoodFile(_file("manifest.json", _manifest), lambda path: read_manifest(path.parent).digest),
    "march": GoodFile(_file("march.h5", _march), _march),
    "answers of charts": GoodFile(_written("answers.json", json.dumps(ANSWERS)), known_answers),
}


def _small(path: Path) -> Any:
    """The description of a surface; it is made if it is small."""
    description = read_description(path)
    return make(description).heights if np.prod(description.points) < 1e5 else description


def _rows(path: Path) -> Any:
    try:
        return read_rows(path, DEPTHS, header="position (um), depth (um)")
    except ValueError as error:
        raise InputError(f"{path}: {error}") from None
