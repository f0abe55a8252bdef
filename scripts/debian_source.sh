#!/usr/bin/env bash
# Unpacks the source of a Debian package, as its authors released it: by apt's own sources with deb turned into deb-src.
# Usage: scripts/debian_source.sh NAME FOLDER [arguments of tar, e.g. --wildcards '*/src/*']
set -euo pipefail
unset CDPATH # with it cd prints where it goes
[ $# -ge 2 ] || { sed -n '2,3p' "$0" | cut -c3-; exit 2; }
name=$1 folder=$(realpath -m "$2")
shift 2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$scratch"/{parts,lists/partial,cache} "$folder"
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources; do
  [ ! -f "$file" ] || sed 's/^Types:.*/Types: deb-src/; s/^deb /deb-src /' "$file" >"$scratch/parts/$(basename "$file")"
done
[ ! -f "$scratch/parts/sources.list" ] || mv "$scratch/parts/sources.list" "$scratch/parts/main.list"
options=(-qq -o Dir::Etc::sourcelist=- -o "Dir::Etc::sourceparts=$scratch/parts" -o "Dir::State::lists=$scratch/lists"
  -o "Dir::Cache=$scratch/cache" -o "APT::Sandbox::User=$(id -un)")
cd "$scratch"
apt-get "${options[@]}" update
apt-get "${options[@]}" --download-only source "$name"
tar xf "$name"_*.orig.tar.* -C "$folder" --strip-components=1 "$@"
