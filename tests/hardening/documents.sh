#!/usr/bin/env bash
# What documents repeat is what it is: versions, lines of adapters, links between documents, the case of the guide; and each public function has a test of its misuse.  Usage: documents.sh ROOT BUILD
set -euo pipefail
cd "$1"
build=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
status=0
wrong() { echo "$1"; status=1; }

version=$(sed -n 's/^project(coracle VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
grep -q "^#define CORACLE_VERSION \"$version\"" common/link/coracle.h || wrong "coracle.h is not of version $version"
grep -q "^version: $version" CITATION.cff || wrong "CITATION.cff is not of version $version"

while IFS='|' read -r _ folder _ _ lines _; do
  folder=$(tr -d ' `' <<<"$folder") lines=$(tr -d ' ' <<<"$lines")
  found=$(cat cases/adapters/"$folder"/*.{c,cc,h,f90,py} 2>/dev/null | wc -l || true)
  [ "$found" = "$lines" ] || wrong "cases/adapters/README.md: $folder has $found lines, not $lines"
  most=200
  [ ! -f "cases/adapters/$folder/fluid" ] || most=400
  [ "$found" -lt "$most" ] || wrong "cases/adapters/$folder has $found lines, $most are too many"
done < <(grep -E '^\| `[a-z0-9_]+` \|' cases/adapters/README.md)

for document in *.md cases/*.md cases/*/*.md cases/adapters/*/*.md common/*.md common/*/*.md {fluid,coupler,solid}/*.md tests/*.md; do
  while read -r link; do
    [ -e "$(dirname "$document")/$link" ] || wrong "$document: there is no $link"
  done < <(grep -oE '\]\([^)#:]+' "$document" | cut -c3- || true)
done

# each public function is used wrongly somewhere, but for those that cannot be; CoracleOpen*'s ways are those of tests/route/bad_start.sh
for function in $(grep -ohE '\bCoracle[A-Z][A-Za-z]*\(' common/link/coracle.h common/link/case_file.h | tr -d '(' | sort -u); do
  case $function in
    CoracleVersion | CoracleSetErrorHandler | CoracleClose | CoracleOpen*) continue ;;
    CoracleCase*) file=tests/link/test_case_misuse.c ;;
    *) file=tests/route/misuse.c ;;
  esac
  grep -q "NOBODY($function,\|REFUSED($function(\|$function(" "$file" || wrong "no wrong use of $function is tested in $file"
done

awk '/^```yaml/ {on = 1; next} /^```/ {on = 0} on' cases/GUIDE.md >"$scratch/my_discs.yaml"
scripts/check.sh --bin "$build" "$scratch/my_discs.yaml" >"$scratch/log" || { wrong "the guide's case is refused"; cat "$scratch/log"; }
exit $status
