#!/usr/bin/env bash
# Installs what Coracle stands on where it is missing (Debian 12, as root or with sudo); elsewhere says what it needs.
# Usage: scripts/setup.sh [--adapters]
#   --adapters   what the outside solids and fluids of cases/adapters stand on, too: their packages, and in /usr/src the source
#                packages (files `sources`) of those whose headers Debian does not package
set -euo pipefail

packages=(build-essential cmake ninja-build pkg-config git libopenmpi-dev openmpi-bin libpetsc-real-dev libmetis-dev
  libhdf5-openmpi-dev libyaml-dev libopenblas0-pthread gmsh python3 python3-numpy python3-h5py python3-matplotlib python3-pil)
sources=()
if [ "${1:-}" = --adapters ]; then
  mapfile -t sources < <(sort -u "$(dirname "$0")"/../cases/adapters/*/sources)
  mapfile -t -O "${#packages[@]}" packages < <(sort -u "$(dirname "$0")"/../cases/adapters/*/packages)
fi

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

# The folders src of a source package into /usr/src/NAME, by apt's own sources with deb turned into deb-src.
unpack_source() { # NAME
  local scratch options
  scratch=$(mktemp -d)
  mkdir -p "$scratch"/{parts,lists/partial}
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources; do
    [ ! -f "$file" ] || sed 's/^Types:.*/Types: deb-src/; s/^deb /deb-src /' "$file" >"$scratch/parts/$(basename "$file")"
  done
  [ ! -f "$scratch/parts/sources.list" ] || mv "$scratch/parts/sources.list" "$scratch/parts/main.list"
  options=(-qq -o Dir::Etc::sourcelist=- -o "Dir::Etc::sourceparts=$scratch/parts" -o "Dir::State::lists=$scratch/lists" -o APT::Sandbox::User=root)
  (cd "$scratch" && "${sudo[@]}" apt-get "${options[@]}" update && "${sudo[@]}" apt-get "${options[@]}" --download-only source "$1")
  "${sudo[@]}" mkdir -p "/usr/src/$1"
  "${sudo[@]}" tar xf "$scratch/$1"_*.orig.tar.* -C "/usr/src/$1" --strip-components=1 --wildcards '*/src/*'
  "${sudo[@]}" rm -rf "$scratch"
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
  unpack_source "$source"
done
