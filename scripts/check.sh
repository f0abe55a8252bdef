#!/usr/bin/env bash
# All faults of a case at once, without a run: what is wrong, or what a run would be made of and a picture of it.
# Usage: scripts/check.sh [options] CASE [--set key=value]...
#   --bin DIR     programs that are there already (default: they are built, as by run.sh)
#   --fluid, --coupler, --solid PROGRAM   another program for that part (launch.sh): its keys are not checked
#   --alone       the solid alone (launch.sh --alone): no fluid, no coupler
#   --png FILE    where the picture goes (default: none)
# Touches no output folder.  Exit status: 0, or 1 when the case has faults.
set -euo pipefail
unset CDPATH # with it cd prints where it goes
root=$(cd "$(dirname "$0")/.." && pwd)
die() { echo "check.sh: $*" >&2; exit 2; }

bin="" png="" case="" sets=() parts=(coupler fluid solid) others=""
while [ $# -gt 0 ]; do
  case "$1" in
    --bin) bin=${2:?--bin needs a folder}; shift 2 ;;
    --fluid | --coupler | --solid) [ $# -ge 2 ] || die "$1 needs a program"; others+=" ${1#--} "; shift 2 ;;
    --alone) parts=(solid); shift ;;
    --png) png=${2:?--png needs a file}; shift 2 ;;
    --set) sets+=(--set "${2:?--set needs key=value}"); shift 2 ;;
    -h | --help) sed -n '2,8p' "$0" | cut -c3-; exit 0 ;;
    -*) die "unknown option '$1' (see --help)" ;;
    *) [ -z "$case" ] || die "two case files: '$case' and '$1'"; case=$1; shift ;;
  esac
done
[ -n "$case" ] || die "no case file (see --help)"
ours=()
for part in "${parts[@]}"; do [[ $others == *" $part "* ]] || ours+=("$part"); done
[ "${#ours[@]}" -gt 0 ] || die "nothing to check: all parts are other programs"
parts=("${ours[@]}")
[ -n "$bin" ] || "$root/scripts/build.sh" >&2
bin=${bin:-$root/build}

program() { # of a part
  local candidate
  for candidate in "$bin/coracle-$1" "$bin/$1/coracle-$1" "$bin/bin/coracle-$1"; do
    [ -x "$candidate" ] && echo "$candidate" && return
  done
  die "no coracle-$1 under '$bin'"
}

export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
faults=0
for part in "${parts[@]}"; do program $part >/dev/null; done
for part in "${parts[@]}"; do
  "$(program $part)" --check "$case" "${sets[@]}" >"$scratch/$part" 2>&1 || faults=1
done
# what all say of the file itself is told once
if [ "$faults" -ne 0 ]; then
  cat "${parts[@]/#/$scratch/}" | grep '^coracle ' | sed 's/^coracle [a-z]*: //' | awk '!seen[$0]++' || cat "$scratch"/*
  exit 1
fi
cat "${parts[@]/#/$scratch/}" | awk '!/^note: / || !seen[$0]++'
if [ -n "$png" ]; then
  for part in "${parts[@]}"; do
    [ "$part" != coupler ] || continue
    "$(program $part)" --draw "$case" "${sets[@]}" --set "output.folder=$scratch/run" >"$scratch/$part" 2>&1 ||
      { cat "$scratch/$part"; exit 1; }
  done
  "$(command -v /usr/bin/python3 || command -v python3)" "$root/scripts/plot_case.py" "$scratch/run" "$png"
fi
