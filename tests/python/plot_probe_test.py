#!/usr/bin/env python3
"""The example for Python users on a run of the program: what it prints is what the run says of itself.

    plot_probe_test.py DIPTYCH SOURCE_DIR
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import pandas as pd


def main():
    program, source = sys.argv[1], Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as scratch:
        run, picture = Path(scratch) / "run", Path(scratch) / "probe.png"
        subprocess.run([program, "run", "vibrating-bar", "--quiet", "--threads", "1", "--out", run, "--set",
                        "output.frames=20", "--set", "output.fields=true", "--set", "time.end=0.2"],
                       check=True, stdout=subprocess.DEVNULL)
        example = [sys.executable, source / "postprocess/python/plot_probe.py", run]
        text = subprocess.run([*example, "--out", picture], check=True, capture_output=True, text=True).stdout
        assert picture.read_bytes().startswith(b"\x89PNG"), "no picture"
        assert picture.stat().st_size > 10000, "an empty picture"
        for method in ("sph", "fvm"):
            summary = json.loads((run / method / "summary.json").read_text())
            assert f"is {summary['quantities']['end displacement']['final']:.6g} at" in text, text
            # the column that the report draws over both is there, and is another than the computed one
            exact, history = (pd.read_csv(run / method / name) for name in ("exact.csv", "history.csv"))
            column = "end displacement [m]"
            assert (exact["time [s]"] == history["time [s]"]).all()
            error = (exact[column] - history[column]).abs().max() / exact[column].abs().max()
            assert 0 < error < 0.05, error  # 0.01 measured at this level
        assert len(re.findall(r"625 nodes, largest displacement", text)) == 2, text
        with h5py.File(run / "sph" / "frame_0020.hdf", "r") as file:
            largest = abs(file["VTKHDF/PointData/displacement [m]"][...]).max()
            von_mises = file["VTKHDF/PointData/von_mises_stress [Pa]"][...].max()
        told = float(re.search(r"largest displacement (\S+) m", text)[1])  # of SPH, which comes first
        assert abs(told - largest) <= 1e-5 * largest, (largest, text)
        told = float(re.search(r"largest von Mises stress (\S+) Pa", text)[1])
        assert von_mises > 0 and abs(told - von_mises) <= 1e-5 * von_mises, (von_mises, text)
        wrong = subprocess.run([*example, "--probe", "tip"], capture_output=True, text=True)
        assert wrong.returncode == 1 and "there are: end displacement [m]" in wrong.stderr, wrong.stderr


if __name__ == "__main__":
    main()
