#!/usr/bin/env bash
# Installs what Coracle stands on where it is missing (Debian 12, as root or with sudo); elsewhere says what it needs.
# Usage: scripts/setup.sh [--adapters] [--paraview]
#   --paraview   ParaView with its Python, for the test of that label
#   --adapters   what the outside solids and fluids of cases/adapters stand on, too: their packages, and in /usr/src the source
#                packages (files `sources`) of those whose headers Debian does not package
set -euo pipefail

packages=(build-essential cmake ninja-build pkg-config git libopenmpi-dev openmpi-bin libpetsc-real-dev libmetis-dev
  libhdf5-openmpi-dev libyaml-dev libopenblas0-pthread gmsh python3 python3-numpy python3-h5py python3-matplotlib python3-pil)
sources=()
for option in "$@"; do
  case $option in
    --adapters)
      mapfile -t sources < <(sort -u "$(dirname "$0")"/../cases/adapters/*/sources)
      mapfile -t -O "${#packages[@]}" packages < <(sort -u "$(dirname "$0")"/../cases/adapters/*/packages) ;;
    --paraview) packages+=(paraview python3-paraview) ;;
    *) echo "setup.sh: unknown option '$option'" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg-query >/dev/null; then
  cat >&2 <<'EOF'
coracle setup: this is no Debian system, so nothing was installed.  Coracle needs, from modules or packages:
  a C11 compiler, CMake >= 3.20, Ninja, pkg-config, an MPI (Open MPI 4.1), PETSc >= 3.18 with real scalars (with CHOLMOD and
  MUMPS), METIS 5.1, parallel HDF5 >= 1.10, libyaml; for pictures Python 3 with numpy, h5py, matplotlib.
PKG_CONFIG_PATH must reach PETSc.pc; METIS_DIR and HDF5_ROOT help where pkg-config does not.
EOF
  exit 0
fi

sudo=()
as_root() {
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "coracle setup: needs root or sudo to install: $*" >&2; exit 1; }
    sudo=(sudo)
  fi
  echo "coracle setup: installing $*"
}

missing=()
for p in "${packages[@]}"; do
  dpkg-query -W -f '${Status}' "$p" 2>/dev/null | grep -q 'ok installed' || missing+=("$p")
done
if [ ${#missing[@]} -gt 0 ]; then
  as_root "${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  "${sudo[@]}" apt-get update -qq
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi
for source in "${sources[@]}"; do
  [ ! -d "/usr/src/$source/src" ] || continue
  as_root "the headers of $source"
  "${sudo[@]}" "$(dirname "$0")/debian_source.sh" "$source" "/usr/src/$source" --wildcards '*/src/*'
done
