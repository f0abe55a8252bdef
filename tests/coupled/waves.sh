#!/usr/bin/env bash
# A wave maker: a piston that stands in the water moves as a table says, and the waves are those of potential theory (waves.py).  At the start there is
# no water where the piston is: what a region has there does not come out of it.  Usage: waves.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/run.sh"
case=$here/waves.yaml
must waves 1:1:1 --set "solid.bodies[0].prescribed=[{table: $("$python" "$here/waves.py")}]"
"$python" "$here/waves.py" "$scratch/waves" 0.1
