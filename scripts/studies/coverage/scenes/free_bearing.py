"""Random bearings whose wall moves freely under a load: shafts in lobes and pads about a pivot, smooth and rough."""

import math

from numpy.random import Generator

from roughfilm.contact.foundation.errors import InputError
from roughfilm.contact.foundation.units import with_unit
from scripts.studies.coverage.random_entries import Entries, between, chance, length, random_surface
from scripts.studies.coverage.scenes.bearing import lubricant

BORES = ("full", "arc", "two", "offset", "multi", "tilting")
BORE_CHANCES = (0.2, 0.15, 0.2, 0.1, 0.15, 0.2)
"""Bores of shafts and their probabilities."""

SHAFTS, SECTORS = 0.65, 0.15
"""Fractions of shafts, and of pads that are sectors of a ring; the other pads are rectangles."""

MAX_PRESSURE = 100e6
"""Largest mean pressure of a scene, Pa."""

MAX_COMPRESSION = 0.05
"""Largest mean pressure over a bulk modulus."""

POINTS = 32
"""Points along a side of a rough surface."""

WEDGE_LOAD = 0.16
"""Load of an infinitely wide pad over η u L²/h² whose film narrows to about half its thickness."""


def draw(rng: Generator) -> Entries:
    """Return a bearing under a load.

    Of 100 there are 65 shafts: in full bores, arcs, halves, offset halves, bores of three or four lobes and tilting
    pads, with B/D = 0.2 to 2, preloads up to 0.7, Sommerfeld numbers S = 0.03 to 5 over 1 + (D/B)², and loads in any
    direction within 60° of downwards; an eighth is misaligned, and a third of the full bores has a groove or a hole. Of
    the pads 43 % are sectors; a third tilts about a line, a quarter has a crown, a tenth a moment, and the film is
    5·10⁻⁵ to 10⁻³ of the length. The lubricant is that of the kind ``bearing``; a quarter cavitates at ambient
    pressure, as all tilting pads of shafts under a load do. Of those without supplies 16 of 100 have short ridges along
    or across, and 6 a rough surface whose asperities touch (28 at a given place).

    Raises
    ------
    InputError
        If the pressures are too high for the laws of the lubricant.
    """
    return bearing(rng, loaded=True)


def bearing(rng: Generator, *, loaded: bool) -> Entries:
    """Return a bearing under a load, or with its wall at a given place; raises what :func:`draw` raises."""
    oil = lubricant(rng)
    speed = between(rng, 0.5, 40) * (-1 if chance(rng, 0.08) else 1)
    if chance(rng, 0.25):
        oil["cavitation_pressure"] = "0 Pa"
    entries: Entries = {"kind": "bearing", "lubricant": oil, "motion": {"speed": with_unit(speed, "m/s")}}
    sheared = _number(oil["viscosity"]) * abs(speed)
    add = _shaft if chance(rng, SHAFTS) else _pad
    film, side, pressure = add(rng, entries, sheared, loaded=loaded)
    limit = min(MAX_PRESSURE, MAX_COMPRESSION * _number(oil["compressibility"].get("bulk_modulus", "inf Pa")))
    if pressure > limit:
        raise InputError(f"mean pressure: got {pressure:.2g} Pa, at most {limit:.2g} Pa; draw again")
    return {**entries, **({} if "supply" in entries else _walls(rng, film, side, loaded=loaded))}


def _number(text: str) -> float:
    return float(text.partition(" ")[0])


def _reversed(entries: Entries) -> bool:
    """Whether the wall slides towards decreasing x."""
    return _number(entries["motion"]["speed"]) < 0


def _shaft(rng: Generator, entries: Entries, sheared: float, *, loaded: bool) -> tuple[float, float, float]:
    """Add a shaft in a bore; return a typical film, the circumference, m, and the mean pressure, Pa."""
    radius = between(rng, 5e-3, 0.1)
    width, clearance = 2 * radius * between(rng, 0.2, 2.0), radius * between(rng, 5e-4, 3e-3)
    bore, geometry = str(rng.choice(BORES, p=BORE_CHANCES)), dict[str, object]()
    down = -90 + float(rng.choice([0.0, rng.uniform(-60, 60)]))
    if bore == "arc":
        geometry |= {
            "lobes": 1,
            "arc": f"{rng.uniform(60, 200):.4g} deg",
            "first": f"{-90 + rng.uniform(-15, 15):.4g} deg",
        }
        down = -90.0
    elif bore in ("two", "offset"):
        geometry |= {"lobes": 2, "arc": f"{rng.uniform(140, 175):.4g} deg"}
    elif bore == "multi":
        lobes = int(rng.integers(3, 5))
        geometry |= {"lobes": lobes, "arc": f"{360 / lobes * rng.uniform(0.75, 0.97):.4g} deg"}
    elif bore == "tilting":
        lobes = int(rng.integers(3, 7))
        turned = -90 + float(rng.choice([0.0, 180 / lobes]))
        geometry |= {
            "lobes": lobes,
            "arc": f"{360 / lobes * rng.uniform(0.6, 0.9):.4g} deg",
            "first": f"{turned:.6g} deg",
        }
        pivot = float(rng.choice([0.5, rng.uniform(0.5, 0.62)]))
        geometry["pivot"] = 1 - pivot if _reversed(entries) else pivot
        if loaded:  # below it the suction of idle pads closes many of them
            entries["lubricant"]["cavitation_pressure"] = "0 Pa"
    preload = 0.0
    if bore in ("offset", "multi", "tilting") or (bore == "two" and chance(rng, 0.5)):
        preload = float(rng.uniform(0.1, 0.7)) if bore != "multi" or chance(rng, 0.7) else 0.0
        geometry["preload"] = preload
    if bore == "offset" or (bore == "multi" and chance(rng, 0.4)):
        geometry["offset"] = float(rng.uniform(0.5, 1.0))
    tight = clearance * (1 - preload)
    if chance(rng, 0.12):
        slope = 0.6 * tight / width
        geometry["misalignment"] = [f"{rng.uniform(-slope, slope):.6g} rad" for _ in range(2)]
    geometry |= {"shape": "lobes", "radius": length(radius), "clearance": length(clearance), "width": length(width)}
    entries["geometry"] = geometry
    share = 1 / (1 + (2 * radius / width) ** 2)
    pressure = sheared / (2 * math.pi * radius) * (radius / clearance) ** 2 * share / between(rng, 0.03, 5.0)
    pressure /= max(1 - preload, 0.3)
    if loaded:
        entries["load"] = {"pressure": with_unit(pressure, "Pa"), "angle": f"{down:.6g} deg"}
    else:
        ratio, toward = float(rng.uniform(0.05, 0.9)) * (1 - preload), math.radians(down + rng.uniform(-30, 60))
        geometry["eccentricity"] = [ratio * math.cos(toward), ratio * math.sin(toward)]
    fed = with_unit(between(rng, 1e4, 5e5), "Pa")
    if bore == "full":
        if _number(entries["lubricant"]["cavitation_pressure"]) == 0 or chance(rng, 0.2):
            entries["boundary"] = {"sides": {"low": fed, "high": fed}}
        if chance(rng, 0.35):
            entries["supply"] = [_supply(rng, radius, width, fed, down)]
    elif chance(rng, 0.5):
        entries["boundary"] = {"inlet": {"pressure": fed}}
    return tight / 3, 2 * math.pi * radius, pressure


def _supply(rng: Generator, radius: float, width: float, fed: str, down: float) -> Entries:
    """An axial groove or a hole on the side away from the load."""
    angle = f"{down + 180 + rng.uniform(-60, 60):.6g} deg"
    if chance(rng, 0.6):
        sides = {"length": length(radius * rng.uniform(0.1, 0.5)), "extent": length(width * rng.uniform(0.3, 0.9))}
        return {"kind": "groove", "angle": angle, "pressure": fed, **sides}
    return {"kind": "hole", "angle": angle, "pressure": fed, "diameter": length(width * rng.uniform(0.1, 0.3))}


def _pad(rng: Generator, entries: Entries, sheared: float, *, loaded: bool) -> tuple[float, float, float]:
    """Add a pad about a pivot; return its film and length, m, and its mean pressure, Pa."""
    along, across = float(rng.uniform(0.54, 0.68)), float(rng.choice([0.5, rng.uniform(0.46, 0.56)]))
    if chance(rng, SECTORS / (1 - SHAFTS)):
        inner = between(rng, 10e-3, 0.1)
        outer, angle = inner * rng.uniform(1.3, 2.5), float(rng.uniform(20, 70))
        side, width = math.radians(angle) * (inner + outer) / 2, outer - inner
        geometry: Entries = {"shape": "pivoted_sector", "angle": f"{angle:.6g} deg"}
        geometry |= {"inner_radius": length(inner), "outer_radius": length(outer)}
        across = float(rng.uniform(0.5, 0.58))
    else:
        side = between(rng, 5e-3, 0.2)
        width = side * between(rng, 0.3, 3.0)
        geometry = {"shape": "pivoted", "length": length(side), "width": length(width)}
    film = side * between(rng, 5e-5, 1e-3)
    geometry["pivot"] = [1 - along if _reversed(entries) else along, across]
    if chance(rng, 0.33):
        geometry["line"] = True
    if chance(rng, 0.25):
        geometry["crown"] = length(film * rng.uniform(0.05, 1.0))
    share = 1 / (1 + (side / width) ** 2)
    pressure = WEDGE_LOAD * sheared * side / film**2 * share
    if loaded:
        entries["load"] = {"pressure": with_unit(pressure, "Pa")}
        if chance(rng, 0.1):
            entries["load"]["moment_y"] = with_unit(rng.uniform(-0.02, 0.02) * pressure * side**2 * width, "N*m")
    else:
        slopes = [(1 if _reversed(entries) else -1) * film / side * between(rng, 0.3, 3.0), 0.0]
        if not geometry.get("line") and chance(rng, 0.5):
            slopes[1] = float(rng.uniform(-0.5, 0.5)) * film / width
        geometry |= {"film": length(film), "slopes": [f"{slope:.6g} rad" for slope in slopes]}
    entries["geometry"] = geometry
    if chance(rng, 0.15):
        entries["boundary"] = {"inlet": {"pressure": with_unit(between(rng, 1e4, 5e5), "Pa")}}
    return film, side, pressure


def _walls(rng: Generator, film: float, side: float, *, loaded: bool) -> Entries:
    """Short ridges along or across, or a rough surface whose asperities touch; or smooth walls."""
    smooth = "smooth" if loaded else "surface"
    kind = str(rng.choice(["smooth", "ridges", smooth, "surface"], p=[0.56, 0.16, 0.22, 0.06]))
    if kind == "ridges":
        ridges = {
            "amplitude": length(film * between(rng, 0.03, 0.8)),
            "wavelength": length(side / between(rng, 3e3, 3e4)),
        }
        return {"roughness": {"kind": "sinusoid", **ridges, "direction": f"{rng.choice([0, 90])} deg"}}
    if kind == "surface":
        rms_height = film * between(rng, 0.03, 0.5)
        surface = random_surface(rng, rms_height * between(rng, 50, 500), POINTS, rms_height, int(rng.integers(4, 12)))
        solid = {"modulus": "210 GPa", "poisson": 0.3, "hardness": with_unit(between(rng, 0.5e9, 10e9), "Pa")}
        asperities = {"friction": float(rng.uniform(0.03, 0.3)), "solid": solid}
        return {"roughness": {"kind": "surface", "surface": surface}, "asperities": asperities}
    return {}
