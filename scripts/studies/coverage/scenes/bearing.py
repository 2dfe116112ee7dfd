"""Random bearings: every shape, films from points, textures, starved and fed under pressure, smooth and rough."""

import math

import numpy as np
from numpy.random import Generator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import with_unit
from scripts.studies.coverage.random_entries import Entries, between, chance, length, random_surface
from scripts.studies.coverage.surfaces import stored

SHAPES = (
    "parallel",
    "linear",
    "step",
    "parabolic",
    "sinusoidal_inlet",
    "squared_cosine_inlet",
    "given",
    "journal",
    "sector",
    "washer",
)
CHANCES = (0.1, 0.14, 0.1, 0.12, 0.06, 0.06, 0.1, 0.2, 0.06, 0.06)
"""Probabilities of the shapes."""

MAX_PRESSURE = 3e9
"""Largest 6ηuL/h² of a scene, Pa."""

RINGS = ("sector", "washer")


def draw(rng: Generator) -> Entries:
    """Return a bearing: rise/h = 0.1 to 8, B/L = 0.1 to 8, eccentricity to 0.97, cavitation at -1 kPa to -1 MPa.

    A third has a texture, a quarter a starved inlet and a quarter pressures at its ends, a tenth slides backwards, and
    a quarter each has ridges and a rough surface.

    Raises
    ------
    InputError
        If 6ηuL/h² exceeds ``MAX_PRESSURE`` or the bulk modulus, where no law of density holds.
    """
    side, film = between(rng, 2e-3, 0.1), between(rng, 2e-6, 100e-6)
    shape = str(rng.choice(SHAPES, p=CHANCES))
    geometry = shaped(rng, shape, film, side)
    narrow = shape in RINGS or "width" in geometry
    joined = shape == "washer" or geometry.get("joined", False)
    speed = between(rng, 0.05, 30) * (-1 if chance(rng, 0.1) else 1)
    oil = lubricant(rng)
    pressure = 6 * _number(oil["viscosity"]) * abs(speed) * side / film**2
    if pressure > min(MAX_PRESSURE, _number(oil["compressibility"].get("bulk_modulus", "inf Pa"))):
        raise InputError(f"6ηuL/h²: got {pressure:.2g} Pa; draw again")
    entries: Entries = {
        "geometry": geometry,
        "lubricant": oil,
        "motion": {"speed": with_unit(speed, "m/s")},
        "boundary": fed(rng, joined, narrow),
    }
    kind = str(rng.choice(["smooth", "ridges", "surface"], p=[0.5, 0.25, 0.25]))
    if kind == "ridges":
        entries["roughness"] = {
            "kind": "sinusoid",
            "amplitude": length(film * between(rng, 0.02, 0.9)),
            "wavelength": length(side / between(rng, 2, 10 if narrow else 200)),
            "direction": f"{rng.choice([0, 90, rng.uniform(-90, 90)]):.4g} deg",
        }
    if kind == "surface":
        rms_height = film / between(rng, 1.0, 15)
        surface = random_surface(rng, rms_height * between(rng, 50, 2000), 48, rms_height, int(rng.integers(4, 12)))
        entries["roughness"] = {"kind": "surface", "surface": surface}
        if chance(rng, 0.7):
            solid = {"modulus": "210 GPa", "poisson": 0.3, "hardness": with_unit(between(rng, 0.5e9, 10e9), "Pa")}
            entries["asperities"] = {"friction": float(rng.uniform(0.03, 0.3)), "solid": solid}
    return entries


def _number(text: str) -> float:
    return float(text.partition(" ")[0])


def lubricant(rng: Generator) -> Entries:
    """Return a lubricant of 1 mPa s to 1 Pa s with any law of density and viscosity."""
    entries: Entries = {
        "viscosity": with_unit(between(rng, 1e-3, 1.0), "Pa*s"),
        "cavitation_pressure": with_unit(-between(rng, 1e3, 1e6), "Pa"),
    }
    law = str(rng.choice(["incompressible", "constant_bulk_modulus", "dowson_higginson"], p=[0.35, 0.4, 0.25]))
    modulus = {"bulk_modulus": with_unit(between(rng, 0.1e9, 5e9), "Pa")} if law == "constant_bulk_modulus" else {}
    entries["compressibility"] = {"law": law, **modulus}
    thick = str(rng.choice(["constant", "barus", "roelands"], p=[0.5, 0.3, 0.2]))
    entries["piezoviscosity"] = {"law": thick}
    if thick == "barus":
        entries["piezoviscosity"]["pressure_coefficient"] = f"{rng.uniform(2, 30):.6g} GPa^-1"
    if thick == "roelands":
        entries["piezoviscosity"]["index"] = float(rng.uniform(0.3, 0.8))
    return entries


def fed(rng: Generator, joined: bool, sided: bool) -> Entries:
    """Return the pressures, or the starvation, at the ends and sides of the film."""

    def pressure() -> str:
        return with_unit(between(rng, 1e3, 3e6) if chance(rng, 0.7) else 0.0, "Pa")

    sides = {"sides": {"low": pressure(), "high": pressure()}} if sided and chance(rng, 0.3) else {}
    if joined:
        return sides
    way = rng.random()
    if way < 0.25:
        return {**sides, "inlet": {"theta": float(rng.uniform(0.1, 1.0))}}
    if way < 0.5:
        return {**sides, "inlet": {"pressure": pressure()}, "outlet": {"pressure": pressure()}}
    return sides


def shaped(rng: Generator, shape: str, film: float, side: float) -> Entries:
    """Return the shape of a bearing."""
    rise = film * between(rng, 0.1, 8.0)
    if shape in RINGS:
        return ring(rng, shape, film, rise, side)
    across = side * between(rng, 0.1, 8.0)
    width = {"width": length(across)} if chance(rng, 0.6) or shape == "given" else {}
    pad: Entries = {"shape": shape, "length": length(side), "film": length(film), **width}
    if shape == "journal":
        ratio = float(rng.uniform(0.05, 0.97))
        pad = {"shape": shape, "eccentricity": ratio, **width}
        pad |= {"radius": length(side / (2 * math.pi)), "clearance": length(min(film / (1 - ratio), side / 70))}
    elif shape in ("sinusoidal_inlet", "squared_cosine_inlet"):
        height = film * between(rng, 0.05, 0.9) if shape == "sinusoidal_inlet" else rise
        waves = {"amplitude": length(height), "wavelength": length(side / rng.uniform(0.7, 8))}
        pad |= {**waves, "extent": length(side * rng.uniform(0.2, 1.0))}
    elif shape == "given":
        pad["thickness"] = str(stored(heights(rng, film, rise)))
    elif shape != "parallel":
        pad["rise"] = length(rise)
        if shape == "step":
            pad["step"] = length(side * rng.uniform(0.1, 0.9))
        if shape == "parabolic":
            pad["count"] = int(rng.choice([1, 1, 1, 2, 3]))
    if shape == "parallel" or chance(rng, 0.25):
        pad["texture"] = textured(rng, film, side, across if width else None)
    return pad


def ring(rng: Generator, shape: str, film: float, rise: float, side: float) -> Entries:
    """Return a sector pad or a washer."""
    inner = side * between(rng, 0.5, 6.0)
    both: Entries = {
        "shape": shape,
        "film": length(film),
        "inner_radius": length(inner),
        "outer_radius": length(inner + side * between(rng, 0.2, 2.0)),
    }
    if shape == "sector":
        angle = f"{rng.uniform(8, 90):.4g} deg"
        taper = float(rng.choice([1.0, rng.uniform(0.1, 0.9)]))
        return {**both, "rise": length(rise), "angle": angle, "taper": taper, "joined": chance(rng, 0.3)}
    start = float(rng.uniform(0, 0.4))
    pocket = {
        "depth": length(film * between(rng, 0.3, 50)),
        "share": float(rng.uniform(0.1, 0.95 - start)),
        "extent": length(side * rng.uniform(0.05, 0.2)),
        "start": start,
    }
    return {**both, "pockets": int(rng.integers(2, 30)), "pocket": pocket}


def textured(rng: Generator, film: float, side: float, across: float | None) -> Entries:
    """Return pockets that extend from side to side, or are in rows; box, cylindrical or ellipsoidal."""
    columns = int(rng.integers(1, 7))
    pitch = side * rng.uniform(0.4, 1.0) / columns
    pockets: Entries = {
        "profile": str(rng.choice(["box", "cylindrical"])),
        "length": length(pitch * rng.uniform(0.2, 0.95)),
        "depth": length(film * between(rng, 0.1, 6.0)),
        "start": length(rng.uniform(0, 1) * (side - columns * pitch)),
        "pitch": length(pitch),
        "columns": columns,
    }
    if across is not None and chance(rng, 0.6):
        rows = int(rng.integers(1, 6))
        pockets |= {"width": length(across / rows * rng.uniform(0.2, 0.95)), "rows": rows}
        pockets |= {"pitch_across": length(across / rows), "profile": str(rng.choice(["box", "ellipsoidal"]))}
    return pockets


def heights(rng: Generator, film: float, rise: float) -> Array:
    """Return a film that narrows along the sliding with random bumps, at 3 to 12 points a side, m."""
    points = tuple(int(number) for number in rng.integers(3, 13, 2))
    taper = np.linspace(rise, 0, points[0])[:, None] * np.ones(points[1])
    return np.asarray(film + taper + rise * rng.uniform(0, 0.3) * rng.uniform(0, 1, points))
