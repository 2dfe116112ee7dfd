"""The picture at the top of the README: a scene, its ladder of models, and what other kinds of scene answer.

``python -m scripts.manual.overview FILE.png`` solves the scenes, which takes about 20 s and OpenFOAM, and draws them.
"""

import sys
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.tri import LinearTriInterpolator, Triangulation

import roughfilm as rf

SCENES = "scripts/examples/scenes"
TOLERANCE = 0.05
NAMES_ON_THE_LEFT = {"stokes", "navier_stokes"}


def draw(path: str) -> None:
    """Solve the scenes and write the picture (PNG)."""
    mpl.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False})
    figure = Figure(figsize=(11, 6.4), layout="constrained")
    parts: Any = figure.subfigures(2, 1, height_ratios=(1.1, 1))
    above, below = parts
    flow, ladder = above.subplots(1, 2, width_ratios=(1.15, 1))
    groove = rf.load_scene(f"{SCENES}/pocket.toml", set={"geometry.depth": "22.5 um"})
    rf.compare(groove, models=["reynolds", "film_slope"])  # loads what is compiled
    comparison = rf.compare(groove)
    _flow(flow, comparison.results["navier_stokes"])
    _ladder(ladder, comparison)
    bearing, contact, seal, friction = below.subplots(1, 4)
    _bearing(bearing)
    _contact(contact)
    _seal(seal)
    _friction(friction)
    figure.savefig(path, dpi=110)


def _flow(axes: Axes, result: rf.Result) -> None:
    """Streamlines on the speed in the middle of the period."""
    vertices, velocity = result.fields["vertices"].values, result.fields["cell_velocity"].values
    centres = 0.25 * (vertices[:-1, :-1] + vertices[1:, :-1] + vertices[:-1, 1:] + vertices[1:, 1:])
    x, y = 1e3 * centres[..., 0], 1e6 * centres[..., 1]
    wall = result.quantities["load_per_area"]
    speed = np.linalg.norm(velocity, axis=-1)
    shown = axes.pcolormesh(1e3 * vertices[..., 0], 1e6 * vertices[..., 1], speed, cmap="viridis", rasterized=True)
    triangles = Triangulation(x.ravel(), y.ravel())
    grid_x, grid_y = np.linspace(-0.24, 0.24, 240), np.linspace(y.min(), y.max(), 120)
    inside = np.meshgrid(grid_x, grid_y)
    u, v = (LinearTriInterpolator(triangles, 1e3 * velocity[..., k].ravel())(*inside) for k in range(2))
    axes.streamplot(grid_x, grid_y, u, 1e3 * v, color="white", linewidth=0.7, density=(0.9, 0.8), arrowsize=0.7)
    axes.set(xlim=(-0.24, 0.24), xlabel="position along the sliding, mm", ylabel="height, µm")
    axes.set_title(f"A scene: a groove under a sliding wall\ninertia lifts it with {_shown(wall)}", loc="left")
    axes.figure.colorbar(shown, ax=axes, label="speed, m/s", pad=0.02)


def _ladder(axes: Axes, comparison: Any) -> None:
    """Error of the load over CPU time, with the cheapest model within the tolerance."""
    truth = comparison.results[comparison.best]["load"].value
    errors = {name: abs(result["load"].value / truth - 1) for name, result in comparison.results.items()}
    errors[comparison.best] = comparison.results[comparison.best].expected_error["load_plus"]
    times = {name: result.numerics.cpu_s for name, result in comparison.results.items()}
    chosen = min((name for name in errors if errors[name] <= TOLERANCE), key=times.__getitem__)
    axes.axhspan(1e-2, 100 * TOLERANCE, color="#1a7f37", alpha=0.08)
    for name, error in errors.items():
        colour = "#1a7f37" if name == chosen else "#2166ac"
        axes.plot(times[name], 100 * error, "o", color=colour, markersize=9 if name == chosen else 6)
        left = name in NAMES_ON_THE_LEFT
        axes.annotate(
            name,
            (times[name], 100 * error),
            (-8 if left else 8, 0),
            textcoords="offset points",
            ha="right" if left else "left",
            va="center",
        )
    axes.text(2.4e-4, 92 * TOLERANCE, f"within {100 * TOLERANCE:.0f} %", color="#1a7f37", va="top")
    axes.set(xscale="log", yscale="log", xlim=(2e-4, 10), ylim=(0.1, 300))
    axes.set(xlabel="CPU time, s", ylabel="error of the load, %")
    factor = times[comparison.best] / times[chosen]
    axes.set_title(
        f"Its ladder of models: {chosen} is within 5 %\nat 1/{factor:.0f} of the cost of {comparison.best}", loc="left"
    )


def _bearing(axes: Axes) -> None:
    result = rf.solve(rf.load_scene(f"{SCENES}/journal.toml"), model="reynolds_cavitating")
    fields = {name: field.values for name, field in result.fields.items()}
    shown = axes.pcolormesh(1e3 * fields["x"], 1e3 * fields["y"], 1e-6 * fields["pressure"], rasterized=True)
    axes.set(xlabel="along the circumference, mm", ylabel="along the axis, mm")
    _titled(axes, shown, "Journal bearing", f"carries {_shown(result['load'])}", "pressure, MPa")


def _contact(axes: Axes) -> None:
    scene = rf.load_scene(f"{SCENES}/dry_contact.toml")
    result = rf.solve(scene, model="elastic_plastic")
    pressure = np.where(result.fields["pressure"].values > 0, 1e-9 * result.fields["pressure"].values, np.nan)
    shown = axes.imshow(pressure.T, origin="lower", cmap="inferno_r", extent=_extent(scene))
    axes.set(xlabel="x, µm", ylabel="y, µm")
    area = result["area_fraction"]
    _titled(axes, shown, "Rough steel under load", f"touches on {100 * area.value:.1f} % of its area", "pressure, GPa")


def _seal(axes: Axes) -> None:
    scene = rf.load_scene(f"{SCENES}/seal.toml")
    result = rf.solve(scene, model="direct_leakage")
    flow = result.fields["flow"].values
    norm = LogNorm(flow.max() * 1e-4, flow.max())
    axes.set_facecolor("0.75")
    shown = axes.imshow(
        np.where(flow > 0, flow, np.nan).T, origin="lower", cmap="Blues", norm=norm, extent=_extent(scene)
    )
    axes.set(xlabel="x, µm", ylabel="y, µm")
    leakage = 3600 * 1e3 * result["leakage_per_width"].value
    _titled(axes, shown, "Elastomer seal", f"leaks {leakage:.3f} g/h per metre", "flow, m²/s; grey: contact")


def _friction(axes: Axes) -> None:
    scene = rf.load_scene(f"{SCENES}/rough_washer.toml")
    (curve,) = rf.stribeck(scene, speeds=[*np.geomspace(0.01, 10, 13)], loads=[1e6], resolution=64)
    axes.plot([p.speed for p in curve.points], [p.friction_coefficient for p in curve.points], "o-", markersize=3)
    axes.set(xscale="log", xlabel="speed, m/s", ylabel="friction coefficient", ylim=(0, None))
    lift_off = "" if curve.lift_off is None else f"lifts off at {curve.lift_off.speed:.2g} m/s"
    axes.set_title(f"Rough washer\n{lift_off}", loc="left")


def _titled(axes: Axes, shown: Any, title: str, answer: str, label: str) -> None:
    axes.set_title(f"{title}\n{answer}", loc="left")
    axes.figure.colorbar(shown, ax=axes, label=label, location="bottom", shrink=0.9)


def _extent(scene: Any) -> tuple[float, float, float, float]:
    """The ends of a surface, µm."""
    length, width = scene.surface().size
    return 0.0, 1e6 * length, 0.0, 1e6 * width


def _shown(quantity: rf.Quantity) -> str:
    """A pressure or a force in kPa or kN."""
    unit = {"Pa": "kPa", "N": "kN"}[quantity.unit]
    return f"{quantity.value / 1e3:.4g} {unit}"


if __name__ == "__main__":
    draw(sys.argv[1])
