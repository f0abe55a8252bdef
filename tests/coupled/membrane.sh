#!/usr/bin/env bash
# An elastic ring as dense as the fluid springs back from an ellipse, coarsely: it moves as the interface-fitted line membrane does, keeps its area,
# exchanges momentum to round-off, and does so on any ranks.  Usage: membrane.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$root/cases/elastic_membrane/case.yaml
line='{law: corotated, density: 1, youngs_modulus: 2000, poisson_ratio: 0, damping: 0.2}'
for run in "1:1:1 0.06" "2:1:2 0.015"; do
  set -- $run
  must "${1//:/-}" "$1" --set "solid.materials.membrane=$line" --set fluid.adapt.size_min=0.02 --set "solid.bodies[0].size=0.01" \
    --set time.dt_max=0.0005 --set time.end="$2" --set output.every=0.015
done
"$python" - "$scratch" "$root/cases/elastic_membrane" <<'E2'
import pathlib, sys
from results import summary
sys.path.insert(0, sys.argv[2])
import membrane
shapes = {}
for label in ("1-1-1", "2-1-2"):
    shape = shapes[label] = membrane.history(pathlib.Path(sys.argv[1]) / label)
    reference = membrane.reference()
    imbalance = summary(label)["largest_momentum_imbalance"]
    assert imbalance < 1e-10, "%s: momentum imbalance %g" % (label, imbalance)
    change = shape["area"][-1] / shape["area"][0] - 1.0
    assert abs(change) < 0.002, "%s: area changes by %g" % (label, change)
    for key in ("rx", "ry"):
        error = shape[key][-1] / membrane.at(reference, key, shape["t"][-1]) - 1.0
        assert abs(error) < 0.003, "%s: %s(%g s) is %.4f, %.2g off" % (label, key, shape["t"][-1], shape[key][-1], error)
one, two = membrane.at(shapes["1-1-1"], "rx", 0.015), shapes["2-1-2"]["rx"][-1]
assert abs(one / two - 1.0) < 2e-4, "rx %g, on other ranks %g" % (one, two)
E2
