#!/usr/bin/python3
"""page.py RESULTS PAGE: writes what the bench has measured, as JSON in the folder RESULTS, to a page of Markdown."""
import datetime
import json
import math
import os
import pathlib
import platform
import subprocess
import sys

MESH = "mesh 1920"


class NotMeasured(Exception):
    """What a page needs and the results of its part lack: the options of the bench leave things out."""


def load(folder, part):
    path = folder / f"{part}.json"
    return json.loads(path.read_text()) if path.exists() else []


def rates(rows):
    """{(scene, rays): {contender: millions of rays a second}}, in the order they were measured."""
    table = {}
    for row in rows:
        if "mrays_per_second" in row:
            table.setdefault((row["scene"], row["rays"]), {})[row["contender"]] = row["mrays_per_second"]
    return table


def rate_of(contender, contenders):
    if contender not in contenders:
        raise NotMeasured(f"no rates of '{contender}' beside those of '{next(iter(contenders))}'")
    return contenders[contender]


def figures(rows, name):
    return {row["scene"]: row["value"] for row in rows if row.get("figure") == name}


def number(x):
    return f"{x:.3g}" if x < 1000 else f"{x:,.0f}"


def mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def table(head, lines):
    rule = ["---"] + ["---:"] * (len(head) - 1)
    return ["| " + " | ".join(cells) + " |" for cells in [head, rule, *lines]] + [""]


def with_means(lines, columns):
    """Lines of names and ratios, the geometric mean and the least of each column below."""
    texts = [[name, *map(number, ratios)] for name, ratios in lines]
    if len(lines) > 1:
        by_column = [[ratios[i] for _, ratios in lines] for i in range(columns)]
        texts.append(["**geometric mean**", *(f"**{number(mean(column))}**" for column in by_column)])
        texts.append(["least", *(number(min(column)) for column in by_column)])
    return texts


def kinds_of(measured):
    return list(dict.fromkeys(rays for _, rays in measured))


def by_scene(measured, ratio):
    """A line a scene, a ratio for each kind of ray; scenes that lack a kind are left out."""
    kinds, lines = kinds_of(measured), []
    for scene in dict.fromkeys(scene for scene, _ in measured):
        if all((scene, kind) in measured for kind in kinds):
            lines.append((scene, [ratio(measured[scene, kind]) for kind in kinds]))
    return table(["", *kinds], with_means(lines, len(kinds)))


def is_of_bench(scene):
    return (pathlib.Path(__file__).parent.parent / "scenes" / "bench" / f"{scene}.scad").exists()


def structures_page(rows):
    measured = rates(rows)

    def best_of_others(contenders):
        own = next(iter(contenders))
        others = [(rate, name) for name, rate in contenders.items() if not name.startswith(own)]
        if not others:
            raise NotMeasured(f"no other structure to compare '{own}' with")
        return own, max(others)

    def ratio(contenders):
        own, (best, _) = best_of_others(contenders)
        return contenders[own] / best

    ours = {key: contenders for key, contenders in measured.items() if is_of_bench(key[0])}
    others = {key: contenders for key, contenders in measured.items() if key not in ours}
    examples = ["The examples that come with OpenSCAD:", "", *by_scene(others, ratio)] if others else []
    lines = []
    for (scene, rays), contenders in measured.items():
        own, (best, name) = best_of_others(contenders)
        lines.append([scene, rays, number(contenders[own]), number(best), name])
    return [
        "## Against the structures of the papers",
        "",
        "How many times as fast as the fastest of them on each scene: rays a second, in batches, boundaries alone. Shadow rays",
        "and diffuse ones start above the surface by a millionth of what the camera is away. Structures that would need longer",
        "than a tenth of a second for a round trace a sample of the rays, spread evenly over the picture.",
        "",
        *by_scene(ours, ratio),
        *examples,
        "<details><summary>Millions of rays a second</summary>",
        "",
        *table(["scene", "rays", "cells", "the best other", "which is"], lines),
        "</details>",
        "",
    ]


def embree_page(rows):
    measured = {key: value for key, value in rates(rows).items() if " x" not in key[1]}
    own = "tenon cells"

    def against(contender, ours):
        theirs = f"{contender} {MESH}"
        return by_scene(measured, lambda contenders: rate_of(ours, contenders) / rate_of(theirs, contenders))

    triangles = figures(rows, f"{MESH}: triangles")
    lines = [
        [scene, rays, f"{triangles[scene]:,.0f}",
         *(number(rate_of(f"{own}{how}", value)) for how in ("", ", ray by ray")),
         *(number(rate_of(f"embree {width} {MESH}", value)) for width in (1, 8, 16))]
        for (scene, rays), value in measured.items()
    ]  # fmt: skip
    return [
        "## Against triangle meshes",
        "",
        "Embree 3.13 on a mesh of the same solid that strays a quarter of a pixel at most, 1920 pixels wide. How many times as",
        "fast Tenon is on the solid itself, by the same stored rays, which start above either; below 1 it is slower. In batches,",
        "against packets of 16:",
        "",
        *against("embree 16", own),
        "In batches, against Embree's single rays:",
        "",
        *against("embree 1", own),
        "One ray a call, against single rays:",
        "",
        *against("embree 1", f"{own}, ray by ray"),
        "<details><summary>Millions of rays a second</summary>",
        "",
        *table(["scene", "rays", "triangles", "Tenon", "ray by ray", "Embree 1", "8", "16"], lines),
        "</details>",
        "",
    ]


def povray_page(rows):
    measured = rates(rows)
    return [
        "## Against POV-Ray 3.7",
        "",
        "Whole pictures, shading included, on one core; both draw the same.",
        "",
        *by_scene(measured, lambda contenders: rate_of("tenon cells", contenders) / rate_of("povray", contenders)),
    ]


def figures_page(title, text, rows):
    names = list(dict.fromkeys(row["figure"] for row in rows if "figure" in row))
    scenes = dict.fromkeys(row["scene"] for row in rows if row.get("figure") in names)
    columns = {name: figures(rows, name) for name in names}
    units = {row["figure"]: row["unit"] for row in rows if "figure" in row}
    heads = [f"{name}, {units[name]}" if units[name] else name for name in names]
    lines = [[scene, *(number(columns[n][scene]) if scene in columns[n] else "" for n in names)] for scene in scenes]
    return [f"## {title}", "", text, "", *table(["", *heads], lines)]


def growth_page(rows):
    measured = rates(rows)
    kinds = kinds_of(measured)
    scenes = list(dict.fromkeys(scene for scene, _ in measured))
    lines = [
        [scene, *(number(rate_of("cells", measured[scene, kind])) for kind in kinds),
         number(figures(rows, "building cells")[scene]), number(figures(rows, "memory of it")[scene])]
        for scene in scenes
    ]  # fmt: skip
    large = [scene for scene in scenes if int(scene.split()[0]) >= 1000]
    if not large:
        raise NotMeasured("no scene of 1000 spheres or more")
    begin, *later = large
    fall = [
        [f"{scene}, {whose}",
         *(number(rate_of(name, measured[begin, kind]) / rate_of(name, measured[scene, kind])) for kind in kinds)]
        for scene in later for whose, name in (("Tenon", "cells"), ("Embree", "embree 16 bare balls"))
    ]  # fmt: skip
    return [
        "## Growth",
        "",
        "A box minus n spheres that take the same volume together: millions of rays a second, and what is built for them.",
        "",
        *table(["", *kinds, "building it, s", "memory, MiB"], lines),
        f"How many times slower than with {begin}; beside it Embree's packets of 16 on the spheres alone, by the same rays,",
        "without box and Boolean.",
        "",
        *table(["", *kinds], fall),
    ]


def cores_page(rows):
    measured = rates(rows)
    ratios = {}
    for (scene, label), contenders in measured.items():
        rays, _, cores = label.partition(" x")
        for name, rate in contenders.items() if cores else ():
            ratios[scene, f"{rays}, {cores} cores"] = rate / measured[scene, rays][name]
    return [
        "## Cores",
        "",
        "How many times as fast as on one core, in batches.",
        "",
        *by_scene(ratios, lambda ratio: ratio),
    ]


PARTS = {
    "structures": structures_page,
    "embree": embree_page,
    "povray": povray_page,
    "start": lambda rows: figures_page(
        "From the text to the first ray", "Against making the mesh and building Embree's tree over it.", rows
    ),
    "growth": growth_page,
    "path": lambda rows: figures_page(
        "Path tracing", "As the thesis renders: 8 samples a pixel, 20 surfaces along a path.", rows
    ),
    "cores": cores_page,
}


def machine():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(": ", 1)[1]
    return platform.machine()


def main(folder, page):
    commit = subprocess.run(["git", "describe", "--always", "--dirty=+"], capture_output=True, text=True, check=True)
    lines = [
        "# What the bench says",
        "",
        "Written by `./dev bench`, which measures all of this on your machine; [CONTRIBUTING](../CONTRIBUTING.md) says what each",
        "part does. Rates are medians of five rounds in which the contenders took turns, what is built is built once. Ratios of",
        "one run can be compared, seconds of two runs cannot.",
        "",
        f"{machine()}, {os.cpu_count()} cores; {datetime.date.today()}; commit {commit.stdout.strip()}.",
        "",
    ]
    for part, write in PARTS.items():
        if rows := load(folder, part):
            try:
                lines += write(rows)
            except NotMeasured as lack:
                sys.exit(
                    f"page.py: {folder / part}.json holds {lack}, so {page} stays as it was; "
                    f"measure all of that part with: ./dev bench {part}"
                )
    page.write_text("\n".join(lines).rstrip() + "\n")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
