#!/usr/bin/env python3
"""What a step with many discs costs: the table "Many bodies" of README.md.  Usage: many.py BUILD KIND N...
many.py KIND N prints the case.

KIND: apart   30 % of the area, in a tank that they fill; four elements of the fluid a disc
      packed  72 % of it
      bed     74 %, under half as much free fluid; pores are finer than the elements
      adapt   8 %; the mesh adapts in every second step: four elements a disc there, of up to four times their size between
N: discs, rounded to a square.  BUILD has the programs and tests/bench_stream.  A row each: processor time in microseconds and memory in kB a
disc (and step, of four, start-up included) of fluid, coupler and solid; the largest part of a step's momentum that is lost.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
RADIUS = 0.005
# of the area, le/radius, free height/height, Le/le
KINDS = {"apart": (0.3, 0.5, 0.0, 1.0), "packed": (0.72, 0.5, 0.0, 1.0), "bed": (0.74, 0.8, 0.5, 1.0), "adapt": (0.08, 0.5, 0.0, 4.0)}
CASE = """case: many
gravity: [0.0, -9.81]
time: {{end: 0.02, dt_max: 0.005, cfl: 1.0}}
fluid:
  density: 1000.0
  viscosity: 0.02
  mesh: {{lower: [0.0, 0.0], upper: [{width}, {height}], size_max: {coarse}}}
  {adapt}boundaries: {{left: free_slip, right: free_slip, bottom: no_slip, top: free_slip}}
solid:
  materials:
    stone: {{density: 2500.0, youngs_modulus: 1.0e6, poisson_ratio: 0.3, damping: 0.2, friction: 0.5, contact_damping: 0.3}}
  bodies:
    - {{shape: disc, centre: [{first}, {first}], radius: {radius}, size: {size}, material: stone, repeat: {{n: [{side}, {side}], step: [{pitch}, {pitch}]}}}}
  walls: {{lower: [0.0, 0.0], upper: [{width}, {height}]}}
coupler: {{shell_thickness: {shell}}}
output: {{folder: out, every: 0.1, checkpoint: 0}}
"""
ADAPT = """adapt: {{size_min: {le}, size_max: {coarse}, velocity_error: 0.1, every: 2, elements_max: 5000000}}
  """


def case_of(kind, side):
    fraction, le, free, ratio = KINDS[kind]
    pitch, le, coarse = RADIUS * math.sqrt(math.pi / fraction), RADIUS * le, RADIUS * le * ratio
    return CASE.format(width=side * pitch, height=side * pitch * (1.0 + free), coarse=coarse, adapt=ADAPT.format(le=le, coarse=coarse) if ratio > 1.0 else "", first=pitch / 2, radius=RADIUS, side=side, pitch=pitch,
                       size=2.0 * RADIUS * math.sin(math.pi / 12.0) * 1.06, shell=le / 10)  # twelve facets, 24 triangles


def row(build, kind, side):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "case.yaml"), "w") as file:
            file.write(case_of(kind, side))
        subprocess.run([os.path.join(ROOT, "scripts", "launch.sh"), "--bin", build, os.path.join(folder, "case.yaml"), "--set", "output.folder=" + os.path.join(folder, "out")],
                       check=True, stdout=subprocess.DEVNULL)
        with open(os.path.join(folder, "out", "summary.json")) as file:
            summary = json.load(file)
    parts = [summary["participants"][name] for name in ("fluid", "coupler", "solid")]
    bodies = parts[2]["bodies"]
    return "| %s | %d | %s | %s | %.0e |" % (kind, bodies, ", ".join("%.0f" % (1e6 * p["seconds_cpu"] / summary["steps"] / bodies) for p in parts),
                                           ", ".join("%.0f" % (1e3 * p["peak_memory_mb"] / bodies) for p in parts), summary["largest_momentum_imbalance"])


def main():
    if len(sys.argv) == 3:
        print(case_of(sys.argv[1], round(math.sqrt(int(sys.argv[2])))), end="")
        return
    build, kind = os.path.abspath(sys.argv[1]), sys.argv[2]
    print("triad %s GB/s" % subprocess.run([os.path.join(build, "tests", "bench_stream")], check=True, capture_output=True, text=True).stdout.strip())
    for n in sys.argv[3:]:
        print(row(build, kind, round(math.sqrt(int(n)))), flush=True)


main()
