"""Files of stiffness and damping over speed and load: HDF5 with a digest of the input, CSV, and tables for ROSS."""

import json
import math
from collections.abc import Sequence
from pathlib import Path

import h5py
import numpy as np
from scipy.interpolate import PchipInterpolator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.checked_hdf5 import open_if_of, write_checked, write_column, write_inputs
from roughfilm.contact.foundation.files import replacing
from roughfilm.contact.foundation.inputs import Inputs
from roughfilm.contact.foundation.reading.hdf5_content import Json, Numbers
from roughfilm.contact.foundation.writing.kinds import beginning_with
from roughfilm.rom.bearing.dynamics.point import ENTRIES, UNITS, DynamicPoint
from roughfilm.rom.bearing.dynamics.sweep import DynamicCurve, dynamics
from roughfilm.rom.bearing.dynamics.whirl import RATIOS_OF_MEMORY
from roughfilm.rom.bearing.geometry.journal import Shaft
from roughfilm.rom.bearing.mixed.curves import by_operation, curve_inputs, keeping
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.model import Progress
from roughfilm.rom.studies.table import table_beginning

SCHEMA = 2
MARK = b"roughfilm dynamics, HDF5 behind 512 bytes, sha256 "
KIND = "table of stiffness and damping"
REMEDY = "remove it or choose another place"

OPERATION = {
    "pressure": "Pa",
    "load": "N",
    "speed": "m/s",
    "rotation": "rad/s",
    "residual": "1",
    "cpu_s": "s",
    "estimated_heat_transfer": "W/K",
}
"""Names and units of the numbers of a point that are no quantities."""

ROSS_MARK = b"# stiffness and damping of a bearing, from roughfilm, for ross.BearingElement.load\n"
"""First line of a table for ROSS."""

SPAN_OF_FREQUENCIES, FREQUENCIES = (0.1, 2.0), 24
"""Lowest frequency of a table for ROSS over the lowest rotational speed, highest over the highest, and their number."""

ROSS_COLUMNS = {"k": "stiffness", "c": "damping"}
ROWS = ("rows",)


def point_inputs(scene: Bearing, resolution: int, frequency_ratio: float) -> Inputs:
    """The inputs of a file: all entries on which its points depend."""
    inputs = curve_inputs(
        scene,
        None,
        resolution,
        frequency_ratio=frequency_ratio,
        direction=math.copysign(1.0, scene.motion.speed),
    )
    settings = {name: entry for name, entry in inputs.settings.items() if not name.startswith("body.")}
    return Inputs(heights=inputs.heights, spacing=inputs.spacing, settings=settings)


def save_points(path: Path, inputs: Inputs, points: Sequence[DynamicPoint]) -> None:
    """Write points in one step, in order of load and speed.

    ``points/`` has a column for each number of the operation, ``numbers/`` and ``uncertainty/`` one for each quantity;
    numbers may be infinite or NaN. ``spectrum/`` has a row for each point, of stiffness and damping over frequency. The
    attributes ``outside`` and ``leading`` have the sentences of each point, as JSON.

    Raises
    ------
    InputError
        If ``path`` cannot be written.
    """
    ordered = sorted(points, key=lambda point: (point.pressure, point.speed))

    def fill(file: h5py.File) -> None:
        write_inputs(file, inputs, SCHEMA)
        for name, unit in OPERATION.items():
            write_column(file, f"points/{name}", [getattr(point, name) for point in ordered], unit)
        for name in ordered[0].numbers if ordered else ():
            write_column(file, f"numbers/{name}", [point.numbers[name] for point in ordered], UNITS[name])
            write_column(file, f"uncertainty/{name}", [point.uncertainty[name] for point in ordered], UNITS[name])
        for name in ordered[0].spectrum if ordered else ():
            write_column(file, f"spectrum/{name}", [point.spectrum[name] for point in ordered], UNITS[name])
        file.attrs["outside"] = json.dumps([point.outside for point in ordered])
        file.attrs["leading"] = json.dumps([point.leading for point in ordered])

    write_checked(path, MARK, fill)


def known_points(path: Path, inputs: Inputs) -> tuple[DynamicPoint, ...]:
    """The points of a file for these inputs; none if there is no file, or an empty one.

    Raises
    ------
    InputError
        If the file cannot be read, is damaged, or holds other points or something else.
    """
    with open_if_of(inputs, path, MARK, SCHEMA, kind=KIND, remedy=REMEDY) as content:
        if content is None:
            return ()
        stored = set(content.names("numbers"))
        names = [name for name in UNITS if name in stored]
        wanted = {f"points/{name}": Numbers(shape=ROWS) for name in OPERATION}
        for group in ("numbers", "uncertainty"):
            wanted |= {f"{group}/{name}": Numbers(shape=ROWS, missing=True, infinite=True) for name in names}
        spectra = [name for name in UNITS if name in set(content.names("spectrum"))]
        wanted |= {f"spectrum/{name}": Numbers(shape=(*ROWS, len(RATIOS_OF_MEMORY))) for name in spectra}
        columns = content.take(wanted)
        outside = content.one("@outside", Json(kind=tuple[tuple[str, ...], ...]))
        leading = content.one("@leading", Json(kind=tuple[str, ...]))
        for place, words in (("@outside", outside), ("@leading", leading)):
            if len(words) != len(columns["points/speed"]):
                raise content.fault(place, "has another number of points")
    return tuple(
        DynamicPoint(
            **{name: columns[f"points/{name}"][row].item() for name in OPERATION},
            numbers={name: columns[f"numbers/{name}"][row].item() for name in names},
            uncertainty={name: columns[f"uncertainty/{name}"][row].item() for name in names},
            spectrum={name: tuple(columns[f"spectrum/{name}"][row].tolist()) for name in spectra},
            outside=outside[row],
            leading=leading[row],
        )
        for row in range(len(columns["points/speed"]))
    )


def resumed_dynamics(
    scene: Bearing,
    speeds: Sequence[float],
    pressures: Sequence[float],
    out: Path,
    *,
    resolution: int,
    frequency_ratio: float,
    mass: float | None,
    progress: Progress,
) -> tuple[tuple[DynamicCurve, ...], int]:
    """The points of a scene, and the number of them that were in the file.

    Parameters
    ----------
    speeds, pressures : sliding speeds, m/s, and loads over the nominal area, Pa.
    out : path of the file, which holds all finished points even if the sweep is stopped.

    Other parameters and errors are those of :func:`roughfilm.rom.bearing.dynamics.sweep.dynamics`, and an InputError if
    the file cannot be read or written, is damaged, or holds other points.
    """
    inputs = point_inputs(scene, resolution, frequency_ratio)
    known = known_points(out, inputs)
    points = by_operation(known)

    def save() -> None:
        save_points(out, inputs, tuple(points.values()))

    with keeping(points, save) as keep:
        curves = dynamics(
            scene,
            speeds,
            pressures,
            resolution=resolution,
            frequency_ratio=frequency_ratio,
            mass=mass,
            known=known,
            keep=keep,
            progress=progress,
        )
    save()
    requested = by_operation(point for curve in curves for point in curve.points)
    return curves, len(requested.keys() & by_operation(known).keys())


def write_csv(path: Path, scene: Bearing, curves: Sequence[DynamicCurve]) -> None:
    """Write a row for each point with its uncertainties; the first line has names and units.

    Of a shaft, the stiffness K c/W and the damping B c ω/W stand behind, with the clearance c and the load W. An
    unknown uncertainty is empty. If some points are outside the range of the model, the last column is 1 there.
    """
    points = [point for curve in curves for point in curve.points]
    operation, names = ("pressure", "load", "speed", "rotation"), [name for name in UNITS if name in points[0].numbers]
    dimensionless = dimensionless_of(scene, points[0])
    heads = [f"{name} ({OPERATION[name]})" for name in operation]
    heads += [f"{name} ({UNITS[name]})" for name in names] + [f"{name} ± ({UNITS[name]})" for name in names]
    heads += [f"{name} (1)" for name in dimensionless]
    some = any(point.outside for point in points)
    heads += ["outside_range (1)"] if some else []
    lines = [", ".join(heads)]
    for point in points:
        row = [getattr(point, name) for name in operation]
        row += [values[name] for values in (point.numbers, point.uncertainty) for name in names]
        row += dimensionless_of(scene, point).values()
        row += [float(bool(point.outside))] if some else []
        whole = len(operation) + len(names)
        texts = [repr(float(number)) for number in row]
        unknown = [whole <= at < whole + len(names) and not math.isfinite(number) for at, number in enumerate(row)]
        lines.append(", ".join("" if no else text for no, text in zip(unknown, texts, strict=True)))
    with replacing(path, table_beginning(heads[0])) as scratch:
        scratch.write_text("\n".join(lines) + "\n", encoding="utf-8")


def dimensionless_of(scene: Bearing, point: DynamicPoint) -> dict[str, float]:
    """K c/W and B c ω/W of a shaft by their names, "dimensionless_stiffness_xx" and so on; empty for other walls.

    Source: Lund and Thomsen 1978 for the scales.
    """
    geometry = scene.geometry
    if not isinstance(geometry, Shaft):
        return {}
    scale = geometry.clearance / point.load
    scales = {"stiffness": scale, "damping": scale * point.rotation}
    return {
        f"dimensionless_{name}": scales[matrix] * point.numbers[name]
        for name in UNITS
        if (matrix := name.partition("_")[0]) in scales and name in point.numbers
    }


def write_ross(path: Path, scene: Bearing, curve: DynamicCurve, *, version: int = 3) -> None:
    """Write the coefficients of a shaft under one load as a bearing element that ROSS loads.

    ``ross.BearingElement.load(path)`` gives the element at the node 0: kxx to kyy, N/m, cxx to cyy, N s/m, over the
    rotational speed ``speed`` and the frequency of the whirl ``frequency``, rad/s, which has the rotational speeds
    among its values. ROSS before version 3 has one axis, ``frequency``, which stands for the rotational speed. In ROSS
    as here x is horizontal, y vertical, and the shaft turns from x to y; of a shaft that turns from y to x, the axis x
    is turned round.

    Parameters
    ----------
    version : the version of ROSS, 2 or 3; for 2 the coefficients are those at the one frequency of the points.

    Raises
    ------
    InputError
        If the file cannot be written.

    Source: Timbó et al. 2020, doi:10.21105/joss.02120.
    """
    points, mirrored = curve.points, -1.0 if scene.motion.speed < 0 else 1.0
    rotations = [point.rotation for point in points]
    slowest, fastest = SPAN_OF_FREQUENCIES[0] * rotations[0], SPAN_OF_FREQUENCIES[1] * rotations[-1]
    frequencies = np.union1d([0.0, *rotations], np.geomspace(slowest, fastest, FREQUENCIES))
    entries: dict[str, object] = {"n": 0, "tag": scene.name or "bearing"}
    if version < 3:
        entries["frequency"] = rotations
    else:  # a table of one speed has one axis
        entries |= {"speed": rotations} if len(points) > 1 else {}
        entries["frequency"] = frequencies.tolist()
    for letter, matrix in ROSS_COLUMNS.items():
        for entry in ENTRIES[2]:
            name, sign = f"{matrix}{entry}", 1.0 if entry in ("_xx", "_yy") else mirrored
            rows = [sign * point.numbers[name] for point in points]
            table = [(sign * _at_frequencies(point, name, frequencies)).tolist() for point in points]
            entries[f"{letter}{entry[1:]}"] = rows if version < 3 else table if len(points) > 1 else table[0]
    lines = [f"{key} = {json.dumps(value)}" for key, value in entries.items()]
    lines += [
        f"# at {point.rotation:.4g} rad/s outside the range of the model: {'; '.join(point.outside)}"
        for point in points
        if point.outside
    ]
    mark = ROSS_MARK.decode() + f"# for ROSS {'3 or later' if version >= 3 else 'before version 3'}\n"
    text = mark + "[BearingElement_bearing]\n" + "\n".join(lines) + "\n"
    with replacing(path, beginning_with("a bearing element for ROSS", ROSS_MARK)) as scratch:
        scratch.write_text(text, encoding="utf-8")


def _at_frequencies(point: DynamicPoint, name: str, frequencies: Array) -> Array:
    """An entry of stiffness or damping at frequencies, rad/s, between those of its spectrum, at whose ends it stays."""
    known = RATIOS_OF_MEMORY
    return np.asarray(
        PchipInterpolator(known, point.spectrum[name])(np.clip(frequencies / point.rotation, known[0], known[-1]))
    )
