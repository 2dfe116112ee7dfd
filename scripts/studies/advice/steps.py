"""The steps between rungs whose laws are fitted: what each adds, and by which numbers of a scene it may be told."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A step; names as in :class:`roughfilm.rom.advice.laws.Step`.

    ``features`` order what the rung leaves out, ``seen`` what is left beside the size of the step before.
    """

    model: str
    towards: str
    adds: str
    tells: str
    features: tuple[str, ...]
    seen_from: str = ""
    seen: tuple[str, ...] = ()


GROOVE = ("reynolds_number", "depth", "aspect", "slope", "asymmetry", "loaded")
INERTIAL = ("reynolds_number", "asymmetry", "loaded")
GAP = ("slope", "height", "shortness")
PRESSED = ("pressure", "hardness", "breadth")

STEPS: Mapping[str, Sequence[Plan]] = {
    "pocket": (
        Plan(
            model="reynolds",
            towards="inertial_reynolds",
            adds="inertia",
            tells="reduced_reynolds_number",
            features=INERTIAL,
        ),
        Plan(
            model="inertial_reynolds",
            towards="film",
            adds="inertia beyond first order",
            tells="reduced_reynolds_number",
            features=(*GROOVE, "film"),
        ),
        Plan(model="film", towards="film_slope", adds="slope", tells="slope", features=GROOVE),
        Plan(
            model="film_slope",
            towards="navier_stokes",
            adds="slope beyond second order",
            tells="slope",
            features=GROOVE,
            seen_from="film",
            seen=("slope", "loaded"),
        ),
        Plan(
            model="stokes",
            towards="navier_stokes",
            adds="inertia",
            tells="reduced_reynolds_number",
            features=INERTIAL,
        ),
    ),
    "rough_gap": (
        Plan(model="smooth_gap", towards="homogenized", adds="roughness", tells="height", features=("height",)),
        Plan(model="homogenized", towards="slope_corrected", adds="slope", tells="slope", features=GAP),
        Plan(
            model="slope_corrected",
            towards="stokes",
            adds="slope beyond second order",
            tells="slope",
            features=GAP,
            seen_from="homogenized",
            seen=("shortness",),
        ),
        Plan(
            model="stokes",
            towards="navier_stokes",
            adds="inertia",
            tells="roughness_reynolds_number",
            features=("reynolds_number", *GAP),
        ),
    ),
    "bearing": (
        Plan(
            model="infinitely_wide",
            towards="reynolds_cavitating",
            adds="flow through the sides",
            tells="slenderness",
            features=("slenderness", "thickness_ratio"),
        ),
        Plan(
            model="reynolds",
            towards="reynolds_incompressible",
            adds="cavitation",
            tells="cavitation_number",
            features=("cavitation_number", "divergence"),
        ),
        Plan(
            model="reynolds_incompressible",
            towards="reynolds_cavitating",
            adds="what pressure does to the lubricant",
            tells="pressure_dependence",
            features=("pressure_dependence", "thickness_ratio"),
        ),
        Plan(
            model="reynolds_cavitating",
            towards="homogenized",
            adds="roughness",
            tells="roughness_ratio",
            features=("roughness_ratio",),
        ),
        Plan(
            model="homogenized",
            towards="mixed",
            adds="contact of asperities",
            tells="peak_ratio",
            features=("roughness_ratio", "peak_ratio"),
        ),
        Plan(
            model="homogenized",
            towards="direct",
            adds="the length of the waves",
            tells="roughness_period",
            features=("roughness_period", "roughness_ratio"),
        ),
    ),
    "dry_contact": (
        Plan(
            model="bearing_area",
            towards="elastic_plastic",
            adds="elastic deformation",
            tells="hardness",
            features=PRESSED,
        ),
        Plan(
            model="greenwood_williamson",
            towards="elastic_plastic",
            adds="what asperities do to each other",
            tells="pressure",
            features=PRESSED,
        ),
        Plan(
            model="persson",
            towards="elastic_plastic",
            adds="the surface that an average hides",
            tells="pressure",
            features=PRESSED,
        ),
        Plan(
            model="elastic",
            towards="elastic_plastic",
            adds="yielding",
            tells="hardness",
            features=("pressure", "hardness"),
        ),
    ),
    "seal": (
        Plan(
            model="effective_medium",
            towards="homogenized_leakage",
            adds="the channels of this very surface",
            tells="pressure",
            features=("pressure", "hardness", "waves"),
        ),
        Plan(
            model="homogenized_leakage",
            towards="direct_leakage",
            adds="what happens at the ends of the seal",
            tells="length",
            features=("length", "waves", "pressure"),
        ),
    ),
}

GRIDS: Mapping[str, tuple[str, ...]] = {
    "pocket": ("resolution", "reynolds_number", "film", "aspect", "slope", "loaded"),
    "rough_gap": ("points_per_wave", "height"),
    "bearing": ("resolution", "thickness_ratio", "finest"),
    "dry_contact": ("points_per_wave", "pressure", "hardness"),
    "seal": ("points_per_wave", "pressure", "hardness"),
}
"""What orders the error of a resolution: of every rung of a kind."""

GRIDS_APART: Mapping[tuple[str, str], tuple[str, ...]] = {("bearing", "direct"): ("resolution", "roughness_period")}
"""Of rungs whose grid has something else to follow."""
