"""Random valid scenes put to every model: an answer that keeps its kind's laws, or one of our errors, in its time."""

import signal
from contextlib import contextmanager

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, note, reject, settings
from random_machines import machines
from random_scenes import bearings, dry_contacts, mirrored, number, pockets, rough_gaps, seals, written

from roughfilm.contact.foundation.errors import ConvergenceError, InputError, UnavailableError
from roughfilm.interface.motion import march
from roughfilm.ladder import find, models
from roughfilm.rom.ladder.request import Request
from roughfilm.rom.ladder.scene import read_scene, scene_entries
from roughfilm.stability.checks.invariants import broken

OURS = (InputError, ConvergenceError, UnavailableError)

SCENES = {
    "machine": machines(),
    "pocket": pockets(),
    "bearing": bearings(),
    "dry_contact": dry_contacts(),
    "seal": seals(),
    "rough_gap": rough_gaps(),
}

COLUMNS, CELLS = 50, {True: 64, False: 32}
"""Of the films over a groove; of a bearing that is solved along a line, and of others."""

MESH = {"pocket": 30, "rough_gap": 16}
"""Columns of OpenFOAM's meshes."""

LIMIT, TIMES = 60.0, 50.0
"""CPU seconds that an answer may take, with what is compiled on the way, or so many times what is stated: no hang."""


def examples(count):
    """So many by default, in proportion with another profile: pytest --hypothesis-profile=long."""
    whole = settings.default.max_examples
    return settings(max_examples=max(1, count * whole // 100), deadline=None, suppress_health_check=list(HealthCheck))


def rungs(kind):
    return [model for model in models(kind) if not model.outside]


def resolution(model, scene):
    if model.outside:
        return MESH[model.kind]
    if model.kind == "bearing":
        return CELLS[scene.wide or model.name == "infinitely_wide"]
    return COLUMNS if model.name.startswith("film") else None


@contextmanager
def in_time(seconds):
    """Stops what takes more CPU time than that."""

    def stop(*_):
        raise TimeoutError(f"more than {seconds:.3g} s of CPU time")

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def solved(model, scene):
    """An answer, or None where one of our errors says in one line why there is none."""
    try:
        fits = model.applies(scene)
    except OURS as error:  # no film carries the load
        lines = str(error).splitlines()
        fits = None
    if fits is None:
        assert len(lines) == 1, lines
        return None
    assert fits.reason
    at = resolution(model, scene)
    cost = model.cost(scene, at or model.resolution_of(scene))
    assert 0 < cost < np.inf
    with in_time(max(LIMIT, TIMES * cost)):
        try:
            result = model.solve(scene, Request(resolution=at))
        except OURS as error:
            result = error
    if isinstance(result, OURS):
        assert str(result)
        assert "\n" not in str(result)
        assert isinstance(result, InputError) or fits.applies
        return None
    assert fits.applies, fits.reason
    assert result.model == model.name
    return result


def valid(entries):
    """The scene, which is read back as it was written; what is refused, in one line, is no example."""
    try:
        scene = read_scene(entries)
    except InputError as error:
        assert "\n" not in str(error)  # noqa: PT017
        reject()
    assert read_scene(scene_entries(scene)) == scene
    return scene


def value(result, name):
    return result.quantities[name].value


@pytest.mark.parametrize(
    ("kind", "count"),
    [("pocket", 25), ("bearing", 25), ("machine", 8), ("dry_contact", 30), ("seal", 20), ("rough_gap", 25)],
)
def test_every_rung_answers_as_the_laws_of_its_kind_allow(kind, count):
    ladder = rungs("bearing" if kind == "machine" else kind)

    @examples(count)
    @given(SCENES[kind])
    def put(entries):
        scene = valid(entries)
        for model in ladder:
            note(model.name)
            result = solved(model, scene)
            assert result is None or broken(scene, result) == []

    put()


@pytest.mark.openfoam
@pytest.mark.slow
@pytest.mark.parametrize(("kind", "count"), [("pocket", 2), ("rough_gap", 2)])
def test_every_rung_of_openfoam_does_too(kind, count):
    ladder = [model for model in models(kind) if model.outside]

    @settings(examples(count), phases=[Phase.generate])
    @given(SCENES[kind])
    def put(entries):
        scene = valid(entries)
        for model in ladder:
            note(model.name)
            result = solved(model, scene)
            assert result is None or broken(scene, result) == []

    put()


@examples(8)
@given(machines())
def test_a_machine_is_marched_or_says_in_one_line_why_not(entries):
    scene = valid(entries)
    with in_time(LIMIT):
        try:
            found = march(scene, cells=(16, 8), steps=4, uncertainty=False)
        except OURS as error:
            assert "\n" not in str(error)  # noqa: PT017
            return
    assert np.isfinite(found["film_min"]).all()
    assert found["film_min"].min() > 0


@examples(20)
@given(pockets())
def test_a_mirrored_groove_has_its_pressure_turned_round(entries):
    """Reynolds' equation is linear in the speed: p(x) becomes -p(-x), whatever the groove."""
    scene = valid(entries)
    model = find("pocket", "reynolds")
    one, other = (model.solve(each) for each in (scene, valid(mirrored(entries))))
    size = max(abs(value(one, "pressure_max_plus")), abs(value(one, "pressure_min_plus")))
    assert value(other, "load_plus") == pytest.approx(-value(one, "load_plus"), abs=1e-6 * size)
    assert value(other, "pressure_max_plus") == pytest.approx(-value(one, "pressure_min_plus"), abs=1e-3 * size)
    assert value(other, "friction_plus") == pytest.approx(value(one, "friction_plus"), rel=1e-6)


@examples(15)
@given(pockets(), number(1e-3, 1e3), number(1e-2, 1e2))
def test_only_dimensionless_numbers_count(entries, longer, thicker):
    """Lengths and viscosities in other units, at the same Re and ambient pressure over η u/h: the same p+, friction+.

    A model that warns of itself may follow rounding, as thin films do where the walls of a half circle are upright.
    """

    def scaled(found):
        if isinstance(found, dict):
            return {key: scaled(one) for key, one in found.items()}
        if isinstance(found, list):
            return [scaled(one) for one in found]
        return (
            found * longer
            if isinstance(found, float)
            else f"{float(found[:-2]) * longer!r} m"
            if found[-2:] == " m"
            else found
        )

    scene = valid(entries)
    oil = {"viscosity": f"{scene.lubricant.viscosity * thicker!r} Pa*s", "density": "900 kg/m^3"}
    changed = {"lubricant": oil, "motion": {"reynolds_number": scene.reynolds_number}}
    changed |= {"geometry": scaled(entries["geometry"])}
    unit = valid(entries | changed).pressure_unit / scene.pressure_unit
    there = valid(entries | changed | {"boundary": {"ambient_pressure": f"{101325.0 * unit!r} Pa"}})
    for model in rungs("pocket"):
        one, other = (solved(model, each) for each in (scene, there))
        if one is None or other is None or one.warnings:
            continue
        for name in ("load_plus", "friction_plus"):
            assert value(other, name) == pytest.approx(
                value(one, name), rel=1e-4, abs=1e-5 * value(one, "friction_plus")
            )


@examples(15)
@given(dry_contacts(), number(1.01, 3))
def test_more_load_means_more_contact_and_less_gap(entries, more):
    scene = valid(entries)
    heavier = scene.load.pressure * more
    if heavier > scene.hardness:
        reject()
    there = valid(entries | {"load": {"pressure": f"{heavier!r} Pa"}})
    for model in rungs("dry_contact"):
        one, other = (solved(model, each) for each in (scene, there))
        if one is None or other is None:
            continue
        slack = max(each.quantities["area_fraction"].uncertainty or 0.0 for each in (one, other))
        assert value(other, "area_fraction") >= value(one, "area_fraction") * (1 - 1e-6) - slack
        if "mean_gap" in one.quantities and "mean_gap" in other.quantities:
            slack = 1e-6 * value(one, "rms_height")
            assert value(other, "mean_gap") <= value(one, "mean_gap") + slack


@examples(15)
@given(seals(), number(1.01, 3))
def test_a_seal_turned_by_a_right_angle_leaks_the_same_and_pressed_harder_no_more(entries, more):
    """The surface written as a file, and as one whose x is y; then at a greater load."""
    scene = valid(entries)
    surface = scene.surface()
    (dx, dy), other = surface.spacing, "xy"[1 - scene.axis]

    def at(heights, spacing, direction, load):
        geometry = {"surface": written(heights), "spacing": [f"{step!r} m" for step in spacing]}
        flow = entries["flow"] | {"direction": direction}
        return valid(entries | {"geometry": geometry, "flow": flow, "load": {"pressure": f"{load!r} Pa"}})

    load = scene.load.pressure
    plain = at(surface.heights, (dx, dy), scene.flow.direction, load)
    turned = at(surface.heights.T, (dy, dx), other, load)
    harder = at(surface.heights, (dx, dy), scene.flow.direction, min(load * more, scene.hardness))
    for name in ("homogenized_leakage", "direct_leakage"):
        model = find("seal", name)
        one, two, three = (solved(model, each) for each in (plain, turned, harder))
        smooth = value(one, "rms_height") ** 3
        bar = one["permeability"].uncertainty or 0.0
        slack = 1e-4 * value(one, "permeability") + 0.02 * bar + 1e-9 * smooth
        assert value(two, "permeability") == pytest.approx(value(one, "permeability"), abs=slack)
        assert value(three, "permeability") <= value(one, "permeability") + slack


@examples(15)
@given(bearings())
def test_sides_that_change_places_change_nothing_where_the_film_is_even_across(entries):
    """A film without roughness, whose thickness is the same from side to side."""
    entries = {key: one for key, one in entries.items() if key not in ("roughness", "asperities")}
    scene = valid(entries)
    if scene.wide or scene.geometry.shape in ("given", "sector", "washer", "lobes"):
        reject()
    sides = {"low": "2 kPa", "high": "50 kPa"}
    swapped = {"low": sides["high"], "high": sides["low"]}
    one, other = (valid(entries | {"boundary": entries["boundary"] | {"sides": each}}) for each in (sides, swapped))
    for model in rungs("bearing"):
        here, there = solved(model, one), solved(model, other)
        if here is None or there is None:
            continue
        size = np.abs(here.fields["pressure"].values).max() + 1e4
        across = there.fields["pressure"].values[:, ::-1]
        if model.name != "infinitely_wide":
            assert np.abs(across - here.fields["pressure"].values).max() <= 1e-4 * size
