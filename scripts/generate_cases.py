"""Write the OpenFOAM cases of a study: python scripts/generate_cases.py STUDY --out DIR."""

import argparse

import roughfilm as rf


def main() -> None:
    """Write the cases with their scripts, and print the directory of each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study", metavar="STUDY", help="the study file (TOML); it names the models and resolutions")
    parser.add_argument("--out", required=True, metavar="DIR", help="where the cases go; DIR/Allrun.all runs them all")
    parser.add_argument("--dialect", help="com or org, the family of OpenFOAM that will run them")
    given = parser.parse_args()
    try:
        print(*rf.write_study(given.study, given.out, dialect=given.dialect), sep="\n")
    except rf.InputError as error:
        raise SystemExit(f"error: {error}") from None


if __name__ == "__main__":
    main()
