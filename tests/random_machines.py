"""Random bearings with all that belongs to a machine, in all joint, for tests by hypothesis."""

from hypothesis import strategies as st
from random_scenes import boundaries, metres, number, part, text


@st.composite
def machines(draw):
    """Tilting pads, shafts and pads with loads, oils, heat, supplies, bodies and speeds over time, in all joint."""
    length, film = draw(number(3e-3, 0.1)), draw(number(2e-6, 1e-4))
    shape = draw(st.sampled_from(["pivoted", "pivoted", "pivoted_sector", "lobes", "journal", "linear", "parallel"]))
    shaft = shape in ("lobes", "journal")
    speed = draw(number(1e-2, 30)) * draw(st.sampled_from([1, 1, 1, -1])) if not shaft else draw(number(1e-2, 30))
    entries = {
        "name": "a machine",
        "kind": "bearing",
        "geometry": {"shape": shape, **_MACHINES[shape](draw, length, film)},
        "lubricant": draw(_oils()),
        "motion": {"speed": f"{speed!r} m/s"},
    }
    wide = not shaft and shape != "pivoted_sector" and draw(st.integers(0, 3)) == 0
    if not wide and shape != "pivoted_sector":
        entries["geometry"]["width"] = f"{length * draw(number(0.2, 5))!r} m"
    scale = 0.03 * abs(speed) * length / film**2
    pressure = min(scale * draw(number(1e-3, 3)), 5e8)
    if shape not in ("linear", "parallel") or draw(st.booleans()):
        entries["load"] = {"pressure": f"{pressure!r} Pa"}
        entries["geometry"].pop("film", None)
        entries["geometry"].pop("eccentricity", None)
        if shaft and draw(st.booleans()):
            entries["load"]["angle"] = f"{draw(part(-180, 180))!r} deg"
        if shape == "pivoted" and not wide and draw(st.integers(0, 3)) == 0:
            entries["load"]["moment_y"] = f"{0.02 * draw(part(-1, 1)) * pressure * length**3!r} N*m"
    if draw(st.integers(0, 2)) == 0:
        entries["supply"] = draw(_supplies(shape, length, wide))
    if "oil" in entries["lubricant"] and draw(st.booleans()):
        entries["heat"] = draw(_heat())
    if "load" in entries and draw(st.integers(0, 2)) == 0:
        entries["body"] = {"mass": f"{draw(number(1e-3, 1e3))!r} kg"}
        if shape == "pivoted" and draw(st.booleans()):
            entries["body"]["inertia"] = f"{draw(number(1e-8, 1e-1))!r} kg*m^2"
        if shaft and draw(st.booleans()):
            entries["body"]["unbalance"] = f"{draw(number(1e-6, 1e-2))!r} kg*m"
    if not shaft and draw(st.integers(0, 3)) == 0:
        entries["boundary"] = draw(boundaries(wide))
    if draw(st.integers(0, 3)) == 0:
        period = draw(number(1e-4, 1.0))
        times = [f"{place * period / 4!r} s" for place in range(4)]
        entries["motion"]["over_time"] = {"time": times, "period": f"{period!r} s"}
        entries["motion"]["over_time"]["speed"] = [f"{speed * draw(part(-1, 1.5))!r} m/s" for _ in times]
    return entries


def _machine_lobes(draw, length, film):
    count = draw(st.integers(1, 4))
    geometry = metres(radius=length / 2, clearance=film) | {"lobes": count, "preload": draw(part(0.0, 0.6))}
    if draw(st.booleans()):
        geometry["arc"] = f"{360 / count * draw(part(0.4, 0.95))!r} deg"
        if draw(st.booleans()):
            geometry["pivot"] = draw(part(0.4, 0.6))
    return geometry


def _pivot(draw):
    """A pivot over the length, or over both sides, as a point or a line; crowned or flat."""
    along = draw(part(0.45, 0.75))
    geometry = {"pivot": draw(st.sampled_from([along, [along, 0.5], [along, draw(part(0.4, 0.6))]]))}
    if draw(st.integers(0, 3)) == 0:
        geometry["line"] = True
    return geometry


def _crowned(draw, film):
    return metres(crown=film * draw(number(1e-2, 2))) if draw(st.integers(0, 2)) == 0 else {}


_MACHINES = {
    "pivoted": lambda draw, length, film: metres(length=length) | _pivot(draw) | _crowned(draw, film),
    "pivoted_sector": lambda draw, length, film: (
        metres(inner_radius=length, outer_radius=length * draw(part(1.2, 3.0)))
        | {"angle": f"{draw(part(10, 90))!r} deg"}
        | _pivot(draw)
        | _crowned(draw, film)
    ),
    "lobes": _machine_lobes,
    "journal": lambda draw, length, film: (
        metres(radius=length / 2, clearance=film) | {"eccentricity": draw(part(0.0, 0.9))}
    ),
    "linear": lambda draw, length, film: metres(length=length, film=film, rise=film * draw(number(0.1, 5))),
    "parallel": lambda _draw, length, film: metres(length=length, film=film),
}


@st.composite
def _oils(draw):
    """A library oil at a temperature, or a viscosity alone."""
    if draw(st.booleans()):
        lubricant = {"oil": draw(st.sampled_from(["ISO VG 10", "ISO VG 32", "ISO VG 46", "ISO VG 100", "ISO VG 460"]))}
        lubricant["temperature"] = f"{draw(part(20, 80))!r} degC"
    else:
        lubricant = {"viscosity": draw(text(number(1e-3, 0.3), "Pa*s")), "density": "860 kg/m^3"}
    return lubricant | {"cavitation_pressure": draw(st.sampled_from(["0 Pa", "-0.1 MPa", "-50 kPa"]))}


@st.composite
def _heat(draw):
    """Walls that take no heat, or some, and heat that goes round with the lubricant."""
    heat = draw(st.fixed_dictionaries({}, optional={"carried_over": part(0.0, 0.9)}))
    if draw(st.booleans()):
        heat["sliding_wall"] = "turning"
    if draw(st.booleans()):
        heat["fixed_wall"] = {
            "kind": "conducting",
            "thickness": draw(text(number(1e-3, 5e-2), "m")),
            "conductivity": draw(text(number(0.2, 100), "W/(m*K)")),
            "heat_transfer": draw(text(number(5, 1e4), "W/(m^2*K)")),
            "surroundings": f"{draw(part(0, 60))!r} degC",
        }
    return heat


@st.composite
def _supplies(draw, shape, length, wide):
    """A pocket, a groove or a hole, fed by a pressure through nothing, a capillary or an orifice, or by a flow."""
    supply = {"kind": draw(st.sampled_from(["pocket", "groove", "hole"]))}
    supply["pressure"] = draw(text(number(1e4, 1e7), "Pa"))
    if shape in ("lobes", "journal", "pivoted_sector"):
        supply["angle"] = f"{draw(part(-170, 170))!r} deg"
    else:
        supply["x"] = f"{length * draw(part(0.3, 0.7))!r} m"
    if supply["kind"] == "hole":
        supply["diameter"] = f"{length * draw(part(0.02, 0.2))!r} m"
    else:
        supply["length"] = f"{length * draw(part(0.05, 0.5))!r} m"
        if not wide:
            supply["extent"] = f"{length * draw(part(0.02, 0.5))!r} m"
        if supply["kind"] == "pocket":
            supply["depth"] = "1 mm"
    feed = draw(st.sampled_from(["pressure", "capillary", "orifice", "flow"]))
    if feed == "capillary":
        supply["capillary"] = {"diameter": draw(text(number(1e-4, 2e-3), "m")), "length": "30 mm"}
    if feed == "orifice":
        supply["orifice"] = {"diameter": draw(text(number(1e-4, 2e-3), "m"))}
    if feed == "flow":
        del supply["pressure"]
        supply["flow"] = draw(text(number(1e-9, 1e-4), "m^2/s" if wide else "m^3/s"))
    return [supply]
