"""The model of scripts/scaling.py: what a rank computes in a step, fitted to the runs, and a step on many ranks, on paper.

Of each participant, with n elements (of the fluid, of the fluid near the solid, of the solid) on P ranks, the busiest rank computes

    w = a + b n/P + c messages + d collectives      a, b, c, d >= 0; collectives count where P > 1

by least squares of relative errors.  On paper a step takes the sum over the participants, which wait for each other, of

    w + latency (reductions log2 P + messages + 2 log2 P gathers) + (bytes + 8 P gathers) / bandwidth

and the partition of the new mesh after every adaptation, with the counts of a rank that the run with the most ranks has.  n of the
coupler and of the solid are shares of the fluid's, as in the runs.
"""
import itertools
import math

import numpy

PARTS = ("fluid", "coupler", "solid")
SIZE = {"fluid": "elements", "coupler": "near", "solid": "solid elements"}
LATENCY, BANDWIDTH = 2e-6, 1e10  # s, bytes/s: assumed of a cluster's network
PAPER = ((7, 2, 1), (70, 20, 10), (700, 200, 100), (7000, 2000, 1000))  # splits on paper
WEAK, STRONG = 5000, 35e6  # triangles a rank of the fluid, and in all, on paper
FEW, PARTITION, EVERY = 6e-7, 6.4e-6, 30  # s a vertex of METIS for 8 parts and for many (tests/mesh/bench_mesh), steps between adaptations


def describe(row):
    """A line for the log."""
    return " ".join([f"{row['set']:>8} {':'.join(f'{row[p]:.0f}' for p in PARTS):>8} {row['elements']:7.0f} elements, {row['steps']:.0f} steps of "
                     f"{row['step [s]']:.3g} s;",
                     *(f"{p} computed {1e3 * row[p + ' computed [s]']:.3g} ms, waited {1e3 * row[p + ' waited [s]']:.3g} ms, sent "
                       f"{row[p + ' messages']:.0f}+{row[p + ' exchanged']:.0f};" for p in PARTS)])


def terms(row, p, n=None, ranks=None):
    """What a, b, c, d go with, for participant p of a run; on paper with n elements on `ranks` ranks."""
    n, ranks = (row[SIZE[p]], row[p]) if n is None else (n, ranks)
    several = ranks > 1
    return [1.0, n / ranks, several * row[f"{p} messages"], several * (row[f"{p} reductions"] + row[f"{p} gathers"])]


def fit(rows, p):
    """Coefficients a, b, c, d >= 0 of the least relative errors, and those errors."""
    matrix = numpy.array([numpy.array(terms(row, p)) / row[p + " computed [s]"] for row in rows])
    best = None
    for used in itertools.chain.from_iterable(itertools.combinations(range(4), k) for k in (1, 2, 3, 4)):
        x = numpy.zeros(4)
        x[list(used)] = numpy.linalg.lstsq(matrix[:, used], numpy.ones(len(rows)), rcond=None)[0]
        error = matrix @ x - 1
        if x.min() >= 0 and (best is None or error @ error < best[1] @ best[1]):
            best = x, error
    return best


def paper(rows, fitted, n, split):
    """Seconds of a step by what they are for, on paper: n elements of the fluid on a split of ranks."""
    most = max(rows, key=lambda row: (row["fluid"], row["elements"]))
    cost = {}
    for p, ranks in zip(PARTS, split):
        mine = n * sum(row[SIZE[p]] for row in rows) / sum(row["elements"] for row in rows)
        count = {c: most[f"{p} {c}"] for c in ("messages", "bytes", "exchanged", "exchanged bytes", "reductions", "gathers")}
        deep = math.log2(ranks)
        cost[p, "computes"] = float(fitted[p][0] @ terms(most, p, mine, ranks))
        cost[p, "reductions"] = LATENCY * deep * (count["reductions"] + 2 * count["gathers"]) + 8 * ranks * count["gathers"] / BANDWIDTH
        cost[p, "messages"] = (LATENCY * (count["messages"] + count["exchanged"]) + (count["bytes"] + count["exchanged bytes"]) / BANDWIDTH) * (ranks > 1)
    clusters = n / split[0] + min(n / 10, max(1e4, 30 * split[0]))  # a rank's own triangles, and rank 0's clusters: common/mesh/part_partition.c
    cost["rank 0", "partition"] = PARTITION / EVERY * (clusters if n > 1e5 and split[0] >= 8 else n if split[0] > 8 else n * FEW / PARTITION)
    return cost


def number(x):
    return f"{x:.0f}" if x >= 100 else f"{x:.3g}" if x >= 1 else f"{x:.2f}"


def table(header, rows):
    return ["| " + " | ".join(header) + " |", "|---" * len(header) + "|", *("| " + " | ".join(row) + " |" for row in rows)]


def tables(rows):
    """{mark: lines of Markdown}, and the fitted models."""
    fitted = {p: fit(rows, p) for p in PARTS}
    measured = []
    for k, row in enumerate(rows):
        cells = [f"{row['set']} {':'.join(f'{row[p]:.0f}' for p in PARTS)}", f"{row['elements']:.0f}", number(1e3 * row["step [s]"])]
        for p in PARTS:
            cells += [f"{number(1e3 * row[p + ' computed [s]'])} ({100 * fitted[p][1][k]:+.0f} %)", number(1e3 * row[p + " waited [s]"]),
                      f"{row[p + ' messages']:.0f} + {row[p + ' exchanged']:.0f}", f"{(row[p + ' bytes'] + row[p + ' exchanged bytes']) / 1e3:.0f}",
                      f"{row[p + ' reductions']:.0f} + {row[p + ' gathers']:.0f}"]
        measured.append(cells)
    header = ["run", "triangles", "step", *(f"{p}: {c}" for p in PARTS for c in ("computes (model)", "waits", "messages", "kB", "collective"))]
    coefficients = [[p, SIZE[p], *(f"{1e6 * x:.3g}" for x in fitted[p][0]), f"{100 * numpy.sqrt(numpy.mean(fitted[p][1] ** 2)):.0f} %",
                     f"{100 * abs(fitted[p][1]).max():.0f} %"] for p in PARTS]
    on_paper = []
    for what, size in (("weak", lambda ranks: WEAK * ranks), ("strong", lambda ranks: STRONG)):
        for split in PAPER:
            n = size(split[0])
            cost = paper(rows, fitted, n, split)
            total = sum(cost.values())
            worst = max((k for k in cost if k != ("fluid", "computes")), key=cost.get)
            cells = [f"{number(1e3 * cost[p, 'computes'])} + {number(1e3 * (cost[p, 'reductions'] + cost[p, 'messages']))}" for p in PARTS]
            on_paper.append([what + " " + ":".join(map(str, split)), f"{n:.2g}", number(1e3 * total), *cells, number(1e3 * cost["rank 0", "partition"]),
                             f"{worst[0]}: {worst[1]}, {100 * cost[worst] / total:.0f} %"])
    return {"scaling": table(header, measured), "model": table(["", "n", "a [us]", "b [us]", "c [us]", "d [us]", "rms", "largest"], coefficients),
            "paper": table(["ranks", "triangles", "step [ms]", *(f"{p} computes + communicates" for p in PARTS), "partition", "most beside the fluid's work"],
                           on_paper)}, fitted


def plot(path, rows, fitted):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.5), sharey=True, layout="constrained")
    for p, ax in zip(PARTS, axes):
        for name in dict.fromkeys(row["set"] for row in rows):
            of = sorted((row for row in rows if row["set"] == name), key=lambda row: row[p])
            ranks = [row[p] for row in of]
            points, = ax.loglog(ranks, [1e3 * row[p + " computed [s]"] for row in of], "o", label=name)
            ax.loglog(ranks, [1e3 * float(fitted[p][0] @ terms(row, p)) for row in of], "-", color=points.get_color())
        ax.set(title=p, xlabel="ranks")
    axes[0].set_ylabel("ms a step, busiest rank, outside of MPI; lines: model")
    axes[0].legend()
    figure.savefig(path, dpi=150)
