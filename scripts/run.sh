#!/usr/bin/env bash
# Installs what is missing, builds, runs a coupled case with progress, and draws its figures.
# Usage: scripts/run.sh CASE [--set key=value]... [--ranks F:C:S] [--out DIR] [--resume] [--alone] [--bin DIR], in any order
#   CASE   a folder of cases/, or a case file
#   --set  overrides a key of the case file, e.g. --set time.end=1.0
#   --ranks  ranks of fluid, coupler and solid (default 1:1:1)
#   --out  output folder (default out/<case> in the folder where you are)
#   --resume  resumes from the last checkpoint in the output folder, if there is one
#   --alone  the solid alone: no fluid, no coupler
#   --bin  programs that are there already: nothing is installed or built
set -euo pipefail
unset CDPATH # with it cd prints where it goes
root=$(cd "$(dirname "$0")/.." && pwd)

usage() { sed -n '2,10p' "$0" | cut -c3-; }
[ $# -ge 1 ] || { usage; exit 2; }
case="" ranks=1:1:1 out="" bin="" sets=() alone=()
while [ $# -gt 0 ]; do
  case "$1" in
    --set)
      case "${2:?--set needs key=value}" in output.folder=*) echo "run.sh: the output folder is that of --out (see --help)" >&2; exit 2 ;; esac
      sets+=(--set "$2"); shift 2 ;;
    --ranks) ranks=${2:?--ranks needs F:C:S}; shift 2 ;;
    --alone) alone=(--alone); shift ;;
    --resume) sets+=(--set resume=last); shift ;;
    --bin) bin=${2:?--bin needs a folder}; shift 2 ;;
    --out) out=${2:?--out needs a folder}; shift 2 ;;
    -h | --help) usage; exit 0 ;;
    -*) echo "run.sh: unknown option '$1' (see --help)" >&2; exit 2 ;;
    *) [ -z "$case" ] || { echo "run.sh: two cases: '$case' and '$1'" >&2; exit 2; }; case=$1; shift ;;
  esac
done
[ -n "$case" ] || { echo "run.sh: no case (see --help)" >&2; exit 2; }
if [ -f "$case" ]; then
  file=$case name=$(basename "$case") name=${name%.*}
else
  file=$root/cases/$case/case.yaml name=$case
fi
[ -f "$file" ] || { echo "run.sh: no case '$case': cases are $(cd "$root/cases" && echo */case.yaml | sed 's|/case.yaml||g')" >&2; exit 2; }
file=$(realpath "$file") out=$(realpath -m "${out:-out/$name}")

[ -n "$bin" ] || "$root/scripts/build.sh"
mkdir -p "$out"
"$root/scripts/launch.sh" "${alone[@]}" --bin "${bin:-$root/build}" --ranks "$ranks" "$file" --set "output.folder='${out//\'/\'\'}'" "${sets[@]}"

figures=$(dirname "$file")/figures.sh pictures=""
if [ "$(basename "$file")" = case.yaml ] && [ -f "$figures" ] && [ "${#alone[@]}" -eq 0 ]; then # they show the fluid
  bash "$figures" "$out"
  pictures=", *.png"
fi
echo "results: $out (summary.json, *.csv, *.xdmf for ParaView$pictures)"
