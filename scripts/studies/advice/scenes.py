"""Random scenes of every kind, by a seed: to some of them laws are fitted, on others the advice is tested."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.random import Generator

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.ladder.kind import Scene
from roughfilm.rom.ladder.scene import read_scene
from scripts.studies.random_entries import Entries, between, chance, length, random_surface

SHAPES = ("linear", "parabolic", "step", "journal", "squared_cosine_inlet", "sector", "washer")
CHANCES = (0.2, 0.2, 0.15, 0.2, 0.1, 0.05, 0.1)
"""Probabilities of the shapes of bearings."""

SIDE = 1e-3
"""Side of the pressed surfaces, m."""


def pocket(rng: Generator) -> Entries:
    """Return a pocket: w/L = 0.1 to 0.6, d/h = 0.1 to 1.5, h/L = 0.01 to 0.06, Re = 0.5 to 250; 40 % symmetric arcs."""
    period, film = 1e-3, 1e-3 * between(rng, 0.01, 0.06)
    width, depth = period * rng.uniform(0.1, 0.6), film * between(rng, 0.1, 1.5)
    splined: Entries = {"profile": "splined", "shift": length(width * rng.uniform(-0.3, 0.3))}
    return {
        "geometry": {
            "length": length(period),
            "film": length(film),
            "width": length(width),
            "depth": length(depth),
            **({"profile": "cylindrical"} if chance(rng, 0.4) else splined),
        },
        "lubricant": {"viscosity": "0.01 Pa*s", "density": "1000 kg/m^3"},
        "motion": {"reynolds_number": between(rng, 0.5, 250)},
        "boundary": {"ambient_pressure": "1 GPa"},  # the laws hold for films that do not cavitate
    }


def rough_gap(rng: Generator) -> Entries:
    """Return a gap with random roughness, or waves of amplitude 0.05 to 0.7, length 1.5 to 30 gaps; Re = 0.1 to 100."""
    gap = 10e-6
    if chance(rng, 0.5):
        amplitude, wavelength = gap * between(rng, 0.05, 0.7), gap * between(rng, 1.5, 30)
        geometry: Entries = {"surface": "sinusoid", "amplitude": length(amplitude), "wavelength": length(wavelength)}
    else:
        shortest = gap * between(rng, 1.5, 15)
        side = shortest * 48 / 10
        surface = random_surface(rng, side, 48, gap * between(rng, 0.03, 0.2), 10)
        geometry = {"surface": surface}
    return {
        "geometry": {**geometry, "mean_gap": length(gap)},
        "lubricant": {"viscosity": "0.01 Pa*s", "density": "870 kg/m^3"},
        "flow": {"reynolds_number": between(rng, 0.1, 100)},
    }


def bearing(rng: Generator) -> Entries:
    """Pads, journals, sectors and washers; wide, narrow, starved, textured; smooth, ridged, rough; many oils."""
    film, side = between(rng, 3e-6, 50e-6), 20e-3
    geometry = shaped(rng, film, side)
    narrow = "width" in geometry or "inner_radius" in geometry
    turns = "inner_radius" in geometry
    lubricant: Entries = {"viscosity": with_unit(between(rng, 0.005, 0.2), "Pa*s")}
    lubricant["cavitation_pressure"] = with_unit(-between(rng, 1e3, 1e6), "Pa")
    if chance(rng, 0.6):
        modulus = with_unit(between(rng, 0.2e9, 3e9), "Pa")
        lubricant["compressibility"] = {"law": "constant_bulk_modulus", "bulk_modulus": modulus}
    if chance(rng, 0.4):
        lubricant["piezoviscosity"] = {"law": "barus", "pressure_coefficient": f"{rng.uniform(5, 25):.6g} GPa^-1"}
    entries: Entries = {
        "geometry": geometry,
        "lubricant": lubricant,
        "motion": {"speed": with_unit(between(rng, 0.1, 10), "m/s")},
    }
    if chance(rng, 0.2) and geometry["shape"] != "washer":
        entries["boundary"] = {"inlet": {"theta": float(rng.uniform(0.5, 1.0))}}
    kind = rng.choice(["smooth", "ridges", "asperities"], p=[0.35, 0.4, 0.25])
    if kind == "ridges" and not turns:
        entries["roughness"] = {
            "kind": "sinusoid",
            "amplitude": length(film * between(rng, 0.02, 0.8)),
            "wavelength": length(side / (between(rng, 4, 14) if narrow else between(rng, 5, 200))),
            "direction": f"{rng.uniform(0, 90):.4g} deg" if narrow else "0 deg",
        }
    if kind == "asperities":
        rms_height = film / between(rng, 1.2, 12)
        surface = random_surface(rng, rms_height * between(rng, 100, 1000), 64, rms_height, 8)
        entries["roughness"] = {"kind": "surface", "surface": surface}
        solid = {"modulus": "210 GPa", "poisson": 0.3, "hardness": with_unit(between(rng, 1e9, 8e9), "Pa")}
        entries["asperities"] = {"friction": float(rng.uniform(0.05, 0.15)), "solid": solid}
    return entries


def shaped(rng: Generator, film: float, side: float) -> Entries:
    """Return the shape of a bearing."""
    rise = length(film * between(rng, 0.2, 4.0))
    shape = str(rng.choice(SHAPES, p=CHANCES))
    if shape in ("sector", "washer"):
        inner = side * between(rng, 1.0, 4.0)
        ring = {"inner_radius": length(inner), "outer_radius": length(inner + side * between(rng, 0.5, 1.5))}
        if shape == "sector":
            return {
                "shape": shape,
                "film": length(film),
                "rise": rise,
                "angle": f"{rng.uniform(15, 60):.4g} deg",
                **ring,
            }
        pocket = {"depth": length(film * between(rng, 1.0, 30)), "share": float(rng.uniform(0.2, 0.7))}
        pocket["extent"] = length(side * rng.uniform(0.2, 0.5))
        return {"shape": shape, "film": length(film), "pockets": int(rng.integers(4, 20)), "pocket": pocket, **ring}
    width = {"width": length(side * between(rng, 0.3, 4.0))} if chance(rng, 0.6) else {}
    if shape == "journal":
        ratio = float(rng.uniform(0.2, 0.85))
        radius, clearance = length(side / (2 * np.pi)), length(film / (1 - ratio))
        return {"shape": shape, "radius": radius, "clearance": clearance, "eccentricity": ratio, **width}
    pad: Entries = {"shape": shape, "length": length(side), "film": length(film), **width}
    if shape == "squared_cosine_inlet":
        waves = {"amplitude": rise, "wavelength": length(side / int(rng.integers(2, 12)))}
        return {**pad, **waves, "extent": length(side * rng.uniform(0.5, 1.0))}
    pad["rise"] = rise
    if shape == "step":
        pad["step"] = length(side * rng.uniform(0.3, 0.8))
    if chance(rng, 0.25):
        pad["texture"] = textured(rng, film, side, pad)
    return pad


def textured(rng: Generator, film: float, side: float, pad: Entries) -> Entries:
    """Return pockets that extend from side to side, or are in rows."""
    columns = int(rng.integers(1, 6))
    pitch = side * rng.uniform(0.5, 1.0) / columns
    pockets: Entries = {
        "profile": str(rng.choice(["box", "cylindrical"])),
        "length": length(pitch * rng.uniform(0.3, 0.9)),
        "depth": length(film * between(rng, 0.2, 3.0)),
        "pitch": length(pitch),
        "columns": columns,
    }
    if "width" in pad and chance(rng, 0.5):
        rows = int(rng.integers(1, 5))
        across = float(pad["width"].split()[0]) / rows
        pockets |= {"width": length(across * rng.uniform(0.3, 0.9)), "rows": rows, "pitch_across": length(across)}
    return pockets


def sloping_surface(rng: Generator, side: float, points: int, slope: float, finest: int) -> Entries:
    """Return a random surface with an rms slope, which is approximate for Gaussian ones: 2.54 Sq/Sal across the lay."""
    surface = random_surface(rng, side, points, side, finest)
    if surface["kind"] == "gaussian":
        surface["rms_height"] = length(slope * side * finest / points / 1.5 / 2.54)
    else:
        del surface["rms_height"]
        surface["rms_slope"] = slope
    return surface


def pressed(rng: Generator, points: int, finest: int, pressures: tuple[float, float], share: float) -> Entries:
    """Steel on a rough surface of rms slope g' = 0.01 to 0.4, H/(E* g') = 0.02 to 10 or none, P/H up to that share."""
    slope = between(rng, 0.01, 0.4)
    unit = 210e9 / (1 - 0.3**2) * slope
    surface = sloping_surface(rng, SIDE, points, slope, finest)
    solid: Entries = {"modulus": "210 GPa", "poisson": 0.3}
    pressure = unit * between(rng, *pressures)
    if chance(rng, 0.7):
        hardness = unit * between(rng, 0.02, 10)
        solid["hardness"] = with_unit(hardness, "Pa")
        pressure = min(pressure, hardness * rng.uniform(0.01, share))
    return {"geometry": {"surface": surface}, "solid": solid, "load": {"pressure": with_unit(pressure, "Pa")}}


def dry_contact(rng: Generator) -> Entries:
    """Surfaces of 128² points, their shortest waves of 4 to 15, P/(E* g') = 10⁻³ to 1."""
    return pressed(rng, 128, int(rng.integers(4, 16)), (1e-3, 1.0), 0.9)


def seal(rng: Generator) -> Entries:
    """Surfaces of 64² points with water through one to eight periods, P/(E* g') = 0.01 to 0.35."""
    return {
        **pressed(rng, 64, int(rng.integers(4, 9)), (0.01, 0.35), 0.35),
        "liquid": {"density": "1000 kg/m^3", "viscosity": "1 mPa*s"},
        "flow": {
            "pressure_drop": "1 MPa",
            "length": length(SIDE * int(rng.integers(1, 9))),
            "direction": str(rng.choice(["x", "y"])),
        },
    }


DRAWN: Mapping[str, Callable[[Generator], Entries]] = {
    "pocket": pocket,
    "rough_gap": rough_gap,
    "bearing": bearing,
    "dry_contact": dry_contact,
    "seal": seal,
}


def random_scene(kind: str, seed: int) -> Scene:
    """Return the scene of a kind and a seed, named by both: the first valid one of the random scenes."""
    rng = np.random.default_rng([seed, *kind.encode()])
    while True:
        try:
            return read_scene({"name": f"{kind} {seed}", "kind": kind, **DRAWN[kind](rng)})
        except InputError:  # an arc steeper than a half circle, a lay longer than its surface
            continue
