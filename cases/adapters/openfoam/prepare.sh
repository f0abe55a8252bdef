#!/usr/bin/env bash
# Makes OpenFOAM's case of a run: FOLDER/foam with its mesh, decomposed when there is more than one rank.
# Usage: prepare.sh FOLDER [RANKS [BLOCK_MESH_DICT]]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd) folder=${1:?prepare.sh FOLDER [RANKS [BLOCK_MESH_DICT]]} ranks=${2:-1} blocks=${3:-}
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}
rm -rf "$folder/foam"
mkdir -p "$folder"
cp -r "$here/foam" "$folder/foam"
[ -z "$blocks" ] || cp "$blocks" "$folder/foam/system/blockMeshDict"
cd "$folder/foam"
{
  blockMesh
  if [ "$ranks" -gt 1 ]; then
    sed -i "s/^numberOfSubdomains.*/numberOfSubdomains $ranks;/; s/n (1 2 1)/n (1 $ranks 1)/" system/decomposeParDict
    decomposePar
  fi
} >../prepare.log 2>&1 || { cat ../prepare.log >&2; exit 1; }
