"""What the scripts that remake generated pages share."""

import argparse
import json
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/diptych"


def parser_of(doc):
    """Knows where pages and pictures go: beside the script, but where their scripts are tried (benchmarks/pages)."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("--into", type=Path, default=ROOT / "benchmarks", metavar="FOLDER", help="of the page (default benchmarks)")
    return parser


def commit_of_program():
    """What the program says of itself."""
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([PROGRAM, "run", ROOT / "benchmarks/cases/affine-motion", "--method", "fvm", "--quiet", "--no-fields",
                        "--out", scratch], check=True, stdout=subprocess.DEVNULL)
        return json.loads((Path(scratch) / "fvm/summary.json").read_text())["provenance"]["commit"]
