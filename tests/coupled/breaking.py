"""Looks at two runs of breaking.sh: breaking.py CASE_FOLDER ONE_RANK TWO_RANKS; silent where all is well."""
import json
import os
import sys
import xml.etree.ElementTree as xml

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
import h5py
import numpy as np

sys.path.insert(0, sys.argv[1])
from budget import Budget

TOUGHNESS = 12.8  # J/m2


def must(condition, message):
    if not condition:
        sys.exit("breaking: " + message)


def check_balance(folder):
    b = Budget(folder)
    imbalance = json.load(open(folder + "/summary.json"))["largest_momentum_imbalance"]
    must(imbalance < 1e-10, f"fluid and solid: momentum imbalance {imbalance:g}")
    for c in range(2):
        must(b.momentum_error(c) < 1e-6, f"momentum {c} of the solids: {b.momentum_error(c):g} not accounted for")
    must(b.excess.max() < 1e-3 * b.reaction_work[-1], f"{b.excess.max():g} J/m from nothing, {b.reaction_work[-1]:g} put in")
    must(b.broken[-1] >= 5 and b.pieces[-1] >= 4, f"{b.broken[-1]:g} joints broken, {b.pieces[-1]:g} pieces")
    toughness = b.debonded[-1] / b.cracks[-1]
    must(abs(toughness / TOUGHNESS - 1.0) < 0.04, f"cracks cost {toughness:g} J/m2 instead of {TOUGHNESS:g}")
    return b


def check_file(folder, name):
    """What the XDMF says is what the HDF5 has, at every time and of whatever size; the number of times."""
    sizes = set()
    with h5py.File(f"{folder}/{name}.h5") as file:
        for item in xml.parse(f"{folder}/{name}.xdmf").iter("DataItem"):
            of, path = item.text.strip().split(":")
            must(of == name + ".h5" and path in file, f"{name}.xdmf: there is no {item.text.strip()}")
            said = tuple(int(n) for n in item.get("Dimensions").split())
            must(file[path].size == np.prod(said), f"{name}.xdmf: {path} has {file[path].shape}, not {said}")
            sizes.add(said[0])
    return len(sizes)


def check_solid(folder):
    """Elements stay, nodes grow in number; of the four largest fragments two at least move apart: which ones, and around which, differs between processors."""
    with h5py.File(folder + "/solid.h5") as file:
        snapshots = [file["snapshot"][name]["solid"] for name in sorted(file["snapshot"])]
        for s in snapshots:
            points, cells = s["points"][()], s["cells"][()]
            must(len(np.unique(cells)) == len(points), "a node has no element, or an element a node that is not there")
            must(all(len(s["node"][f]) == len(points) for f in s["node"]), "a field of the nodes has another length")
        first, last = snapshots[0], snapshots[-1]
        must(len(last["points"]) > len(first["points"]) + 10 and len(last["cells"]) == len(first["cells"]), "nothing has split")
        block = first["cell/body"][()].ravel() == 0
        fragment = last["cell/fragment"][()].ravel().astype(int)
        largest = np.argsort(-np.bincount(fragment[block]), kind="stable")[:4]
        middle = [s["points"][()][:, :2][s["cells"][()]].mean(axis=1) for s in (first, last)]
        centre = [np.array([x[fragment == k].mean(axis=0) for k in largest]) for x in middle]
        distance = [np.hypot(*np.moveaxis(c[:, None] - c[None], 2, 0)) for c in centre]
        must(abs(distance[1] - distance[0]).max() > 0.005, f"the largest fragments were {distance[0]} m apart, and are {distance[1]} m")


# Until the first crack two runs that differ in the order of sums alone differ by no more than
SOLVERS = 1e-6  # while the fluid's meshes are the same: the tolerance of its momentum solver;
# once a remesh has decided a near-tie otherwise both meshes still meet velocity_error, and the runs differ less than by halving that:
MESHES = 1e-3  # of the force, which halving changes by 4.5e-4
TIMES = 1e-5  # of steps and first crack, which it changes by 2e-6 and 3.3e-6
# Later they part: a crack takes this edge or the next one. What holds then on any ranks is in check_balance and check_solid.


def centres(snapshot):
    """Of the fluid's triangles, m, in an order that does not depend on their numbers."""
    middle = snapshot["velocity/points"][()][:, :2][snapshot["velocity/cells"][()]].mean(axis=1)
    return middle[np.lexsort(middle.round(6).T)]


def last_common_mesh(one, two):
    """Time of the last snapshot until which both runs have the same fluid mesh, s."""
    last = -1.0
    with h5py.File(one + "/fluid.h5") as a, h5py.File(two + "/fluid.h5") as b:
        for name in sorted(set(a["snapshot"]) & set(b["snapshot"])):
            middle, other = centres(a["snapshot"][name]), centres(b["snapshot"][name])
            if middle.shape != other.shape or abs(middle - other).max() > SOLVERS:
                break
            last = a["snapshot"][name].attrs["time"]
    return last


def check_ranks(one, two, common):
    n = int(np.argmax(one.broken > 0)) - 1
    must(n > 10 and len(two.t) > n, f"the first crack comes in step {n + 1}")
    must(common >= 0.0, "the fluid's first meshes differ")
    scale = abs(one.force[0][:n]).max()
    for k in range(n + 1):
        same = one.t[k] <= common
        step = abs(one.t[k] / two.t[k] - 1.0)
        must(step < (SOLVERS if same else TIMES), f"steps differ at {one.t[k]:g} s: {step:g}")
        if k == n:
            break
        for c in range(2):
            difference = abs(one.force[c][k] - two.force[c][k]) / scale
            must(difference < (SOLVERS if same else MESHES), f"the fluid's force differs by {difference:g} at {one.t[k]:g} s between one rank and two")
    crack = abs(one.first_crack() / two.first_crack() - 1.0)
    must(crack < TIMES, f"first crack at {one.first_crack():g} and {two.first_crack():g} s")


one, two = (check_balance(folder) for folder in sys.argv[2:4])
for folder in sys.argv[2:4]:
    for name, least in (("solid", 4), ("fluid", 8), ("coupler", 4)):
        sizes = check_file(folder, name)
        must(sizes >= least, f"{name}.h5 has arrays of {sizes} sizes only")
    check_solid(folder)
check_ranks(one, two, last_common_mesh(*sys.argv[2:4]))
if os.environ.get("VERBOSE"):
    for b in (one, two):
        print(b.broken[-1], b.pieces[-1], b.first_crack(), b.debonded[-1] / b.cracks[-1], b.momentum_error(0), b.momentum_error(1), b.excess.max())
