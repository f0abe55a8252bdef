#!/usr/bin/env bash
# Builds an adapter against the installed client library and prints its program, as launch.sh's --solid or --fluid takes it.
# Usage: build.sh NAME BUILD     BUILD: Coracle's build folder; all goes into BUILD/adapters/NAME
# Exit status 77: packages are missing, said on stderr.
set -euo pipefail
name=$1 build=$(realpath "$2") here=$(cd "$(dirname "$0")" && pwd)
folder=$here/$name into=$build/adapters/$name
[ -d "$folder" ] || { echo "no adapter '$name' in $here" >&2; exit 2; }
if [ -f "$folder/packages" ] && command -v dpkg-query >/dev/null; then
  while read -r package; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' ||
      { echo "$name needs the package $package: scripts/setup.sh --adapters installs it" >&2; exit 77; }
  done <"$folder/packages"
fi
if [ -f "$folder/sources" ]; then # headers: FOAM_SRC, or what setup.sh has unpacked
  while read -r source; do
    [ -n "${FOAM_SRC:-}" ] || [ -d "/usr/src/$source/src" ] ||
      { echo "$name needs the headers of $source: scripts/setup.sh --adapters unpacks them" >&2; exit 77; }
  done <"$folder/sources"
fi
mkdir -p "$into"
cmake --install "$build" --component client --prefix "$into/installed" >"$into/log" || { cat "$into/log" >&2; exit 1; }
if [ -f "$folder/CMakeLists.txt" ]; then
  { cmake -S "$folder" -B "$into/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$into/installed" &&
    cmake --build "$into/build"; } >"$into/log" 2>&1 || { cat "$into/log" >&2; exit 1; }
  find "$into/build" -maxdepth 1 -type f -executable
else # a Python program finds the package that was installed
  script=$(find "$folder" -maxdepth 1 -name '*.py' -executable)
  printf '#!/bin/sh\nPYTHONPATH=%s/installed/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH} exec %s "$@"\n' "$into" "$script" >"$into/start"
  chmod +x "$into/start"
  echo "$into/start"
fi
