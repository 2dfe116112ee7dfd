"""The advice: the laws, the two estimates, and the verdict where they disagree."""

from dataclasses import replace

import pytest
from places import SCENES

from roughfilm import foamcases, rom
from roughfilm.contact.foundation.errors import ConvergenceError, InputError
from roughfilm.contact.foundation.units import Quantity
from roughfilm.ladder import find, models
from roughfilm.rom.advice.advise import Verdict, advise, shortfall, wanted
from roughfilm.rom.advice.expected import with_errors
from roughfilm.rom.advice.laws import RESOLVING, Grid, Law, Promise, Step, Table, Term, read_table, table
from roughfilm.rom.advice.measured import with_measured_errors
from roughfilm.rom.advice.stated import StatedError, percent, stated_errors
from roughfilm.rom.ladder.kind import Omission, kind_of_laws, kinds
from roughfilm.rom.ladder.model import (
    OF_LUBRICANT,
    Applicability,
    Availability,
    Effect,
    Model,
    Resolutions,
    best,
    ladder,
    of_kind,
)
from roughfilm.rom.ladder.result import Numerics, Result
from roughfilm.rom.ladder.scene import load_scene
from roughfilm.words.headline import sureness
from roughfilm.words.summary import summary

ALL = ladder(rom, foamcases)


def law(error, reach=None, **powers):
    return Law(terms=(Term(coefficient=error, powers=powers),), reach=reach or {})


class Fakes:
    """Three rungs of a pocket whose loads and errors are given; what was run is kept."""

    LOADS = {"reynolds": 1.20, "film": 1.04, "navier_stokes": 1.00}  # noqa: RUF012
    COSTS = {"reynolds": 1e-4, "film": 1e-2, "navier_stokes": 3.0}  # noqa: RUF012

    def __init__(self, errors, loads=None, costs=None, available=True):
        self.loads, self.costs = {**self.LOADS, **(loads or {})}, {**self.COSTS, **(costs or {})}
        self.ran = []
        keeps = {"reynolds": set(), "film": {Effect.INERTIA}, "navier_stokes": {Effect.INERTIA, Effect.SLOPE}}
        self.models = [self.model(name, frozenset(keeps[name]), available) for name in keeps]
        towards = {"reynolds": "film", "film": "navier_stokes"}
        steps = [
            Step(
                kind="pocket",
                model=name,
                towards=above,
                adds="something",
                measure="",
                left_out={"load_plus": law(errors[name])} if errors.get(name) is not None else {},
            )
            for name, above in towards.items()
        ]
        self.table = Table(steps=steps, grids=[], provenance={})

    def model(self, name, keeps, available):
        return Model(
            name=name,
            kind="pocket",
            summary=name,
            keeps=keeps,
            sources=(),
            resolutions=Resolutions(least=1, most=100, default=8, series=(8,)),
            resolution_meaning="",
            residual_meaning="",
            order=None,
            tolerance=1e-9,
            cost=lambda _scene, _resolution: self.costs[name],
            applies=lambda _scene: Applicability(applies=True, reason=""),
            compute=self.compute(name),
            outside=name == "navier_stokes",
            available=lambda: Availability(available=available or name != "navier_stokes", detail="install it"),
        )

    def compute(self, name):
        def solved(_model, scene, _request, _progress):
            self.ran.append(name)
            if self.loads[name] is None:
                raise ConvergenceError("no")
            load = Quantity(value=self.loads[name], unit="1")
            numerics = Numerics(
                residual=0.0,
                iterations=1,
                cpu_s=self.costs[name],
                wall_s=0.0,
                degrees_of_freedom=1,
                resolution=8,
                tolerance=0.0,
                scheme="",
            )
            quantities = {"load_plus": load, "pressure_max_plus": load, "pressure_min_plus": load}
            return Result(
                model=name,
                quantities=quantities,
                fields={},
                numerics=numerics,
                provenance={"scene": {"kind": scene.kind}},
            )

        return solved

    def advise(self, scene, within):
        return advise(scene, self.models, quantity="load_plus", within=within, laws=self.table)


@pytest.fixture
def scene(make_scene):
    return make_scene(0.3, 0.25, 20)


def test_a_law_is_a_product_of_powers_and_says_where_it_was_not_fitted():
    found = law(0.5, {"a": (0.1, 1.0), "b": (1.0, 10.0)}, a=2.0, b=-1.0)
    assert found.error({"a": 0.2, "b": 4.0}) == pytest.approx(0.5 * 0.04 / 4)
    assert found.beyond({"a": 0.01, "b": 4.0}) is None, "where effects vanish it may be left"
    assert found.beyond({"a": 2.0, "b": 4.0}) == "a"
    assert found.beyond({"a": 0.5, "b": 0.1}) == "b"
    assert found.error({"a": 1.0, "b": 0.0}) == float("inf")


def test_beyond_the_sweep_an_error_shrinks_with_the_number_that_it_follows_alone():
    found = law(0.5, {"a": (0.1, 1.0), "b": (1.0, 10.0)}, a=2.0, b=-1.0)
    least = found.error({"a": 0.1, "b": 10.0})
    assert found.error({"a": 0.01, "b": 1000.0}) == least
    assert found.error({"a": 0.01, "b": 10.0}, ("a",)) == pytest.approx(least / 100)
    assert found.error({"a": 0.1, "b": 1000.0}, "b") == pytest.approx(least / 100)
    assert found.beyond({"a": 0.5, "b": 1000.0}) == "b", "nothing was swept there, whatever its power"
    assert found.beyond({"a": 0.5, "b": 1000.0}, "b") is None


@pytest.mark.parametrize("number", [-1e-3, float("nan"), 1e200])
def test_a_number_without_meaning_promises_nothing(number):
    assert not law(0.5, a=2.0, b=-0.25).error({"a": 1e200, "b": number}) < float("inf")
    assert not law(0.5, a=2.0).error({"a": number}) < 1e3


def test_both_estimates_agree_that_the_cheapest_will_do(scene):
    fakes = Fakes({"reynolds": 0.02, "film": 0.01}, {"reynolds": 1.01, "film": 1.0})
    found = fakes.advise(scene, 0.05)
    assert (found.chosen.model, fakes.ran) == ("reynolds", ["reynolds", "film"])
    assert found.chosen.a_priori.error == pytest.approx((0.02**2 + 0.01**2) ** 0.5)
    assert found.chosen.a_posteriori.error == pytest.approx(0.01 + 0.01)
    assert found.result.model == "reynolds"
    assert found.spent_cpu_s == pytest.approx(1e-4 + 1e-2)


def test_a_model_that_the_laws_rule_out_is_not_run(scene):
    fakes = Fakes({"reynolds": 0.5, "film": 0.01})
    found = fakes.advise(scene, 0.05)
    assert found.chosen.model == "film"
    assert "reynolds" not in fakes.ran
    assert found.considered[0].verdict is Verdict.NOT_ENOUGH
    assert found.considered[0].why == "error 50 % (expected by the laws); leaves out something"


def test_runs_that_contradict_the_laws_decide(scene):
    cheap = {"navier_stokes": 8.4e-4, "film": 2.9e-4}
    wrong = Fakes({"reynolds": 0.01, "film": 0.01}, {"reynolds": 1.2, "film": 1.0}, cheap)
    found = wrong.advise(scene, 0.05)
    assert found.chosen.model == "film", "film differs from reynolds by 20 %, and is itself within 1 %"
    assert found.considered[0].a_posteriori.least == pytest.approx(0.2 - 0.01)


def test_runs_that_promise_more_than_the_laws_count(scene):
    fakes = Fakes({"reynolds": 0.08, "film": 0.01}, {"reynolds": 1.02, "film": 1.0})
    found = fakes.advise(scene, 0.05)
    assert found.chosen.model == "reynolds"
    assert found.chosen.error == pytest.approx(0.02 + 0.01)


@pytest.mark.parametrize("expected", [0.01, 0.03, 0.08, 0.3, None])
@pytest.mark.parametrize("reynolds", [1.0, 1.02, 1.3])
def test_a_looser_tolerance_never_costs_more(scene, expected, reynolds):
    fakes = Fakes({"reynolds": expected, "film": 0.01}, {"reynolds": reynolds})
    costs = [
        chosen.cpu_s if (chosen := fakes.advise(scene, within).chosen) else float("inf")
        for within in (0.001, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5)
    ]
    assert costs == sorted(costs, reverse=True)


def test_a_promise_replaces_the_steps(scene):
    fakes = Fakes({"reynolds": 0.2, "film": 0.5}, {"reynolds": 1.0, "film": 1.0})
    promise = Promise(kind="pocket", model="film", laws={"load_plus": law(0.02)})
    fakes.table = replace(fakes.table, promises=[promise])
    found = fakes.advise(scene, 0.05)
    assert found.chosen.model == "reynolds", "it does not differ from film, which is promised within 2 %"
    assert found.chosen.why == "error 0 % ± 2 % (measured against film); film was run too at resolution 8"


def test_the_finer_resolution_that_would_do_is_proposed(scene):
    fakes = Fakes({"reynolds": 0.5, "film": 0.5})
    fakes.models = [replace(model, order=2) for model in fakes.models]
    laws = {"load_plus": law(1.0, {"resolution": (4.0, 16.0)}, resolution=-2.0)}
    fakes.table = replace(fakes.table, grids=[Grid(kind="pocket", model="navier_stokes", laws=laws)])
    found = fakes.advise(scene, 0.001)
    assert found.chosen is None
    assert (found.finer.model, found.finer.resolution) == ("navier_stokes", 32)
    assert shortfall(found).endswith("; navier_stokes at resolution 32 is expected to (3 CPU s)")


def test_a_dear_best_rung_is_not_run_to_check_another(scene):
    fakes = Fakes({"reynolds": 0.5, "film": 0.01})
    found = fakes.advise(scene, 0.05)
    assert (found.chosen.model, fakes.ran) == ("film", ["film"])
    assert found.chosen.a_posteriori is None


@pytest.mark.parametrize(("best_cost", "chosen"), [(8.4e-4, "reynolds"), (7e-4, "film")])
def test_all_checks_cost_at_most_half_of_the_best_model(scene, best_cost, chosen):
    fakes = Fakes({"reynolds": 0.08, "film": 0.01}, {"reynolds": 1.01}, {"navier_stokes": best_cost, "film": 2.9e-4})
    assert fakes.advise(scene, 0.05).chosen.model == chosen, "both runs of the check of reynolds cost 3.9e-4 s"


def test_beyond_the_tolerance_the_best_model_is_left(scene):
    fakes = Fakes({"reynolds": 0.5, "film": 0.2})
    found = fakes.advise(scene, 0.01)
    assert found.chosen.model == "navier_stokes"
    assert found.result is None, "it is not run to advise it"
    assert found.chosen.cpu_s == 3.0


def test_it_says_when_no_rung_will_do_and_which_comes_nearest(scene):
    fakes = Fakes({"reynolds": 0.5, "film": 0.2}, available=False)
    found = fakes.advise(scene, 0.05)
    assert found.chosen is None
    assert found.nearest.model == "film"
    assert found.considered[-1].verdict is Verdict.NOT_HERE


def test_a_rung_without_a_law_is_not_trusted_unless_a_cheap_one_tells(scene):
    unknown = Fakes({"reynolds": None, "film": 0.01}, {"reynolds": 1.01, "film": 1.0})
    assert unknown.advise(scene, 0.05).chosen.model == "reynolds"
    blind = Fakes({"reynolds": 0.5, "film": None})
    assert blind.advise(scene, 0.05).chosen.model == "navier_stokes"


def test_what_has_failed_is_not_run_again(scene):
    cheap = {"navier_stokes": 8.4e-4, "film": 2.9e-4}
    fakes = Fakes({"reynolds": 0.01, "film": 0.01}, {"navier_stokes": None}, cheap)
    assert fakes.advise(scene, 0.05).chosen.model == "film"
    assert fakes.ran.count("navier_stokes") == 1


def test_a_rung_of_which_no_tolerance_is_left_is_not_called_not_needed(scene, monkeypatch):
    known_omission = Omission(part=0.3, reason="heat, which no rung keeps")
    kind = replace(kinds()["pocket"], omitted=lambda _scene, _model, _quantity: known_omission)
    monkeypatch.setattr("roughfilm.rom.advice.advise.kind_of_scene", lambda _scene: kind)
    found = Fakes({"reynolds": None, "film": 0.0}).advise(scene, 0.05)
    assert {one.verdict for one in found.considered} == {Verdict.NOT_ENOUGH}


def test_an_effect_that_one_model_leaves_out_counts_for_that_model_alone(scene, monkeypatch):
    known_omission = Omission(part=0.3, reason="cavitation", source="estimated from its effect")
    kind = replace(
        kinds()["pocket"], omitted=lambda _scene, model, _quantity: known_omission if model.name == "reynolds" else None
    )
    monkeypatch.setattr("roughfilm.rom.advice.advise.kind_of_scene", lambda _scene: kind)
    found = Fakes({"reynolds": 0.01, "film": 0.0}).advise(scene, 0.05)
    assert (found.chosen.model, found.omitted) == ("film", {"reynolds": known_omission})
    first = found.considered[0]
    assert (first.model, first.verdict) == ("reynolds", Verdict.NOT_ENOUGH)
    assert first.stated.error == pytest.approx(0.31)
    assert first.stated.words == "31 % (estimated from its effect)"


def test_a_promise_up_to_a_model_counts_the_steps_above_it_too(scene):
    fakes = Fakes({"reynolds": 0.5, "film": 0.03}, costs={"film": 100.0, "navier_stokes": 200.0})
    promise = Promise(kind="pocket", model="reynolds", towards="film", laws={"load_plus": law(0.04)})
    fakes.table = replace(fakes.table, promises=[promise])
    found = fakes.advise(scene, 0.1).considered[0]
    assert found.a_priori.error == pytest.approx((0.04**2 + 0.03**2) ** 0.5)
    assert found.reason.startswith("leaves out ")


def test_a_law_without_powers_needs_no_numbers(scene, monkeypatch):
    kind = replace(kinds()["pocket"], numbers=lambda _scene: {})
    monkeypatch.setattr("roughfilm.rom.advice.advise.kind_of_scene", lambda _scene: kind)
    fakes = Fakes({"reynolds": 0.02, "film": 0.01}, {"reynolds": 1.0, "film": 1.0})
    fakes.table = replace(fakes.table, steps=[replace(step, measure="slope") for step in fakes.table.steps])
    assert fakes.advise(scene, 0.05).chosen.model == "reynolds"


def test_a_grid_beyond_those_that_were_swept_is_not_trusted(scene):
    fakes = Fakes({"reynolds": 0.5, "film": 0.5})
    fakes.models = [replace(model, order=2) for model in fakes.models]
    powers, reach = (
        {"resolution": -2.0, "reynolds_number": 0.1},
        {"resolution": (4.0, 16.0), "reynolds_number": (0.5, 9)},
    )
    laws = {"load_plus": law(1e-3, reach, **powers)}
    fakes.table = replace(fakes.table, grids=[Grid(kind="pocket", model="navier_stokes", laws=laws)])
    found = fakes.advise(scene, 0.05)
    assert found.chosen is None
    assert "Re = 20 is outside the fitted range of 0.5 to 9" in found.considered[-1].reason


@pytest.mark.parametrize(
    ("part", "text"), [(0.05, "5 %"), (0.999, "100 %"), (2.52, "above 100 %"), (float("inf"), "unknown")]
)
def test_a_bound_above_the_value_itself_is_not_a_number(part, text):
    assert percent(part) == text


def test_a_grid_of_which_nothing_is_known_is_not_trusted(scene):
    fakes = Fakes({"reynolds": 0.5, "film": 0.5})
    fakes.models = [replace(model, order=2) for model in fakes.models]
    found = fakes.advise(scene, 0.05)
    assert found.chosen is None
    assert found.nearest is None
    assert "not known here" in found.considered[-1].reason


def test_a_check_that_does_not_converge_decides_nothing(scene):
    cheap = {"navier_stokes": 8.4e-4, "film": 2.9e-4}
    fakes = Fakes({"reynolds": 0.02, "film": 0.01}, {"film": None}, cheap)
    found = fakes.advise(scene, 0.05)
    assert found.chosen.model == "reynolds", "by its numbers, as nothing can be run beside it"
    assert found.result.model == "reynolds"


def test_a_model_that_failed_is_not_advised(scene):
    fakes = Fakes({"reynolds": 0.02, "film": 0.01}, {"reynolds": None})
    found = fakes.advise(scene, 0.05)
    assert found.chosen.model == "film"
    assert (found.considered[0].verdict, found.considered[0].reason) == (Verdict.FAILED, "no")
    top = Fakes({"reynolds": 0.5, "film": 0.2}, {"navier_stokes": None})
    top.models = [replace(one, outside=False) for one in top.models]
    found = top.advise(scene, 0.01)
    assert found.considered[-1].verdict is Verdict.FAILED
    assert (found.chosen, found.nearest.model) == (None, "film")


def test_a_law_that_is_left_does_not_count_as_an_estimate(scene):
    fakes = Fakes({"reynolds": 0.5, "film": None})
    narrow = law(1e-9, {"reynolds_number": (1e-3, 1e-2)}, reynolds_number=1.0)
    first, second = fakes.table.steps
    fakes.table = replace(fakes.table, steps=[first, replace(second, left_out={"load_plus": narrow})])
    assert fakes.advise(scene, 0.05).chosen.model == "navier_stokes"


def test_what_every_rung_leaves_out_counts_too(scene, monkeypatch):
    known_omission = Omission(part=0.03, reason="heat, which no rung keeps")
    kind = replace(kinds()["pocket"], omitted=lambda _scene, _model, _quantity: known_omission)
    monkeypatch.setattr("roughfilm.rom.advice.advise.kind_of_scene", lambda _scene: kind)
    fakes = Fakes({"reynolds": 0.01, "film": 0.0}, {"reynolds": 1.006, "film": 1.0})
    assert fakes.advise(scene, 0.05).chosen.model == "reynolds"
    found = fakes.advise(scene, 0.02)
    assert (found.chosen, set(found.omitted.values())) == (None, {known_omission})
    assert fakes.ran == ["reynolds", "film"], "nothing more is run where nothing is left of the tolerance"
    assert fakes.advise(scene, 0.035).chosen.model == "film", "0.5 % is left, and reynolds is 0.6 % off"


@pytest.mark.parametrize("within", [0.0, 1.0, -0.1, float("nan")])
def test_a_tolerance_out_of_range_is_refused(scene, within):
    with pytest.raises(InputError, match=r"^within: got"):
        Fakes({}).advise(scene, within)


def test_a_quantity_is_known_by_its_name_and_its_title(scene):
    assert wanted(scene, None) == wanted(scene, "load") == wanted(scene, "load_plus") == "load_plus"
    assert wanted(scene, "friction") == "friction_plus"
    with pytest.raises(InputError, match="'load', 'friction'"):
        wanted(scene, "lift")


MOVING = {"free_bearing", "placed_bearing"}
"""Kinds of laws whose rough scenes are too few for laws of roughness."""


def test_the_table_names_rungs_quantities_and_numbers_that_exist():
    found = table()
    assert found.provenance["certainty"] == 0.95
    for step in found.steps:
        kind = kind_of_laws(step.kind)
        assert {step.model, step.towards} <= {model.name for model in of_kind(ALL, kind.name)}
        assert step.measure in kind.symbols
        few = step.kind in MOVING and {step.model, step.towards} & {"homogenized", "mixed", "direct"}
        if few or step.kind not in found.provenance["fits"]:  # fewer scenes than a law needs
            assert not step.left_out
            continue
        promised = set(found.promise(step.kind, step.model).laws)
        assert set(kind.compared) <= (promised or set(step.left_out)) <= set(kind.titles)
        assert not (promised and step.left_out), "a promise replaces the step"
    for grid in found.grids:
        assert grid.model in {model.name for model in of_kind(ALL, kind_of_laws(grid.kind).name)}
    laws = [(one.kind, law) for one in found.steps for law in one.left_out.values()]
    laws += [(one.kind, law) for one in found.promises for law in one.laws.values()]
    laws += [(one.kind, law) for one in found.grids for law in one.laws.values()]
    for kind, one in laws:
        assert set(one.names) <= {*kind_of_laws(kind).symbols, *RESOLVING}
        assert all(term.coefficient > 0 for term in one.terms)


def test_every_rung_has_a_way_to_the_best_one():
    for name in kinds():
        models = [model for model in of_kind(ALL, name) if not model.keeps & OF_LUBRICANT]  # these have no steps
        missing = [(), ("mixed",), *([("homogenized", "direct")] if name == "bearing" else [])]  # the walls touch
        for model in models:
            for applying in ([one.name for one in models if one.name not in left] for left in missing):
                seen = [model.name]
                while step := table().step(name, seen[-1], applying):
                    assert step.towards not in seen, "in a circle"
                    seen.append(step.towards)
                top = best([one for one in models if one.name in applying or one is model])
                alone = {
                    "pocket": ["reynolds_cavitating"],
                    "bearing": ["direct", "film", "film_slope", "stokes", "navier_stokes"],
                }.get(name, [])
                assert seen[-1] in (top.name, *alone), "these have effects that the most complete model leaves out"


def test_a_table_is_read_from_its_text():
    text = """
    provenance = { certainty = 0.95 }
    [[step]]
    kind = "pocket"
    model = "film"
    towards = "navier_stokes"
    adds = "slope"
    measure = "slope"
    left_out.load_plus = { terms = [{ coefficient = 0.1, powers = { slope = 1.5 } }], reach = { slope = [0.1, 1.0] } }
    [[grid]]
    kind = "pocket"
    model = "film"
    laws.load_plus = { terms = [{ coefficient = 9.0, powers = { resolution = -2.0 } }], reach = {} }
    """
    found = read_table(text)
    assert found.step("pocket", "film", ["navier_stokes"]).left_out["load_plus"].error(
        {"slope": 0.25}
    ) == pytest.approx(0.0125)
    assert found.step("pocket", "film", ["film"]) is None
    assert found.grid("pocket", "film", "load_plus").error({"resolution": 30.0}) == pytest.approx(0.01)
    assert found.grid("pocket", "film", "friction_plus") is None


def test_steep_fast_grooves_need_more_than_shallow_slow_ones(make_scene):
    models = of_kind(ALL, "pocket")
    shallow = advise(make_scene(0.4, 0.25, 2), models, quantity="load_plus", within=0.1)
    assert shallow.chosen.model in ("inertial_reynolds", "film", "film_slope")
    assert {one.model: one for one in shallow.considered}["reynolds"].verdict is Verdict.NOT_ENOUGH
    steep = advise(make_scene(0.15, 1.25, 160), models, quantity="load_plus", within=0.02)
    assert steep.chosen is None or steep.chosen.cpu_s > shallow.chosen.cpu_s


def omitted_by_the_first(kind, scene):
    return kind.omitted(scene, of_kind(ALL, kind.name)[0], "load_per_width")


def test_inertia_that_no_model_of_a_bearing_includes_is_that_of_first_order():
    """Half the density, half the part: to first order; without a density nothing is said."""
    entries = {
        "name": "wedge",
        "kind": "bearing",
        "geometry": {"shape": "linear", "length": "20 mm", "width": "20 mm", "film": "40 um", "rise": "40 um"},
        "lubricant": {"viscosity": "0.01 Pa*s", "density": "800 kg/m^3"},
        "motion": {"speed": "10 m/s"},
    }
    kind = kinds()["bearing"]
    whole = omitted_by_the_first(kind, kind.read(entries))
    half = kind.read({**entries, "lubricant": {"viscosity": "0.01 Pa*s", "density": "400 kg/m^3"}})
    assert whole.part == pytest.approx(2 * omitted_by_the_first(kind, half).part, rel=1e-9)
    assert whole.reason.startswith(
        "reduced Reynolds number Re·h/L = 0.064: inertia, which no model of this bearing includes, "
        "changes the load by about "
    )
    assert omitted_by_the_first(kind, kind.read({**entries, "lubricant": {"viscosity": "0.01 Pa*s"}})) is None


def test_an_uncertainty_that_a_run_states_is_believed_rather_than_the_law_of_its_grid(scene):
    """The law expects 1 % of any grid; the coarse run states 20 % and the fine one 2 %."""
    fakes = Fakes({"reynolds": 0.5, "film": 0.01}, available=False)
    stated = {8: 0.2, 16: 0.02}

    def solved(model, _scene, request, _progress):
        result = fakes.compute(model.name)(model, scene, request, _progress)
        load = Quantity(value=1.0, unit="1", uncertainty=stated[request.resolution])
        return replace(result, quantities={**result.quantities, "load_plus": load})

    series = Resolutions(least=1, most=16, default=16, series=(8, 16))
    fakes.models = [
        replace(model, order=2, resolutions=series, compute=solved) if model.name == "film" else model
        for model in fakes.models
    ]
    grid = Grid(kind="pocket", model="film", laws={"load_plus": law(0.01)})
    fakes.table = replace(fakes.table, grids=[grid])
    fakes.table = replace(fakes.table, promises=[Promise(kind="pocket", model="film", laws={"load_plus": law(0.01)})])
    found = fakes.advise(scene, 0.05)
    assert (found.chosen.model, found.chosen.resolution) == ("film", 16)
    assert found.chosen.error == pytest.approx(0.02)
    assert fakes.advise(scene, 0.3).chosen.resolution == 8


TURBULENT = "Re = 2e4 exceeds 1440, above which shear flow is turbulent"


def bounded(monkeypatch, outside):
    """The pocket's kind with a range of its models: outside(model, result)."""
    kind = replace(kinds()["pocket"], outside=lambda _scene, model, result: outside(model.name, result))
    monkeypatch.setattr("roughfilm.rom.pocket.kind.KIND", kind)


def test_a_model_outside_its_range_is_not_run_and_not_chosen(scene, monkeypatch):
    bounded(monkeypatch, lambda name, _result: [TURBULENT] if name == "reynolds" else [])
    fakes = Fakes({"reynolds": 0.001, "film": 0.002}, {"reynolds": 1.0, "film": 1.0})
    found = fakes.advise(scene, 0.05)
    assert (found.chosen.model, fakes.ran) == ("film", ["film"])
    (reynolds,) = [one for one in found.considered if one.model == "reynolds"]
    assert (reynolds.verdict, reynolds.error, reynolds.sure) == (Verdict.NOT_ENOUGH, None, False)
    assert TURBULENT in reynolds.why


def test_a_solution_outside_the_range_of_its_model_is_not_chosen(scene, monkeypatch):
    bounded(monkeypatch, lambda name, result: [TURBULENT] if name == "reynolds" and result else [])
    found = Fakes({"reynolds": 0.001, "film": 0.002}, {"reynolds": 1.0, "film": 1.0}).advise(scene, 0.05)
    assert found.chosen.model == "film"
    assert TURBULENT in next(one for one in found.considered if one.model == "reynolds").why


def test_nothing_is_measured_against_a_solution_outside_its_range(scene, monkeypatch):
    bounded(monkeypatch, lambda name, result: [TURBULENT] if name == "film" and result else [])
    found = Fakes({"reynolds": None, "film": 0.01}, {"reynolds": 1.0, "film": 1.0}).advise(scene, 0.05)
    assert next(one for one in found.considered if one.model == "reynolds").error is None
    assert found.chosen is None or found.chosen.model == "navier_stokes"


def test_where_every_model_is_outside_its_range_none_is_advised_and_it_is_said_why(scene, monkeypatch):
    bounded(monkeypatch, lambda _name, _result: [TURBULENT])
    found = Fakes({"reynolds": 0.001, "film": 0.001}).advise(scene, 0.5)
    assert (found.chosen, found.nearest) == (None, None)
    assert found.fallback.model == "navier_stokes"
    assert shortfall(found) == f"no model here is known to give the load within 50 %: {TURBULENT}"


def test_a_result_outside_the_range_of_its_model_has_no_error_and_says_so_first(scene, monkeypatch):
    model = find("pocket", "film_slope")
    inside = with_errors(model.solve(scene), scene, model, models("pocket"))
    assert inside.outside == ()
    assert inside.expected_error["load_plus"] < 1
    bounded(monkeypatch, lambda _name, _result: [TURBULENT])
    known = {"load_plus": StatedError(error=0.01, source="by another run")}
    outside = with_errors(model.solve(scene), scene, model, models("pocket"), known=known)
    assert (outside.outside, outside.expected_error, stated_errors(outside)) == ((TURBULENT,), {}, {})
    assert summary(outside, "load_plus", 0.05).startswith(
        f"outside the range of the model: {TURBULENT}; error unknown; load "
    )
    assert "enough" not in summary(outside, "load_plus", 0.05)
    assert f"outside the range of the model: {TURBULENT}" in sureness(outside)
    assert TURBULENT in repr(outside).splitlines()[-1]
    both = {name: find("pocket", name).solve(scene) for name in ("reynolds", "film_slope")}
    judged = with_measured_errors(scene, models("pocket"), both)
    assert not any(one.expected_error for one in judged.values())


def test_a_number_of_the_fit_in_no_term_still_limits_the_range():
    """A law in which Re has no power was fitted up to Re = 290; nothing shows that it holds at Re = 400."""
    fitted = law(0.01, reach={"depth": (0.1, 2.0), "reynolds_number": (0.001, 290.0)}, depth=1.0)
    assert fitted.beyond({"depth": 1.0, "reynolds_number": 300.0}) is None
    assert fitted.beyond({"depth": 1.0, "reynolds_number": 400.0}) == "reynolds_number"
    assert fitted.beyond({"depth": 1.0, "reynolds_number": 1e-6}) is None
    assert fitted.beyond({"depth": 1.0}) is None


@pytest.mark.parametrize("model", ["film", "film_slope"])
def test_a_groove_beyond_the_fitted_reynolds_numbers_has_no_expected_error(model):
    scene = load_scene(SCENES / "pocket.toml", ["motion.reynolds_number=400"])
    result = with_errors(find("pocket", model).solve(scene), scene, find("pocket", model), models("pocket"))
    assert not result.expected_error.keys() & {"load_plus", "friction_plus"}
    assert any("Re = 400 is outside the fitted range" in warning for warning in result.warnings)
