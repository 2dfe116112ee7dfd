"""Solve every case of a study, or go on where it was stopped: python scripts/run_batch.py STUDY --out DIR."""

import argparse

import roughfilm as rf


def main() -> None:
    """Solve what is missing in DIR, write its tables, and print how many cases each model solved."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study", metavar="STUDY", help="the study file (TOML)")
    parser.add_argument("--out", required=True, metavar="DIR", help="where cases, results and tables go")
    parser.add_argument("--jobs", type=int, help="processes; one for each core if left out")
    given = parser.parse_args()
    try:
        table = rf.run_study(given.study, given.out, processes=given.jobs)
    except (rf.InputError, rf.UnavailableError) as error:
        raise SystemExit(f"error: {error}") from None
    for setting in dict.fromkeys(table["setting"].tolist()):
        outcomes = table["outcome"][table["setting"] == setting]
        print(f"{setting}: {(outcomes == 'solved').sum()} of {len(outcomes)} cases solved")


if __name__ == "__main__":
    main()
