"""Write the OpenFOAM case of every case of a study: python scripts/generate_cases.py STUDY --out DIR."""

import argparse
from pathlib import Path

import roughfilm as rf


def main() -> None:
    """Write ``DIR/CASE/MODEL``, each with its Allrun, and print the directories."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study", metavar="STUDY", help="the study file (TOML)")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where the cases go: DIR/CASE/MODEL")
    parser.add_argument("--model", default="navier_stokes", help="navier_stokes or stokes")
    parser.add_argument("--resolution", type=int, help="mesh columns; the model's default if left out")
    given = parser.parse_args()
    try:
        for case in rf.load_study(given.study).cases:
            directory = given.out / case.name / given.model
            rf.write_case(case.scene, directory, model=given.model, resolution=given.resolution)
            print(directory)
    except (rf.InputError, rf.UnavailableError) as error:
        raise SystemExit(f"error: {error}") from None


if __name__ == "__main__":
    main()
