#!/usr/bin/python3
"""plot.py FOLDER: draws the plots of `tenon lab -o FOLDER` to FOLDER/plots, as SVG."""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib import ticker

# The same figures make the same file.
matplotlib.rcParams["svg.hashsalt"] = "tenon"
MARKERS = "osD^v<>Pp*Xhd8"
COLORS = plt.get_cmap("tab20").colors[::2] + plt.get_cmap("tab20").colors[1::2]


def plain(value, _):
    return f"{value:g}" if 1e-3 <= abs(value) < 1e4 or value == 0 else f"{value:.0e}"


def draw(plot, path):
    figure, axes = plt.subplots(figsize=(8, 5))
    for i, series in enumerate(plot["series"]):
        color = COLORS[i % len(COLORS)]
        axes.plot(series["x"], series["y"], marker=MARKERS[i % len(MARKERS)], markersize=5, color=color, label=series["name"])
        if series["cut_off"] and series["x"]:
            axes.plot(series["x"][-1], series["y"][-1], marker="x", markersize=13, color="black", markeredgewidth=1.5)
    if plot["logarithmic_x"]:
        axes.set_xscale("log")
    if plot["logarithmic_y"]:
        axes.set_yscale("log")
    else:
        axes.set_ylim(bottom=0)
    for axis, logarithmic in ((axes.xaxis, plot["logarithmic_x"]), (axes.yaxis, plot["logarithmic_y"])):
        if not logarithmic:
            axis.set_major_formatter(ticker.FuncFormatter(plain))
    axes.set_title(plot["title"])
    axes.set_xlabel(plot["x_label"])
    axes.set_ylabel(plot["y_label"])
    axes.grid(True, which="major", color="#dddddd")
    if any(series["cut_off"] for series in plot["series"]):
        axes.plot([], [], "x", markersize=10, color="black", label="ends at the time limit")
    if len(plot["series"]) > 1:
        axes.legend(fontsize="small", loc="center left", bbox_to_anchor=(1.01, 0.5))
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None}, facecolor="white")
    plt.close(figure)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    (folder / "plots").mkdir(exist_ok=True)
    for path in sorted((folder / "data").glob("*.json")):
        for plot in json.loads(path.read_text())["plots"]:
            draw(plot, folder / "plots" / (plot["name"] + ".svg"))


main()
