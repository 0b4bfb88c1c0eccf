#!/usr/bin/python3
"""plot.py FOLDER: draws the plots of `tenon lab -o FOLDER` to FOLDER/plots, as SVG."""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib import ticker

# The same figures make the same file, and text stays text.
matplotlib.rcParams["svg.hashsalt"] = "tenon"
matplotlib.rcParams["svg.fonttype"] = "none"
matplotlib.rcParams["font.family"] = "sans-serif"
MARKERS = "osD^v<>Pp*Xhd8"
COLORS = [*plt.get_cmap("tab10").colors, "black", "navy", "darkgreen", "maroon"]
LINES = ("solid", "dashed", "dotted")


def plain(value, _):
    return f"{value:g}" if 1e-3 <= abs(value) < 1e4 or value == 0 else f"$10^{{{len(f'{value:.0f}') - 1}}}$"


def looks(names):
    """Names with a comma belong to one thing each, which has a colour, and are told apart by their lines."""
    things = list(dict.fromkeys(name.split(", ")[0] for name in names))
    seen = dict.fromkeys(things, 0)
    for name in names:
        thing = name.split(", ")[0]
        color = things.index(thing)
        yield {
            "color": COLORS[color % len(COLORS)],
            "marker": MARKERS[color % len(MARKERS)],
            "linestyle": LINES[seen[thing] % len(LINES)],
        }
        seen[thing] += 1


def draw(plot, path):
    figure, axes = plt.subplots(figsize=(8, 5))
    all_series = [series for series in plot["series"] if series["x"]]
    # The legend has the order of the curves' ends, from above.
    for series, look in sorted(
        zip(all_series, looks([series["name"] for series in all_series])), key=lambda pair: -pair[0]["y"][-1]
    ):
        axes.plot(series["x"], series["y"], markersize=5, label=series["name"], **look)
        if series["cut_off"]:
            axes.plot(series["x"][-1], series["y"][-1], marker="x", markersize=13, color="black", markeredgewidth=1.5)
    if plot["logarithmic_x"]:
        axes.set_xscale("log")
    if plot["logarithmic_y"]:
        axes.set_yscale("log")
    else:
        axes.set_ylim(bottom=0)
    if not plot["logarithmic_x"]:
        axes.xaxis.set_major_locator(ticker.FixedLocator(sorted({x for series in all_series for x in series["x"]})))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(ticker.FuncFormatter(plain))
    axes.set_title(plot["title"])
    axes.set_xlabel(plot["x_label"])
    axes.set_ylabel(plot["y_label"])
    axes.grid(True, which="major", color="#dddddd")
    if any(series["cut_off"] for series in all_series):
        axes.plot([], [], "x", markersize=10, color="black", label="ends at the time limit")
    if len(all_series) > 1:
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
