"""Random valid scenes of every kind, as entries of their files, for tests by hypothesis."""

import atexit
import shutil
import tempfile
from pathlib import Path

import numpy as np
from hypothesis import strategies as st

FILES = Path(tempfile.mkdtemp(prefix="roughfilm-scenes-"))
"""Where the surfaces and tables that scenes name are written; removed at the end."""

atexit.register(shutil.rmtree, FILES, ignore_errors=True)

POINTS = (8, 9, 12, 16, 17, 24, 32)
"""Along a side of random surfaces."""


def number(low, high, digits=3):
    """Any number in between, each order of magnitude as likely, in so many digits."""
    return st.floats(np.log10(low), np.log10(high)).map(
        lambda power: min(max(float(f"{10**power:.{digits}g}"), low), high)
    )


def text(strategy, unit):
    return strategy.map(lambda value: f"{value!r} {unit}")


def part(low, high):
    return st.floats(low, high).map(lambda value: round(value, 3))


@st.composite
def pockets(draw):
    """Grooves of every profile, one or several that do not overlap, shallow to deep, in slow to fast films."""
    length = draw(number(1e-4, 1e-2))
    film = length * draw(number(1e-3, 0.3))
    count = draw(st.integers(1, 3))
    room = length / count
    grooves = [_groove(draw, film, room, -length / 2 + (number_ + 0.5) * room) for number_ in range(count)]
    return {
        "name": "a pocket",
        "kind": "pocket",
        "geometry": {"length": f"{length!r} m", "film": f"{film!r} m", "grooves": grooves},
        "lubricant": {
            "viscosity": draw(text(number(1e-3, 1.0), "Pa*s")),
            "density": draw(text(number(500, 2000), "kg/m^3")),
        },
        "motion": draw(
            st.fixed_dictionaries({"reynolds_number": number(1e-3, 3e3)})
            | st.fixed_dictionaries({"speed": text(number(1e-3, 10), "m/s")})
        ),
    }


def _groove(draw, film, room, middle):
    profile = draw(st.sampled_from(["cylindrical", "splined", "points"]))
    width = room * draw(part(0.1, 0.95))
    depth = film * draw(number(1e-3, 3))
    position = middle + (room - width) / 2 * draw(part(-0.99, 0.99))
    common = {"profile": profile, "position": f"{position!r} m"}
    if profile == "points":
        inner = draw(st.lists(st.tuples(part(0.05, 0.95), part(0.0, 1.0)), min_size=1, max_size=4))
        inner = sorted(dict(inner).items())
        rows = [(0.0, 0.0), *inner, (1.0, 0.0)]
        return common | {"points": [[(place - 0.5) * width, deep * depth] for place, deep in rows]}
    depth = min(depth, width / 2)
    entries = common | {"width": f"{width!r} m", "depth": f"{depth!r} m"}
    return entries | ({"shift": f"{width * draw(part(-0.45, 0.45))!r} m"} if profile == "splined" else {})


def mirrored(entries):
    """The pocket with x turned round; the wall slides as before."""
    geometry = entries["geometry"]
    grooves = []
    for groove in geometry["grooves"]:
        turned = dict(groove)
        for key in {"position", "shift"} & groove.keys():
            turned[key] = f"{-float(groove[key].removesuffix(' m'))!r} m"
        if "points" in groove:
            turned["points"] = [[-place, deep] for place, deep in reversed(groove["points"])]
        grooves.append(turned)
    return entries | {"geometry": geometry | {"grooves": grooves}}


@st.composite
def surfaces(draw, size=None, files=True):
    """The keys of a rough wall: a described surface of any kind, or heights in a file; its rms height is the second."""
    size = size or (draw(number(1e-5, 1e-2)), draw(number(1e-5, 1e-2)))
    points = (draw(st.sampled_from(POINTS)), draw(st.sampled_from(POINTS)))
    steps = [side / count for side, count in zip(size, points, strict=True)]
    rms = min(size) * draw(number(1e-4, 0.03))
    seed = draw(st.integers(2, 10**6))
    entries = {"size": [f"{side!r} m" for side in size], "points": list(points)}
    kinds = ["self_affine", "gaussian", "sinusoid", "milled", "plateau_honed"] + ["file"] * files
    kind = draw(st.sampled_from(kinds))
    if kind == "file":
        return {
            "surface": written(_heights(draw, points, seed) * rms),
            "spacing": [f"{step!r} m" for step in steps],
        }, rms
    if kind == "sinusoid":
        wave = {"amplitude": f"{rms * 2**0.5!r} m", "combination": draw(st.sampled_from(["product", "sum"]))}
        for axis, key in enumerate(("wavelength_x", "wavelength_y")):
            if axis == 0 or draw(st.booleans()):
                wave[key] = f"{size[axis] / draw(st.integers(1, max(1, points[axis] // 4)))!r} m"
        entries |= wave
    elif kind == "self_affine":
        cut_off = 2.01 * max(steps) * draw(part(1.0, 1.5))
        entries |= {
            "seed": seed,
            "hurst": draw(part(0.1, 1.0)),
            "roll_off": f"{max(cut_off * 1.01, min(size) * draw(part(0.3, 1.0)))!r} m",
            "cut_off": f"{cut_off!r} m",
            "rms_height": f"{rms!r} m",
        }
    elif kind == "gaussian":
        entries |= {
            "seed": seed,
            "rms_height": f"{rms!r} m",
            "correlation_length": f"{2.01 * max(steps) * draw(part(1.0, 1.5))!r} m",
            "anisotropy": draw(part(0.5, 2.0)),
            "lay_angle": f"{draw(part(0, 180))!r} deg",
        }
    elif kind == "milled":
        entries |= {"radius": f"{size[0] * draw(part(1.0, 5.0))!r} m"}
        entries |= {"feed": f"{size[0] / draw(st.integers(1, 3))!r} m"}
        entries |= {"depth": f"{3 * rms!r} m"}
    else:
        entries |= {
            "seed": seed,
            "plateau_rms_height": f"{rms / 3!r} m",
            "plateau_correlation_length": f"{2.2 * max(steps)!r} m",
            "valley_rms_height": f"{2 * rms!r} m",
            "valley_correlation_length": f"{2.5 * max(steps)!r} m",
            "material_ratio": draw(part(0.3, 0.95)),
        }
    return {"surface": {"kind": kind, **entries}}, rms


def _heights(draw, points, seed):
    """What measured files may hold: noise, steps, ridges one pixel wide, a spike, a flat."""
    noise = np.random.default_rng(seed).standard_normal(points)
    i, j = np.indices(points)
    return {
        "noise": noise,
        "plateaus": np.minimum(noise, 0.0),
        "ridges across": np.where(i % 2, 1.0, -1.0) + 0.0 * noise,
        "ridges along": np.where(j % 2, 1.0, -1.0),
        "checkerboard": np.where((i + j) % 2, 1.0, -1.0),
        "spike": np.where((i == 3) & (j == 5), 10.0, 0.0),
        "terraces": np.floor(2 * noise),
        "lines": np.broadcast_to(noise[:, :1], points),
        "flat": np.zeros(points),
    }[
        draw(
            st.sampled_from(
                [
                    "noise",
                    "plateaus",
                    "ridges across",
                    "ridges along",
                    "checkerboard",
                    "spike",
                    "terraces",
                    "lines",
                    "flat",
                ]
            )
        )
    ]


def written(heights):
    """The file of these heights."""
    heights = np.ascontiguousarray(heights, dtype=float)
    path = FILES / f"{abs(hash((heights.shape, heights.tobytes()))):x}.npy"
    if not path.exists():
        np.save(path, heights)
    return str(path)


def _solid(draw):
    modulus = draw(number(1e6, 1e12))
    solid = {"modulus": f"{modulus!r} Pa", "poisson": draw(part(0.0, 0.5))}
    hardness = draw(st.none() | number(1e-4, 1.0))
    return (solid if hardness is None else solid | {"hardness": f"{hardness * modulus!r} Pa"}), modulus, hardness


@st.composite
def dry_contacts(draw):
    """Any surface, from a touch to full contact."""
    geometry, _ = draw(surfaces())
    solid, modulus, hardness = _solid(draw)
    load = modulus * draw(number(1e-6, 0.3)) if hardness is None else modulus * hardness * draw(number(1e-4, 1.0))
    entries = {
        "name": "a contact",
        "kind": "dry_contact",
        "geometry": geometry,
        "solid": solid,
        "load": {"pressure": f"{load!r} Pa"},
    }
    if draw(st.booleans()):
        entries["counter"] = {"modulus": f"{modulus * draw(number(0.1, 10))!r} Pa", "poisson": 0.3}
    return entries


@st.composite
def seals(draw):
    """The same, with a liquid."""
    return draw(dry_contacts()) | {
        "kind": "seal",
        "liquid": {"density": "900 kg/m^3", "viscosity": draw(text(number(1e-3, 1), "Pa*s"))},
        "flow": {
            "pressure_drop": draw(text(number(1e3, 1e7), "Pa")),
            "length": draw(text(number(1e-5, 1e-2), "m")),
            "direction": draw(st.sampled_from(["x", "y"])),
        },
    }


@st.composite
def rough_gaps(draw):
    """Ridges, one rough wall or two, apart or pressed together."""
    size = (draw(number(1e-5, 1e-3)), draw(number(1e-5, 1e-3)))
    case = draw(st.sampled_from(["sinusoid", "one wall", "two walls", "pressed"]))
    entries = {"name": "a gap", "kind": "rough_gap"}
    if case == "sinusoid":
        rms = size[0] * draw(number(1e-4, 0.1))
        geometry = {"surface": "sinusoid", "amplitude": f"{rms * 2**0.5!r} m", "wavelength": f"{size[0]!r} m"}
    else:
        geometry, rms = draw(surfaces(size, files=case == "pressed"))
    if case == "two walls":
        other, second = draw(surfaces(size, files=False))
        other["surface"]["points"] = geometry["surface"]["points"]
        geometry, rms = geometry | {"upper": other}, rms + second
    if case == "pressed":
        entries["solid"], modulus, hardness = _solid(draw)
        load = modulus * (draw(number(1e-6, 0.1)) if hardness is None else hardness * draw(number(1e-4, 1.0)))
        entries["load"] = {"pressure": f"{load!r} Pa"}
    else:
        geometry["mean_gap"] = f"{rms * draw(number(1.0, 30))!r} m"
    return entries | {
        "geometry": geometry,
        "lubricant": {"viscosity": draw(text(number(1e-3, 1), "Pa*s")), "density": "870 kg/m^3"},
        "flow": {"reynolds_number": draw(number(1e-6, 100))},
    }


@st.composite
def bearings(draw):
    """Every shape, wide or not, flooded, starved or pressurised, any law, texture, roughness, asperities, backwards."""
    length, film = draw(number(1e-3, 0.1)), draw(number(1e-6, 1e-4))
    rise = film * draw(number(0.01, 10))
    shape = draw(st.sampled_from(list(_SHAPES)))
    geometry = {"shape": shape, **_SHAPES[shape](draw, length, film, rise)}
    wide = shape not in ("sector", "washer") and draw(st.booleans()) and shape != "given"
    wide &= shape != "lobes" or "arc" in geometry
    ring = shape in ("sector", "washer")
    if not wide and not ring:
        geometry["width"] = f"{length * draw(number(0.1, 10))!r} m"
    if not ring and shape != "lobes" and draw(st.integers(0, 3)) == 0:
        geometry["texture"] = _texture(draw, length, film, None if wide else float(geometry["width"].split()[0]))
    speed = draw(st.just(0.0) | number(1e-3, 30) | number(1e-3, 30).map(lambda value: -value))
    entries = {
        "name": "a bearing",
        "kind": "bearing",
        "geometry": geometry,
        "lubricant": _lubricant(draw),
        "motion": {"speed": f"{speed!r} m/s"},
    }
    if shape == "lobes":
        _shaft(draw, entries, speed, wide)
    elif not (shape == "washer" or geometry.get("joined")):
        entries["boundary"] = draw(boundaries(wide))
    elif entries["lubricant"].get("cavitation_pressure") == "0.0 Pa":
        entries["boundary"] = {"sides": {"low": "1e5 Pa", "high": "1e5 Pa"}}
    kind = draw(st.sampled_from(["smooth", "sinusoid", "surface", "surface"]))
    if kind == "sinusoid":
        entries["roughness"] = {
            "kind": "sinusoid",
            "amplitude": f"{film * draw(part(0.01, 0.95))!r} m",
            "wavelength": f"{length * draw(number(0.02, 1))!r} m",
            "direction": f"{draw(st.sampled_from([0, 90, 30.0, 45, -60]))!r} deg",
        }
    if kind == "surface":
        side = length * draw(number(0.1, 0.5))
        rough, rms = draw(surfaces((side, side * draw(part(0.5, 2.0))), files=False))
        entries["roughness"] = {"kind": "surface", **rough, "scale": film / rms * draw(number(0.01, 1.0))}
        if draw(st.booleans()):
            entries["asperities"] = {"friction": draw(part(0.0, 0.5)), "solid": _solid(draw)[0]}
    return entries


def metres(**lengths):
    return {key: f"{value!r} m" for key, value in lengths.items()}


def _journal(draw, length, film, _rise):
    eccentricity = draw(part(0.0, 0.95))
    return {**metres(radius=length / 6, clearance=film / (1 - eccentricity)), "eccentricity": eccentricity}


def _lobes(draw, length, film, _rise):
    count = draw(st.integers(1, 5))
    whole = draw(st.booleans())
    geometry = metres(radius=length / 6, clearance=film) | {"lobes": count, "preload": draw(part(0.0, 0.7))}
    geometry |= {"first": f"{draw(part(-180, 180))!r} deg", "offset": draw(part(0.0, 1.0))}
    if not whole:
        geometry["arc"] = f"{360 / count * draw(part(0.3, 0.95))!r} deg"
        if draw(st.booleans()):
            geometry["pivot"] = draw(part(0.35, 0.65))
    return geometry


def _shaft(draw, entries, speed, wide):
    """Put a shaft in lobes at a place, or under a load from small to hardly carried; feed it."""
    geometry, oil = entries["geometry"], entries["lubricant"]
    if speed and draw(st.booleans()):
        radius, clearance = (float(geometry[key].split()[0]) for key in ("radius", "clearance"))
        scale = float(oil["viscosity"].split()[0]) * abs(speed) * radius / clearance**2
        entries["load"] = {
            "angle": f"{draw(part(-180, 180))!r} deg",
            "pressure": f"{scale * draw(number(0.01, 3))!r} Pa",
        }
    else:
        room, turned = 1 - geometry["preload"], draw(part(0.0, 6.283))
        size = room * draw(part(0.0, 0.95))
        geometry["eccentricity"] = [float(size * np.cos(turned)), float(size * np.sin(turned))]
    if not wide and draw(st.integers(0, 3)) == 0:
        slope = 0.3 * float(geometry["clearance"].split()[0]) / float(geometry["width"].split()[0])
        geometry["misalignment"] = [f"{slope * draw(part(-1.0, 1.0))!r} rad" for _ in range(2)]
    if "arc" in geometry and geometry["lobes"] > 1:
        boundary = draw(boundaries(wide))
        if boundary["inlet"].get("theta", 1.0) >= 1:
            entries["boundary"] = {key: one for key, one in boundary.items() if key != "outlet"}
    elif "arc" in geometry:
        entries["boundary"] = draw(boundaries(wide))
    elif oil["cavitation_pressure"] == "0.0 Pa":
        entries["boundary"] = {"sides": {"low": "1e5 Pa", "high": "1e5 Pa"}}


def _sector(draw, length, film, rise):
    inner = length * draw(number(0.3, 3))
    return {
        **metres(inner_radius=inner, outer_radius=inner + length * draw(number(0.1, 1)), film=film, rise=rise),
        "angle": f"{draw(part(5, 120))!r} deg",
        "taper": draw(part(0.1, 1.0)),
        "joined": draw(st.booleans()),
    }


def _washer(draw, length, film, rise):
    inner, outer = length * 0.5, length * draw(part(0.6, 1.5))
    entries = {**metres(inner_radius=inner, outer_radius=outer, film=film), "pockets": draw(st.integers(1, 12))}
    if draw(st.booleans()):
        start = draw(part(0.0, 0.5))
        pocket = {**metres(depth=rise, extent=(outer - inner) * draw(part(0.1, 1.0)))}
        entries["pocket"] = pocket | {"start": start, "share": draw(part(0.05, round(1 - start, 3)))}
    return entries


def _wavy(draw, length, film, _rise):
    part_ = draw(part(0.05, 0.9))
    entries = metres(length=length, film=film, amplitude=film * part_, wavelength=length * draw(number(0.1, 1)))
    return entries | (metres(extent=length * draw(part(0.1, 1.0))) if draw(st.booleans()) else {})


def _given(draw, length, film, rise):
    points = (draw(st.integers(2, 9)), draw(st.integers(2, 9)))
    heights = np.random.default_rng(draw(st.integers(2, 10**6))).uniform(0, rise, points)
    return {**metres(length=length, film=film), "thickness": written(heights)}


_SHAPES = {
    "parallel": lambda _draw, length, film, _rise: metres(length=length, film=film),
    "linear": lambda _draw, length, film, rise: metres(length=length, film=film, rise=rise),
    "step": lambda draw, length, film, rise: metres(
        length=length, film=film, rise=rise, step=length * draw(part(0.05, 0.95))
    ),
    "parabolic": lambda draw, length, film, rise: (
        metres(length=length, film=film, rise=rise) | {"count": draw(st.integers(1, 3))}
    ),
    "sinusoidal_inlet": _wavy,
    "squared_cosine_inlet": _wavy,
    "given": _given,
    "journal": _journal,
    "lobes": _lobes,
    "sector": _sector,
    "washer": _washer,
}


def _texture(draw, length, film, width):
    columns = draw(st.integers(1, 4))
    pitch = length / columns
    long = pitch * draw(part(0.1, 0.95))
    entries = metres(length=long, depth=min(film * draw(number(0.01, 10)), long), start=0.0, pitch=pitch)
    entries |= {"columns": columns, "profile": draw(st.sampled_from(["box", "cylindrical"]))}
    if width is not None and draw(st.booleans()):
        rows = draw(st.integers(1, 3))
        entries |= metres(width=width / rows * draw(part(0.1, 0.95)), pitch_across=width / rows) | {"rows": rows}
        entries["profile"] = draw(st.sampled_from(["box", "cylindrical", "ellipsoidal"]))
    return entries


def _lubricant(draw):
    entries = {"viscosity": draw(text(number(1e-3, 0.5), "Pa*s"))}
    entries["cavitation_pressure"] = f"{draw(st.sampled_from([0.0, -1e5, -2e4]))!r} Pa"
    beta = draw(number(1e7, 1e11))
    law = draw(st.sampled_from(["incompressible", "constant_bulk_modulus", "dowson_higginson", "tabulated"]))
    entries["compressibility"] = {"law": law}
    if law == "constant_bulk_modulus":
        entries["compressibility"] |= {"bulk_modulus": f"{beta!r} Pa"}
    if law == "dowson_higginson" and draw(st.booleans()):
        entries["compressibility"] |= {"c1": f"{beta!r} Pa", "c2": draw(part(1.05, 2.0))}
    if law == "tabulated":
        table = [[place * beta / 10, 1000 * (1 + 0.3 * place / (3 + place))] for place in (0.0, 1.0, 3.0, 10.0)]
        entries["compressibility"] |= {"table": table} | ({"fit": "dowson_higginson"} if draw(st.booleans()) else {})
    viscous = draw(st.sampled_from(["constant", "constant", "barus", "roelands"]))
    entries["piezoviscosity"] = {"law": viscous}
    if viscous == "barus":
        entries["piezoviscosity"] |= {"pressure_coefficient": f"{draw(number(1e-10, 1e-7))!r} Pa^-1"}
    if viscous == "roelands":
        entries["piezoviscosity"] |= {"index": draw(part(0.1, 1.0))}
    return entries


def boundaries(wide):
    pressure = text(number(1e3, 1e7), "Pa") | st.just("0 Pa")
    inlet = (
        st.just({})
        | st.fixed_dictionaries({"theta": part(0.05, 1.0)})
        | st.fixed_dictionaries({"theta": part(1.0, 1.01)})
        | st.fixed_dictionaries({"pressure": pressure})
    )
    entries = {"inlet": inlet, "outlet": st.just({}) | st.fixed_dictionaries({"pressure": pressure})}
    if not wide:
        entries["sides"] = st.just({}) | st.fixed_dictionaries({"low": pressure, "high": pressure})
    return st.fixed_dictionaries(entries)
