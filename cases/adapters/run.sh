#!/usr/bin/env bash
# Runs a case with an outside solid or fluid in place of Coracle's: builds what is missing, then as scripts/run.sh.
# Usage: cases/adapters/run.sh NAME [CASE] [--set key=value]... [--ranks F:C:S] [--out DIR]
#   NAME   a folder beside this script
#   CASE   a case file (default: the adapter's own, else cases/falling_cylinder)
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) root=$(cd "$(dirname "$0")/../.." && pwd)
[ $# -ge 1 ] && [ -d "$here/$1" ] || { sed -n '2,5p' "$0" | cut -c3-; exit 2; }
name=$1 case=$here/$1/case.yaml arguments=() out=$root/out/$1 fluid_ranks=1
[ -f "$case" ] || case=$root/cases/falling_cylinder/case.yaml
shift
while [ $# -gt 0 ]; do
  case "$1" in
    --out) out=${2:?--out needs a folder}; shift 2 ;;
    --ranks) fluid_ranks=${2%%:*} arguments+=(--ranks "${2:?--ranks needs a value}"); shift 2 ;;
    --set) arguments+=("$1" "${2:?$1 needs a value}"); shift 2 ;;
    -*) echo "run.sh: unknown argument '$1'" >&2; exit 2 ;;
    *) case=$1; shift ;;
  esac
done
"$root/scripts/setup.sh" --adapters
cd "$root"
cmake --preset release >/dev/null
cmake --build --preset release --target coracle-fluid coracle-coupler coracle-solid coracle_client coracle_client_shared -- --quiet
program=$("$here/build.sh" "$name" build)
role=solid
[ ! -f "$here/$name/fluid" ] || role=fluid
mkdir -p "$out"
out=$(realpath "$out")
[ ! -x "$here/$name/prepare.sh" ] || "$here/$name/prepare.sh" "$out" "$fluid_ranks"
"$root/scripts/launch.sh" --bin "$root/build" --$role "$program" "$case" --set "output.folder=$out" "${arguments[@]}"
echo "results: $out"
