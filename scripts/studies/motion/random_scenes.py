"""Random bearings whose walls move freely: full bores, arcs, lobes, tilting pads, and pads about a pivot."""

import math
import zlib
from collections.abc import Callable, Mapping

import numpy as np
from numpy.random import Generator

from roughfilm.contact.foundation.units import with_unit
from roughfilm.rom.bearing.scene import Bearing
from roughfilm.rom.ladder.scene import read_scene
from scripts.studies.coverage.random_entries import Entries, between

RADIUS, VISCOSITY = 0.05, 0.02
"""Radius of the shafts, m, and viscosity of the lubricant, Pa s. Films depend on ratios alone."""

PAD = 0.04
"""Length of the pads, m."""


def drawn(kind: str, seed: int) -> Bearing:
    """Return the random bearing of a kind and a seed.

    Parameters
    ----------
    kind : one of ``KINDS``.

    Raises
    ------
    InputError
        If the entries that were drawn do not make a bearing, such as supplies that meet.
    """
    return _bearing(KINDS[kind](_generator(kind, seed)))


def drawn_with_heat(kind: str, seed: int, *, replaced: bool = True) -> Bearing:
    """Return the random bearing of a kind and a seed whose lubricant heats, between random walls.

    Parameters
    ----------
    kind : one of ``HEATED``.
    replaced : whether new lubricant may replace hot one behind gaps and grooves; `across` takes that behind gaps alone.

    Raises
    ------
    InputError
        If the entries that were drawn do not make a bearing.
    """
    rng = _generator(kind, seed)
    entries = HEATED[kind](rng)
    lubricant = entries["lubricant"] | {
        "density": "870 kg/m^3",
        "temperature": "40 degC",
        "heat_capacity": "1950 J/(kg*K)",
        "conductivity": "0.14 W/(m*K)",
        "thermoviscosity": {
            "law": "exponential",
            "temperature_coefficient": with_unit(between(rng, 0.01, 0.06), "1/K"),
        },
    }
    given = {"kind": "temperature", "temperature": with_unit(float(rng.uniform(30, 60)), "degC")}
    conducting = {"kind": "conducting", "heat_transfer": with_unit(between(rng, 100, 10000), "W/(m^2*K)")}
    shaft = entries["geometry"]["shape"] in ("lobes", "journal")
    sliding = ["adiabatic", given, "turning"] if shaft else ["adiabatic", given]
    fixed = ["adiabatic", given, conducting]
    walls = {
        "sliding_wall": sliding[int(rng.integers(len(sliding)))],
        "fixed_wall": fixed[int(rng.integers(len(fixed)))],
    }
    carried_over = 1.0 if rng.uniform() < 0.5 else float(rng.uniform(0.5, 1))
    heat = walls | ({"carried_over": carried_over} if replaced else {})
    return _bearing(entries | {"lubricant": lubricant, "heat": heat})


def drawn_in_time(kind: str, seed: int) -> tuple[Bearing, float]:
    """Return the random bearing of a kind and a seed with a motion, and the time, s, at which its march ends.

    A load that repeats, an unbalance, or a load that jumps, with or without mass.

    Parameters
    ----------
    kind : one of ``IN_TIME``.

    Raises
    ------
    InputError
        If the entries that were drawn do not make a bearing.
    """
    rng = _generator(kind, seed)
    entries = KINDS[kind](rng)
    bearing = _bearing(entries)
    turn = bearing.geometry.length / abs(bearing.motion.speed)
    assert bearing.load_pressure is not None
    size = bearing.load_pressure * bearing.nominal_area
    entries["load"] = {name: entry for name, entry in entries["load"].items() if not name.startswith("moment")}
    shaft = entries["geometry"]["shape"] == "lobes"
    stiff = size / (_number(entries["geometry"]["clearance"]) if shaft else 1e-3 * PAD)
    mass = stiff * (rng.uniform(0.05, 0.5) * turn / (2 * math.pi)) ** 2
    body: Entries = {"mass": with_unit(mass, "kg")} if rng.uniform() < 0.6 else {}
    motion = str(rng.choice(["period", "jump", "unbalance"] if shaft and body else ["period", "jump"]))
    if motion == "unbalance":
        speed = 2 * math.pi / turn
        body["unbalance"] = with_unit(rng.uniform(0.1, 0.8) * size / speed**2, "kg*m")
        end = 4 * turn
    elif motion == "period":
        end = _periodic(rng, entries, size, turn)
    else:
        after = size * rng.uniform(0.5, 2)
        times = [0.0, 0.5 * turn, 0.6 * turn, 6 * turn]
        _over_time(entries, times, {"load": [size, size, after, after]})
        end = times[-1]
    return _bearing(entries | ({"body": body} if body else {})), end


def _periodic(rng: Generator, entries: Entries, size: float, turn: float) -> float:
    """Add a load over time that repeats; returns the end of its third period, s."""
    period = turn * between(rng, 0.5, 4)
    times = np.linspace(0, period, 9)[:-1]
    waves = 1 + rng.uniform(0.1, 0.6) * np.sin(2 * np.pi * times / period + rng.uniform(0, 2 * np.pi))
    columns = {"load": (size * waves).tolist()}
    if entries["geometry"]["shape"] == "lobes":
        swing = math.radians(rng.uniform(0, 40)) * np.sin(4 * np.pi * times / period)
        toward = math.radians(float(entries["load"]["angle"].partition(" ")[0])) + swing
        columns = {
            "load_x": (size * waves * np.cos(toward)).tolist(),
            "load_y": (size * waves * np.sin(toward)).tolist(),
        }
    _over_time(entries, times.tolist(), columns)
    entries["motion"]["over_time"]["period"] = with_unit(period, "s")
    return 3 * period


def _over_time(entries: Entries, times: list[float], columns: Mapping[str, list[float]]) -> None:
    table: Entries = {"time": [with_unit(time, "s") for time in times]}
    table |= {name: [with_unit(value, "N") for value in values] for name, values in columns.items()}
    entries["motion"]["over_time"] = table


def _generator(kind: str, seed: int) -> Generator:
    return np.random.default_rng([zlib.crc32(kind.encode()), seed])


def _number(text: str) -> float:
    return float(text.partition(" ")[0])


def _bearing(entries: Entries) -> Bearing:
    scene = read_scene({"name": "random bearing", "kind": "bearing", **entries})
    assert isinstance(scene, Bearing)
    return scene


def _shaft(rng: Generator, geometry: Entries, *, misaligned: float, gauge: tuple[float, float]) -> Entries:
    """Return a shaft in a bore of given lobes under a random load.

    Parameters
    ----------
    misaligned : chance that the axis of the shaft is inclined.
    gauge : smallest and largest load over η u R/c² and the diameter times the width.
    """
    clearance, speed = RADIUS * between(rng, 5e-4, 2e-3), float(rng.uniform(5, 30))
    width = 2 * RADIUS * between(rng, 0.3, 1.2)
    lengths = {"radius": RADIUS, "clearance": clearance, "width": width}
    geometry = {"shape": "lobes", **{name: with_unit(one, "m") for name, one in lengths.items()}, **geometry}
    if rng.uniform() < misaligned:
        slope = rng.uniform(0, 0.5, 2) * clearance / width * rng.choice([-1, 1], 2)
        geometry["misalignment"] = [with_unit(float(one), "rad") for one in slope]
    lubricant: Entries = {"viscosity": with_unit(VISCOSITY, "Pa*s"), "density": "870 kg/m^3"}
    if rng.uniform() < 0.3:
        lubricant["cavitation_pressure"] = with_unit(-between(rng, 1e4, 1e5), "Pa")
    pressure = between(rng, *gauge) * VISCOSITY * speed * RADIUS / clearance**2
    return {
        "geometry": geometry,
        "lubricant": lubricant,
        "motion": {"speed": with_unit(speed * (1 if rng.uniform() < 0.8 else -1), "m/s")},
        "load": {"pressure": with_unit(pressure, "Pa"), "angle": with_unit(float(rng.uniform(-120, -60)), "deg")},
    }


def journal(rng: Generator) -> Entries:
    """Return a full bore with one to three grooves, holes or pockets, or with oil at both sides."""
    entries = _shaft(rng, {}, misaligned=0.4, gauge=(0.05, 3))
    width = _number(entries["geometry"]["width"])
    if rng.uniform() < 0.25:
        side = with_unit(between(rng, 0.05e6, 0.3e6), "Pa")
        return entries | {"boundary": {"sides": {"low": side, "high": side}}}
    count = int(rng.integers(1, 4))
    first = rng.uniform(20, 160)
    return entries | {
        "supply": [
            _supply(rng, width, first + number * 360 / count, 0.5 if count == 3 else 1.0) for number in range(count)
        ]
    }


def _supply(rng: Generator, width: float, angle: float, share: float) -> Entries:
    """Return a supply at an angle, deg, that is fed directly, by a given flow, or behind a restrictor."""
    kind = str(rng.choice(["groove", "hole", "pocket"]))
    supply: Entries = {"kind": kind, "angle": with_unit(angle, "deg")}
    if kind == "hole":
        supply["diameter"] = with_unit(min(0.3 * width, share * between(rng, 4e-3, 20e-3)), "m")
    else:
        supply["length"] = with_unit(share * RADIUS * rng.uniform(0.1, 0.6), "m")
        supply["extent"] = with_unit(width * rng.uniform(0.3, 0.8), "m")
    if kind == "pocket":
        supply["depth"] = "1 mm"
    feed = str(rng.choice(["pressure", "flow", "capillary", "orifice"], p=[0.55, 0.15, 0.15, 0.15]))
    if feed == "flow":
        return supply | {"flow": with_unit(between(rng, 1e-6, 3e-5), "m^3/s")}
    supply["pressure"] = with_unit(between(rng, 0.05e6, 1e6), "Pa")
    if feed == "capillary":
        supply["capillary"] = {"diameter": with_unit(rng.uniform(0.8e-3, 2e-3), "m"), "length": "40 mm"}
    if feed == "orifice":
        supply["orifice"] = {"diameter": with_unit(rng.uniform(0.4e-3, 1.5e-3), "m")}
    return supply


def arc(rng: Generator) -> Entries:
    """Return a partial arc of 70° to 200° whose load points at it."""
    geometry = {"lobes": 1, "arc": with_unit(float(rng.uniform(70, 200)), "deg")}
    return _shaft(rng, geometry, misaligned=0.3, gauge=(0.03, 3))


def lobes(rng: Generator) -> Entries:
    """Return two to four lobes with a preload and an offset, with gaps between them."""
    count = int(rng.integers(2, 5))
    geometry = {
        "lobes": count,
        "arc": with_unit(360 / count * rng.uniform(0.75, 0.95), "deg"),
        "first": with_unit(float(rng.uniform(-180, 180)), "deg"),
        "preload": float(rng.uniform(0, 0.7)),
        "offset": float(rng.choice([0.5, rng.uniform(0.5, 1.0)])),
    }
    return _shaft(rng, geometry, misaligned=0.2, gauge=(0.03, 2))


def tilting(rng: Generator) -> Entries:
    """Return three to five tilting pads, most of them with a preload."""
    count = int(rng.integers(3, 6))
    pivot = float(rng.choice([0.5, rng.uniform(0.52, 0.62)]))
    geometry = {
        "lobes": count,
        "arc": with_unit(360 / count * rng.uniform(0.7, 0.9), "deg"),
        "first": with_unit(float(rng.uniform(-180, 180)), "deg"),
        "preload": float(rng.uniform(0.1, 0.6)),
        "pivot": pivot,
        "offset": pivot,
    }
    return _shaft(rng, geometry, misaligned=0.0, gauge=(0.03, 1))


def pad(rng: Generator) -> Entries:
    """Return a pad about a pivot in equilibrium of force and moments."""
    width = PAD * between(rng, 0.4, 2)
    geometry: Entries = {"shape": "pivoted", "length": with_unit(PAD, "m"), "width": with_unit(width, "m")}
    return _pivoted(rng, geometry, PAD, width)


def sector(rng: Generator) -> Entries:
    """Return a sector of a thrust bearing that tilts about a pivot."""
    inner, angle = between(rng, 0.03, 0.1), float(rng.uniform(20, 60))
    outer = inner * rng.uniform(1.4, 2.2)
    geometry: Entries = {
        "shape": "pivoted_sector",
        "inner_radius": with_unit(inner, "m"),
        "outer_radius": with_unit(outer, "m"),
        "angle": with_unit(angle, "deg"),
        "pads": max(3, int(320 / angle)),
    }
    return _pivoted(rng, geometry, math.radians(angle) * (inner + outer) / 2, outer - inner)


def _pivoted(rng: Generator, geometry: Entries, length: float, width: float) -> Entries:
    """Return a pad about a pivot under a load whose film is about 3·10⁻⁴ to 2·10⁻³ of its length."""
    crown = rng.uniform() < 0.3
    line = bool(rng.uniform() < 0.3)
    along, across = float(rng.uniform(0.52, 0.66)), 0.5 if line else float(rng.uniform(0.46, 0.54))
    geometry |= {"pivot": [along, across], "line": line}
    speed, film = float(rng.uniform(3, 30)), length * between(rng, 3e-4, 2e-3)
    if crown:
        geometry["crown"] = with_unit(film * rng.uniform(0.05, 0.6), "m")
    share = 1 / (1 + (length / width) ** 2)
    pressure = 0.16 * share * VISCOSITY * speed * length / film**2
    load: Entries = {"pressure": with_unit(pressure, "Pa")}
    if rng.uniform() < 0.3:
        moment = pressure * length * width * length * rng.uniform(-0.02, 0.02)
        load["moment_y"] = with_unit(float(moment), "N*m")
    return {
        "geometry": geometry,
        "lubricant": {"viscosity": with_unit(VISCOSITY, "Pa*s")},
        "motion": {"speed": with_unit(speed, "m/s")},
        "load": load,
    }


def given_pad(rng: Generator) -> Entries:
    """Return a linear pad at a given film, between 2·10⁻⁴ and 10⁻³ of its length."""
    film = PAD * between(rng, 2e-4, 1e-3)
    lengths = {"length": PAD, "width": PAD * between(rng, 0.4, 2), "film": film, "rise": film * rng.uniform(0.3, 2)}
    return {
        "geometry": {"shape": "linear", **{name: with_unit(float(one), "m") for name, one in lengths.items()}},
        "lubricant": {"viscosity": with_unit(VISCOSITY, "Pa*s")},
        "motion": {"speed": with_unit(float(rng.uniform(3, 30)), "m/s")},
    }


def given_journal(rng: Generator) -> Entries:
    """Return a full bore with an inlet at its widest gap, at a given eccentricity."""
    lengths = {"radius": RADIUS, "clearance": RADIUS * between(rng, 5e-4, 2e-3)}
    lengths["width"] = 2 * RADIUS * between(rng, 0.3, 1.2)
    geometry = {name: with_unit(float(one), "m") for name, one in lengths.items()}
    return {
        "geometry": {"shape": "journal", **geometry, "eccentricity": float(rng.uniform(0.1, 0.9))},
        "lubricant": {"viscosity": with_unit(VISCOSITY, "Pa*s")},
        "motion": {"speed": with_unit(float(rng.uniform(5, 30)), "m/s")},
    }


KINDS: Mapping[str, Callable[[Generator], Entries]] = {
    "journal": journal,
    "arc": arc,
    "lobes": lobes,
    "tilting": tilting,
    "pad": pad,
    "sector": sector,
}
"""Kinds of bearings by name."""

IN_TIME = ("journal", "arc", "lobes", "pad", "sector")
"""Kinds that are marched."""

GIVEN: Mapping[str, Callable[[Generator], Entries]] = {"given_pad": given_pad, "given_journal": given_journal}
"""Kinds of bearings at a given film, whose load follows."""

HEATED: Mapping[str, Callable[[Generator], Entries]] = {**KINDS, **GIVEN}
"""Kinds of bearings that are solved with temperatures."""
