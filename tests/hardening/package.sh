#!/usr/bin/env bash
# The .deb, installed into a scratch root, runs a case, checks one, and lets outside solids in all languages build against its library.
# Usage: package.sh ROOT BUILD
set -euo pipefail
root=$1 build=$2
command -v dpkg-deb >/dev/null && command -v dpkg-shlibdeps >/dev/null || { echo 'this system makes no .deb'; exit 77; }
petsc=$(ldd "$build/fluid/coracle-fluid" | awk '/libpetsc/ {print $3}')
dpkg -S "$(realpath "$petsc")" >/dev/null 2>&1 || { echo "no package has $petsc, on which a .deb could depend"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
there=$scratch/root
say() { echo "$1"; cat "$scratch/log"; exit 1; }
# CPack asks `file` of each file through `cmake -E env`, whose start takes longer than all else
printf '#!/bin/sh\n[ "$1 $2" = "-E env" ] || exec cmake "$@"\nshift 2\nexec env "$@"\n' >"$scratch/cmake" && chmod +x "$scratch/cmake"
(cd "$scratch" && cpack -G DEB -D "CMAKE_COMMAND=$scratch/cmake" --config "$build/CPackConfig.cmake" -B "$scratch/pack") >"$scratch/log" 2>&1 || say 'cpack failed'
deb=$(find "$scratch/pack" -maxdepth 1 -name 'coracle_*.deb')
dpkg-deb -f "$deb" Depends | grep -q 'libpetsc-real.*\|petsc' || say 'the package does not depend on PETSc'
mkdir -p "$there/var/lib/dpkg"/{info,updates,triggers}
touch "$there/var/lib/dpkg/status"
if [ "$(id -u)" -eq 0 ]; then
  dpkg --root="$there" --force-depends --unpack "$deb" >"$scratch/log" 2>&1 || say 'dpkg failed'
else
  dpkg-deb -x "$deb" "$there"
fi

cd "$scratch"
coracle=$there/usr/bin/coracle
cp "$root/tests/coupled/disc.yaml" .
"$coracle" check disc.yaml >log 2>&1 || say 'coracle check failed'
timeout -k 5 120 "$coracle" run disc.yaml --set time.end=0.02 >log 2>&1 || say 'coracle run failed'
[ -s out/disc/summary.json ] || say 'no results beside the user'
[ -f "$("$coracle" cases)/falling_cylinder/case.yaml" ] || say 'no cases'

export PKG_CONFIG_PATH=$there/usr/lib/pkgconfig
# shellcheck disable=SC2046 # the flags are words
mpicc "$("$coracle" cases)/adapters/template_c/rigid_disc.c" -o rigid_disc $(pkg-config --define-prefix --cflags --libs coracle-client) -lm >log 2>&1 ||
  say 'an outside solid does not compile'
LD_LIBRARY_PATH=$there/usr/lib "$coracle" conform --solid ./rigid_disc --ranks 1 disc.yaml >log 2>&1 || say 'coracle conform failed'
"$root/tests/route/languages.sh" "$root" "$build" "$there/usr" gnu >log 2>&1 || say 'a client in another language fails'
