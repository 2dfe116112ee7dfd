"""Draw the load that inertia adds over the Reynolds number: python scripts/inertia_report.py DIR|SCENE --out PAGE."""

import argparse
from io import StringIO
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import roughfilm as rf

PAIRS = (("reynolds", "inertial_reynolds"), ("reynolds", "film"), ("stokes", "navier_stokes"))


def main() -> None:
    """Write a page with the difference in load of each pair of models that differ by inertia."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source", type=Path, help="directory of run_batch.py, or a pocket scene (TOML)")
    parser.add_argument("--out", type=Path, default=Path("inertia.html"), metavar="PAGE", help="the page (HTML)")
    given, figure, drawing = parser.parse_args(), Figure(figsize=(7, 4.5)), StringIO()
    number, case = "motion.reynolds_number", "motion.reynolds_number"
    try:
        if given.source.is_dir():
            number, case = "reynolds_number", "case"
            table = rf.read_table(given.source / "table.h5")
            rows = [dict(zip(table, row, strict=True)) for row in zip(*table.values(), strict=True)]
        else:
            rows = rf.sweep(rf.load_scene(given.source), {number: np.geomspace(1, 200, 12)}, models=[*PAIRS[0], "film"])
    except rf.InputError as error:
        raise SystemExit(f"error: {error}") from None
    answers = {(row["model"], row[case]): row for row in rows if row["outcome"] == "solved"}
    axes = figure.add_subplot(xlabel="Reynolds number", ylabel="load added by inertia, p+", xscale="log")
    for plain, inertial in PAIRS:
        both = [(row, answers.get((inertial, key))) for (model, key), row in answers.items() if model == plain]
        points = [(row[number], more["load_plus"] - row["load_plus"]) for row, more in both if more]
        axes.plot(*np.reshape(points, (-1, 2)).T, "o", label=f"{inertial} - {plain}")
    axes.legend()
    figure.savefig(drawing, format="svg")
    given.out.write_text(f"<!doctype html><title>Inertia</title>{drawing.getvalue()}", encoding="utf-8")


if __name__ == "__main__":
    main()
