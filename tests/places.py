"""Where the tests find the project, its examples, and measured surfaces."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "scripts" / "examples" / "scenes"
SURFACES = ROOT / "scripts" / "examples" / "surfaces"
STUDIES = ROOT / "scripts" / "examples" / "studies"
MEASURED = Path(os.environ.get("ROUGHFILM_SURFACES", ROOT.parent / "shared" / "surfaces"))
"""Instrument files that are not the project's own; ROUGHFILM_SURFACES may name another place."""
SAMPLES = MEASURED.parent / "field" / "surfaces"
"""Samples of formats, beside them."""
BENCHMARKS = ROOT / "runs" / "benchmarks"
