#!/usr/bin/env bash
# ParaView's filters take the files of every case, after a few steps, without a warning.  Usage: paraview.sh ROOT BUILD; 77: there is no pvbatch
set -euo pipefail
command -v pvbatch >/dev/null || { echo 'no pvbatch here: scripts/setup.sh --paraview installs it'; exit 77; }
source "$(dirname "$0")/../coupled/run.sh"
folders=()
for case in "$here/../coupled/disc.yaml" "$root"/cases/*/case.yaml; do
  name=$(basename "$(dirname "$case")")
  dt=$(grep -om1 'dt_max: *[0-9.e-]*' "$case" | cut -d: -f2)
  must "$name" 1:1:1 --set "time.end=$(awk "BEGIN {print 4 * $dt}")" --set "output.every=$(awk "BEGIN {print 2 * $dt}")"
  folders+=("$scratch/$name")
done
timeout -k 5 300 pvbatch "$root/tests/hardening/filters.py" "${folders[@]}" >"$scratch/log" 2>&1 || { head -40 "$scratch/log"; exit 1; }
! grep -i 'err\|warn' "$scratch/log"
[ "$(wc -l <"$scratch/log")" -eq ${#folders[@]} ] || { cat "$scratch/log"; exit 1; }
