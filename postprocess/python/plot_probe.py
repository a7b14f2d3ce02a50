#!/usr/bin/env python3
"""Reads a run of both methods and plots a probe over time, with the exact solution where there is one.

    python3 postprocess/python/plot_probe.py results/vibrating-bar
    python3 postprocess/python/plot_probe.py results/annulus-pulse --probe width --out width.png

Needs pandas, h5py and matplotlib (Debian: python3-pandas python3-h5py python3-matplotlib). An example
to start from: how history.csv, exact.csv and the frames (HDF5) are read is all that it shows.
"""

import argparse
import json
import sys
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")  # a file, no window
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

STYLES = {"sph": ("SPH", "-", "#0067a5"), "fvm": ("finite volume", "--", "#c8500a")}


def columns_of_probes(folder):
    """Columns of history.csv that are probes: [[probe]] of the case, in its order."""
    summary = json.loads((folder / "summary.json").read_text())
    return [f"{name} [{q['unit']}]" for name, q in summary["quantities"].items()]


def last_frame(folder):
    """Time, points [n, 3], displacements [n, 3] and von Mises stresses [n] of the last frame; None where no
    field was written."""
    series = folder / "run.hdf.series"
    if not series.exists():
        return None
    last = json.loads(series.read_text())["files"][-1]
    with h5py.File(folder / last["name"], "r") as file:
        points = file["VTKHDF/Points"][...]
        displacement = file["VTKHDF/PointData/displacement [m]"][...]
        von_mises = file["VTKHDF/PointData/von_mises_stress [Pa]"][...]
    return last["time"], points, displacement, von_mises


def chosen(folders, asked):
    columns = columns_of_probes(folders[0])
    if not columns:
        sys.exit(f"{folders[0]}: this case has no [[probe]]; histories of energies are in history.csv")
    if asked is None:
        return columns[0]
    for column in columns:
        if asked in (column, column.rpartition(" [")[0]):
            return column
    sys.exit(f"no probe is called '{asked}'; there are: {', '.join(columns)}")


def main():
    parser = argparse.ArgumentParser(description="plots a probe of a run of both methods")
    parser.add_argument("run", type=Path, help="folder of the run: has sph/ or fvm/ in it")
    parser.add_argument("--probe", help="its name (default: the first of the case)")
    parser.add_argument("--out", type=Path, default=Path("probe.png"), help="picture to write")
    arguments = parser.parse_args()
    folders = [arguments.run / m for m in STYLES if (arguments.run / m / "summary.json").exists()]
    if not folders:
        sys.exit(f"{arguments.run}: no run here; 'diptych run CASE --out {arguments.run}' makes one")
    column = chosen(folders, arguments.probe)

    figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
    for folder in folders:
        title, dashes, colour = STYLES[folder.name]
        history = pd.read_csv(folder / "history.csv")
        axes.plot(history["time [s]"], history[column], dashes, color=colour, label=title)
        print(f"{title}: {column} is {history[column].iloc[-1]:.6g} at t = {history['time [s]'].iloc[-1]:.6g} s")
        frame = last_frame(folder)
        if frame is not None:
            time, points, displacement, von_mises = frame
            far = np.linalg.norm(displacement, axis=1).argmax()
            print(f"  frame at {time:.6g} s: {len(points)} nodes, largest displacement "
                  f"{np.linalg.norm(displacement[far]):.6g} m, at X = {np.round(points[far], 6).tolist()}; "
                  f"largest von Mises stress {von_mises.max():.6g} Pa")
    exact_file = folders[-1] / "exact.csv"
    if exact_file.exists():
        exact = pd.read_csv(exact_file)
        if column in exact:
            axes.plot(exact["time [s]"], exact[column], ":", color="black", label="exact")
    axes.set(xlabel="time [s]", ylabel=column)
    axes.legend()
    figure.savefig(arguments.out, dpi=150)
    print(f"output: {arguments.out}")


if __name__ == "__main__":
    main()
