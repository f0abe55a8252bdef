#!/usr/bin/env bash
# A cylinder that swings as prescribed in a fluid at rest has the drag and the added mass of the literature (oscillating.py), and a force without
# vibration, whatever its own density.  Usage: oscillating.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/oscillating.yaml
must swing 1:1:1 --set "solid.bodies[0].prescribed=[{table: $("$python" "$here/oscillating.py")}]"
"$python" "$here/oscillating.py" "$scratch/swing"
