"""Solve one problem by one solver in this process: run.py SOLVER HEIGHTS.npy PROBLEM.json RESULT.json.

Pressures are over E*, times in seconds: of the set-up, of the solver alone, and of a first small problem.
"""

import importlib
import json
import math
import resource
import sys
import time
from importlib import metadata
from pathlib import Path

import numpy as np
from violation import judge

SMALL = 128


def clock():
    return np.array([time.process_time(), time.perf_counter()])


def series(prepare, heights, problem, tolerance):
    """One solution per load, each after the one before it: times, and what is wrong with each."""
    started = clock()
    solve = prepare(heights, problem)
    setup = clock() - started
    spent, solutions, state = np.zeros(2), [], None
    hardness = math.inf if problem["hardness"] is None else problem["hardness"]
    for load in problem["loads"]:
        started = clock()
        pressure, iterations, state = solve(load, tolerance, state)
        spent += clock() - started
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
        judged = judge(heights, pressure, spacing=problem["spacing"], load=load, hardness=hardness)
        solutions.append({"load": load, "iterations": iterations, "peak_bytes": peak, **judged})
    return {
        "tolerance": tolerance,
        "setup_cpu_s": setup[0],
        "cpu_s": spent[0],
        "wall_s": spent[1],
        "violation": max(solution["violation"] for solution in solutions),
        "solutions": solutions,
    }


def attempt(prepare, heights, problem, tolerance):
    try:
        return series(prepare, heights, problem, tolerance)
    except ArithmeticError as error:
        return {"tolerance": tolerance, "violation": math.inf, "failed": str(error)}


def best(prepare, heights, problem):
    """Looser tolerances first, until the pressure is good enough; the best where none is. The least of the times."""
    attempts = []
    for tolerance in problem["tolerances"]:
        attempts.append(attempt(prepare, heights, problem, tolerance))
        if attempts[-1]["violation"] <= problem["violation"]:
            break
    found = min(attempts, key=lambda run: run["violation"])
    if "failed" not in found:
        again = [series(prepare, heights, problem, found["tolerance"]) for _ in range(problem["repeats"] - 1)]
        for name in ("setup_cpu_s", "cpu_s", "wall_s"):
            found[name] = min(run[name] for run in [found, *again])
    return found


def main():
    solver, heights, problem, result = sys.argv[1:]
    heights, problem = np.load(heights), json.loads(Path(problem).read_text())
    solver = importlib.import_module(solver)
    step = max(1, heights.shape[0] // SMALL)
    small = problem | {"spacing": [step * length for length in problem["spacing"]], "loads": problem["loads"][:1]}
    started = clock()
    attempt(solver.prepare, np.ascontiguousarray(heights[::step, ::step]), small, problem["tolerances"][0])
    first = clock() - started
    found = best(solver.prepare, heights, problem)
    Path(result).write_text(
        json.dumps({"version": metadata.version(solver.NAME), "first_small_cpu_s": first[0], **found})
    )


if __name__ == "__main__":
    main()
