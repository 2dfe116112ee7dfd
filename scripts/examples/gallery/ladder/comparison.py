"""Models compared on one scene
============================

What does each model of a journal bearing leave out? compare runs all that apply and measures their errors against the
most complete one. Without side flow the load is three times too large; without cavitation it is 47 % too large.
Constant density changes it by 0.2 %, ten times as much as the grid could.
"""

import matplotlib.pyplot as plt

import roughfilm as rf

geometry = {"shape": "journal", "radius": "25 mm", "clearance": "25 um", "width": "50 mm", "eccentricity": 0.6}
oil = {"viscosity": "0.02 Pa*s", "compressibility": {"law": "constant_bulk_modulus", "bulk_modulus": "1.6 GPa"}}
entries = {"name": "journal", "kind": "bearing", "geometry": geometry, "lubricant": oil, "motion": {"speed": "2 m/s"}}
comparison = rf.compare(rf.read_scene(entries))
errors, best = comparison.errors, comparison.results[comparison.best]

fig, ax = plt.subplots(figsize=(6, 3.2), layout="constrained")
quantities = {"load_per_width": "load per width", "friction_per_width": "friction per width"}
for place, (name, title) in enumerate(quantities.items()):
    values = [100 * found[name] for found in errors.values()]
    bars = ax.barh([number + 0.4 * place for number in range(len(errors))], values, height=0.38, label=title)
    ax.bar_label(bars, [f" {value:+.3g} %" for value in values])
ax.set_yticks([number + 0.2 for number in range(len(errors))], list(errors))
ax.set(xlabel=f"difference from {comparison.best} (%)", xlim=(-85, 270), title="Models of a journal bearing")
ax.legend(loc="upper right")
plt.show()
load_errors = {model: found["load_per_width"] for model, found in errors.items()}
uncertainty = comparison.uncertainty["load_per_width"]
print({model: f"{error:+.2%}" for model, error in load_errors.items()}, f"± {uncertainty:.2%}")
