#!/usr/bin/env bash
# ParaView's filters take the files of a run without a warning.  Usage: paraview.sh ROOT BUILD; 77: there is no pvbatch
set -euo pipefail
command -v pvbatch >/dev/null || exit 77
source "$(dirname "$0")/../coupled/run.sh"
case=$here/../coupled/disc.yaml
must run 1:1:1 --set output.every=0.02
timeout -k 5 100 pvbatch "$root/tests/hardening/filters.py" "$scratch/run" >"$scratch/log" 2>&1 || { head -40 "$scratch/log"; exit 1; }
! grep -i 'err\|warn' "$scratch/log"
