#!/usr/bin/env python3
"""Heights of heaps of discs by Box2D and by FEMDEM from the same random starts, and whether they differ by more than chance and shape explain.

    compare_heaps.py run BUILD PROGRAM STARTS OUT     runs box2d/case.yaml from so many starts, by all; writes OUT/heaps.csv
    compare_heaps.py check [HEAPS]                    prints and checks the claims on heaps.csv (default: box2d/heaps.csv, the kept ones)
    compare_heaps.py again HEAPS                      whether the heaps of HEAPS are such as the kept ones

    PROGRAM: what build.sh box2d BUILD prints; runs that are in OUT are not made again

A heap is one of many, so that single ones cannot be compared.  The means of several can: their ratio has to lie in the range that follows
from the discs' shapes and stiffness (`expected`), but for what chance leaves open, the 99 % interval of the means' ratio (Welch's).  That
this could fail is shown by heaps of Box2D's without friction: their ratio has to lie outside, by more than chance.
"""
import csv
import json
import math
import pathlib
import random
import statistics
import subprocess
import sys

import h5py
from scipy.stats import t as student

HERE = pathlib.Path(__file__).resolve().parent / "box2d"
JITTER = 0.02  # m: the most by which each disc's start is moved; discs 0.14 m wide, 0.188 m apart, touch at 0.024 m
SLOP = 0.005   # over the radius: two discs' overlap that Box2D leaves (b2_linearSlop)
SMOOTH = "Box2D without friction"
# of case.yaml
RADIUS, SIZE, FIRST, STEP, NUMBER, WIDTH = 0.07, 0.036, (0.15, 0.3), (0.188, 0.19), (10, 10), 2.0
YOUNG, POISSON, EXCESS, GRAVITY = 4e6, 0.3, 1500.0, 9.81  # Pa, -, kg/m3 above the fluid's density, m/s2


def bodies(start):
    """solid.bodies of a start: the discs of case.yaml, each moved by chance."""
    chance = random.Random(start)
    centres = [[FIRST[c] + (i, j)[c] * STEP[c] + chance.uniform(-JITTER, JITTER) for c in (0, 1)]
               for j in range(NUMBER[1]) for i in range(NUMBER[0])]
    disc = "{shape: disc, centre: [%.6f, %.6f], radius: %g, size: %g, material: disc}"
    return "[" + ", ".join(disc % (x, y, RADIUS, SIZE) for x, y in centres) + "]"


def height(folder):
    """Mean height of the discs' centres at the end, m: Box2D's program reports it, of FEMDEM's nodes it is the mean (alike on each disc)."""
    solid = json.loads((folder / "summary.json").read_text())["participants"]["solid"]
    if "mean_height" in solid:
        return solid["mean_height"], solid["overlap"]
    with h5py.File(folder / "solid.h5") as file:
        return float(file["snapshot"][max(file["snapshot"])]["solid/points"][:, 1].mean()), math.nan


def run(build, program, starts, out):
    out.mkdir(parents=True, exist_ok=True)
    with open(out / "heaps.csv", "w") as file:
        print("solid,start,mean height [m],overlap [radius]", file=file)
        smooth = ["--set", "solid.materials.disc.friction=0", "--set", "solid.walls.friction=0"]
        for name, more in (("Box2D", ["--solid", program]), (SMOOTH, ["--solid", program, *smooth]), ("FEMDEM", [])):
            for start in range(starts):
                folder = out / ("%s-%d" % (name.lower().replace(" ", "_"), start))
                command = [HERE.parents[2] / "scripts/launch.sh", "--bin", build, HERE / "case.yaml", *more]
                command += ["--set", "solid.bodies=" + bodies(start), "--set", "output.folder=%s" % folder]
                if not (folder / "summary.json").exists():
                    with open("%s.log" % folder, "w") as log:
                        subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, check=True)
                print("%s,%d,%.4f,%.4f" % (name, start, *height(folder)), file=file, flush=True)


def read(path):
    """Heights of each solid's heaps; the largest overlap of Box2D's."""
    rows = list(csv.DictReader(open(path)))
    heights = {name: [float(row["mean height [m]"]) for row in rows if row["solid"] == name] for name in ("Box2D", SMOOTH, "FEMDEM")}
    return heights, max(float(row["overlap [radius]"]) for row in rows if row["solid"] == "Box2D")


def expected():
    """Range of the ratio of mean heights, Box2D's over FEMDEM's, of like packings: height grows with the square of the distance at which discs touch.

    FEMDEM's discs are polygons of the disc's area, which touch at twice a radius between those of the circles in and around them, and are compressed by
    the heap's weight, most at the floor: by a cylinder's diametral compression (Johnson, Contact Mechanics, 5.57) and by contact's overlap d, at
    which the potential 3 depth/h, h the height of an element, times the penalty E, over the width 2 sqrt(R d) in the mean 2/3 as deep, carries the
    force.  It falls linearly to the top: 2/3 of the floor's compression in the mean height.  Box2D's discs are circles, which overlap by SLOP."""
    rings = max(2, math.ceil(math.pi * RADIUS / (3 * SIZE)))
    sides = 6 * rings
    around = math.sqrt(2 * math.pi / (sides * math.sin(2 * math.pi / sides)))
    inside = around * math.cos(math.pi / sides)
    pressure = EXCESS * GRAVITY * NUMBER[0] * NUMBER[1] * math.pi * RADIUS**2 / WIDTH
    force, modulus = pressure * 2 * RADIUS, YOUNG / (1 - POISSON**2)
    half_width = math.sqrt(4 * force * RADIUS / 2 / (math.pi * modulus / 2))
    elastic = 2 * force / (math.pi * modulus) * (2 * math.log(4 * RADIUS / half_width) - 1)
    overlap = (force * RADIUS / rings / (4 * YOUNG * math.sqrt(RADIUS)))**(2 / 3)
    soft = 2 / 3 * (elastic + overlap) / (2 * RADIUS)
    return ((1 - SLOP / 2) / around)**2, 1 / (inside**2 * (1 - soft))


def compare(heaps, reference):
    """Ratio of the means and half of its 99 % interval."""
    n, mean = [len(h) for h in (heaps, reference)], [statistics.mean(h) for h in (heaps, reference)]
    variance = [statistics.variance(h) / len(h) / statistics.mean(h)**2 for h in (heaps, reference)]  # of the mean, relative
    error = math.sqrt(sum(variance))
    freedom = error**4 / sum(v**2 / (m - 1) for v, m in zip(variance, n))
    return mean[0] / mean[1], student.ppf(0.995, freedom) * error


def check(path):
    heaps, overlap = read(path)
    low, high = expected()
    for name, h in heaps.items():
        print("%s: %d heaps, mean height %.4f m, standard deviation %.1f %%" % (name, len(h), statistics.mean(h), 100 * statistics.stdev(h) / statistics.mean(h)))
    claims, good = [], True
    for name in ("Box2D", SMOOTH):
        ratio, chance = compare(heaps[name], heaps["FEMDEM"])
        print("%s over FEMDEM: %.4f; of like packings %.4f to %.4f; chance %.4f" % (name, ratio, low, high, chance))
        outside = max(low - ratio, ratio - high)
        claims.append(("the ratio is explained", outside <= chance) if name == "Box2D" else ("that without friction is not", outside > chance))
    claims.append(("Box2D's discs touch at the case's radius: overlap %.4f" % overlap, SLOP / 2 <= overlap <= 2 * SLOP))
    for what, holds in claims:
        print("%s: %s" % (what, "yes" if holds else "FAILED"))
        good &= holds
    return good


def again(path):
    """Each new height lies where the kept ones of its program say that one more is, with 99.9 %."""
    kept, new, good = read(HERE / "heaps.csv")[0], read(path)[0], True
    for name, h in kept.items():
        mean, n = statistics.mean(h), len(h)
        reach = student.ppf(0.9995, n - 1) * statistics.stdev(h) * math.sqrt(1 + 1 / n)
        for height_ in new[name]:
            good &= abs(height_ - mean) <= reach
            print("%s: %.4f m, kept %.4f +- %.4f m" % (name, height_, mean, reach))
    return good


def main():
    if sys.argv[1:2] == ["run"] and len(sys.argv) == 6:
        run(pathlib.Path(sys.argv[2]), sys.argv[3], int(sys.argv[4]), pathlib.Path(sys.argv[5]).resolve())
    elif sys.argv[1:2] == ["check"] and len(sys.argv) <= 3:
        sys.exit(not check(pathlib.Path(sys.argv[2]) if sys.argv[2:] else HERE / "heaps.csv"))
    elif sys.argv[1:2] == ["again"] and len(sys.argv) == 3:
        sys.exit(not again(pathlib.Path(sys.argv[2])))
    else:
        sys.exit(__doc__)


main()
