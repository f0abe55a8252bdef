#!/usr/bin/env bash
# Among phases a disc sinks nearly alike with steps of 4 ms and a quarter of that: 1.6 % apart, 4.6 % while water beside it was held
# to the water around by a penalty.  Usage: sinking.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/drop.yaml
for dt in 0.004 0.001; do
  must "$dt" 1:1:1 --set "time.dt_max=$dt" --set time.end=0.2 --set fluid.adapt.size_min=0.008 --set solid.materials.body.density=1500 \
    --set "solid.bodies[0].centre=[0.2, 0.12]"
done
"$python" - "$scratch" <<'E2'
from results import column
long, short = (0.12 - column(dt, "solid", "y0 [m]")[-1] for dt in ("0.004", "0.001"))
assert long > 0.03 and abs(short / long - 1.0) < 0.03, "depth with long and short steps: %g, %g m" % (long, short)
E2
