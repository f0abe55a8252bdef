#!/usr/bin/env bash
# OpenFOAM's fluid keeps the contract on one rank and two, and the disc falls in it as the body-fitted reference.  Usage: test.sh ROOT BUILD
set -euo pipefail
root=$1 build=$2 here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
program=$("$root/cases/adapters/build.sh" openfoam "$build")
"$here/prepare.sh" "$scratch/kit" 2
"$root/scripts/conform.py" --bin "$build" --ranks 1,2 --fluid "$program" "$here/case.yaml" --set "fluid.openfoam=$scratch/kit/foam" \
  --set 'coupler.conformance.box=[0.9, 2.5, 1.6, 3.5]'
"$here/prepare.sh" "$scratch/fall"
"$root/scripts/launch.sh" --bin "$build" --fluid "$program" "$here/case.yaml" --set "output.folder=$scratch/fall" >"$scratch/log" 2>&1 ||
  { cat "$scratch/log"; exit 1; }
"$here/compare.py" "$scratch/fall"
