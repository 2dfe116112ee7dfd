"""Draw the load that inertia adds over the Reynolds number: python scripts/inertia_report.py DIR|SCENE --out PAGE."""

import argparse
from io import StringIO
from pathlib import Path

from matplotlib.figure import Figure

import roughfilm as rf


def main() -> None:
    """Write a page with the difference in load of each pair of models that differ by inertia."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source", type=Path, help="directory of run_batch.py, or a pocket scene (TOML)")
    parser.add_argument("--out", type=Path, default=Path("inertia.html"), metavar="PAGE", help="the page, *.html")
    given, page = parser.parse_args(), StringIO()
    re, names = "motion.reynolds_number", ["reynolds", "inertial_reynolds", "film"]
    try:
        given.out.parent.mkdir(parents=True, exist_ok=True)
        if given.source.is_dir():
            table = rf.read_table(given.source / "table.h5")
            rows = [dict(zip(table, row, strict=True)) for row in zip(*table.values(), strict=True)]
        else:
            rows = rf.sweep(rf.load_scene(given.source), {re: [1, 2, 5, 10, 20, 50, 100, 200]}, models=names)
    except (rf.InputError, OSError) as error:
        raise SystemExit(f"error: {error}") from None
    rows = [{"case": row.get(re), "reynolds_number": row.get(re), **row} for row in rows if row["outcome"] == "solved"]
    axes = (figure := Figure()).add_subplot(xlabel="Re", ylabel="load added by inertia, Fy+", xscale="log")
    for plain, inertial in ((names[0], names[1]), (names[0], names[2]), ("stokes", "navier_stokes")):
        less, more = ({row["case"]: row for row in rows if row["model"] == name} for name in (plain, inertial))
        points = [(less[n]["reynolds_number"], more[n]["load_plus"] - less[n]["load_plus"]) for n in less if n in more]
        axes.plot(*(zip(*points, strict=True) if points else ((), ())), "o", label=f"{inertial} - {plain}")
    axes.legend()
    figure.savefig(page, format="svg")
    given.out.with_suffix(".html").write_text(f"<!doctype html>{page.getvalue()}", encoding="utf-8")


if __name__ == "__main__":
    main()
