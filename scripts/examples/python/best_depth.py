"""Find the depth of a groove that carries most, by two models, with the rows of a sweep as a table of pandas."""

import roughfilm as rf

scene = rf.load_scene("scripts/examples/scenes/pocket.toml")
slow = rf.replace(scene, {"motion.reynolds_number": 40, "geometry.width": "0.2 mm"})
depths = [f"{depth} um" for depth in (5, 10, 15, 20, 25, 30, 40)]
table = rf.sweep(slow, {"geometry.depth": depths}, models=["film", "film_slope"]).to_dataframe()
print(table.pivot(index="geometry.depth", columns="model", values="load_per_area").round(1))
best = table.loc[table.groupby("model")["load_per_area"].idxmax()]
print(best[["model", "geometry.depth", "load_per_area"]], table.attrs["units"]["load_per_area"])
