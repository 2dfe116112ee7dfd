"""The steps between rungs whose laws are fitted: what each adds, and by which numbers of a scene it may be told."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Plan:
    """One rung's step; names as in :class:`rom.advice.laws.Step`, and the features of each law.

    ``features`` order what the rung leaves out, ``grid`` the error of its resolution beside that itself, ``seen`` what
    is left beside the size of the step before.
    """

    towards: tuple[str, ...] = ()
    adds: str = ""
    tells: str = ""
    features: tuple[str, ...] = ()
    grid: tuple[str, ...] | None = None
    seen_from: str = ""
    seen: tuple[str, ...] = ()


GROOVE = ("reynolds_number", "depth", "aspect", "slope", "loaded")
COLUMNS = ("reynolds_number", "film", "aspect", "slope", "loaded")
GAP = ("slope", "height", "shortness")
PRESSED = ("pressure", "hardness", "breadth")
WAVES = ("waves",)

PLANS: Mapping[str, Mapping[str, Plan]] = {
    "pocket": {
        "reynolds": Plan(
            towards=("inertial_reynolds",),
            adds="inertia",
            tells="reduced_reynolds_number",
            features=("reynolds_number", "asymmetry", "loaded"),
        ),
        "inertial_reynolds": Plan(
            towards=("film",),
            adds="inertia beyond first order",
            tells="reduced_reynolds_number",
            features=(*GROOVE, "film", "asymmetry"),
        ),
        "film": Plan(
            towards=("film_slope",), adds="slope", tells="slope", features=(*GROOVE, "asymmetry"), grid=COLUMNS
        ),
        "film_slope": Plan(
            towards=("navier_stokes",),
            adds="slope beyond second order",
            tells="slope",
            features=(*GROOVE, "asymmetry"),
            grid=COLUMNS,
            seen_from="film",
            seen=("slope", "loaded"),
        ),
        "stokes": Plan(
            towards=("navier_stokes",),
            adds="inertia",
            tells="reduced_reynolds_number",
            features=("reynolds_number", "asymmetry", "loaded"),
            grid=COLUMNS,
        ),
        "navier_stokes": Plan(grid=COLUMNS),
    },
    "rough_gap": {
        "smooth_gap": Plan(towards=("homogenized",), adds="roughness", tells="height", features=("height",)),
        "homogenized": Plan(
            towards=("slope_corrected",), adds="slope", tells="slope", features=GAP, grid=(*WAVES, "height")
        ),
        "slope_corrected": Plan(
            towards=("stokes",),
            adds="slope beyond second order",
            tells="slope",
            features=GAP,
            grid=(*WAVES, "height"),
            seen_from="homogenized",
            seen=("shortness",),
        ),
        "stokes": Plan(
            towards=("navier_stokes",),
            adds="inertia",
            tells="roughness_reynolds_number",
            features=("reynolds_number", *GAP),
            grid=(*WAVES, "height"),
        ),
        "navier_stokes": Plan(grid=(*WAVES, "height")),
    },
    "bearing": {
        "infinitely_wide": Plan(
            towards=("reynolds_cavitating",),
            adds="flow through the sides",
            tells="slenderness",
            features=("slenderness", "convergence"),
            grid=("convergence",),
        ),
        "reynolds": Plan(
            towards=("reynolds_incompressible",),
            adds="cavitation",
            tells="cavitation_number",
            features=("cavitation_number", "divergence"),
            grid=("convergence",),
        ),
        "reynolds_incompressible": Plan(
            towards=("reynolds_cavitating",),
            adds="what pressure does to the lubricant",
            tells="pressure_dependence",
            features=("pressure_dependence", "convergence"),
            grid=("convergence",),
        ),
        "reynolds_cavitating": Plan(
            towards=("homogenized",),
            adds="roughness",
            tells="roughness_ratio",
            features=("roughness_ratio",),
            grid=("convergence",),
        ),
        "homogenized": Plan(
            towards=("mixed", "direct"),
            adds="asperities that touch, or the length of the waves,",
            tells="roughness_ratio",
            features=("roughness_ratio",),
            grid=("convergence",),
        ),
        "mixed": Plan(grid=("convergence",)),
        "direct": Plan(grid=("roughness_period",)),
    },
    "dry_contact": {
        "bearing_area": Plan(
            towards=("elastic_plastic",), adds="elastic deformation", tells="hardness", features=PRESSED, grid=WAVES
        ),
        "greenwood_williamson": Plan(
            towards=("elastic_plastic",),
            adds="what asperities do to each other",
            tells="pressure",
            features=PRESSED,
            grid=WAVES,
        ),
        "persson": Plan(
            towards=("elastic_plastic",),
            adds="the surface that an average hides",
            tells="pressure",
            features=PRESSED,
            grid=WAVES,
        ),
        "elastic": Plan(
            towards=("elastic_plastic",),
            adds="yielding",
            tells="hardness",
            features=("pressure", "hardness"),
            grid=WAVES,
        ),
        "elastic_plastic": Plan(grid=WAVES),
    },
    "seal": {
        "effective_medium": Plan(
            towards=("homogenized_leakage",),
            adds="the surface's own channels",
            tells="pressure",
            features=("pressure", "hardness", "waves"),
            grid=WAVES,
        ),
        "homogenized_leakage": Plan(
            towards=("direct_leakage",),
            adds="the ends of the seal",
            tells="length",
            features=("length", "waves", "pressure"),
            grid=WAVES,
        ),
        "direct_leakage": Plan(grid=WAVES),
    },
}
