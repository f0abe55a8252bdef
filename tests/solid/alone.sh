#!/bin/sh
# The solid alone, on one rank and on two: outputs, the same series, and what Coulomb says.
# alone.sh SOURCE BUILD
set -eu
folder=$2/alone
mkdir -p "$folder"
for ranks in 1 2; do
  "$1/scripts/launch.sh" --alone --ranks 1:1:$ranks --bin "$2" "$1/tests/solid/alone.yaml" \
    --set output.folder="$folder/$ranks" >"$folder/$ranks.log"
  grep -q 'coracle: t 0.2 s of 0.2, step 20' "$folder/$ranks.log" || { echo "no progress line in $folder/$ranks.log"; exit 1; }
  [ -s "$folder/$ranks/solid.h5" ] || { echo "no $folder/$ranks/solid.h5"; exit 1; }
  head -1 "$folder/$ranks/case.yaml" | grep -q "^# coracle .*, the solid alone, ranks $ranks$" || { echo "case.yaml does not say what ran"; exit 1; }
  for part in '"mode": "alone"' '"steps": 20' '"elements": {"solid": 16, "surface": 12}' '"solid": {"elements": 16, "bodies": 1, "substeps": [1-9]' "\"ranks\": $ranks,"; do
    grep -q "$part" "$folder/$ranks/summary.json" || { echo "no $part:"; cat "$folder/$ranks/summary.json"; exit 1; }
  done
done
# u0 is column 4; 5 - 0.2 * 8 = 3.4 m/s2 once it slides
tail -n 2 "$folder/1/solid.csv" | awk -F, '
  { if (NR == 1) { t = $1; u = $4 } else { a = ($4 - u) / ($1 - t); if (a < 3.366 || a > 3.434) { print "acceleration", a; exit 1 } } }'
paste -d, "$folder/1/solid.csv" "$folder/2/solid.csv" | awk -F, 'NR > 1 {
  n = NF / 2
  for (k = 1; k <= 10; k++) if (($k - $(k + n)) ^ 2 > 1e-16) { print "row", NR, "column", k ":", $k, "and", $(k + n); exit 1 } }'
# one that resumes from its checkpoint, on other ranks too, goes on in its files as if it had not ended
for ranks in 1 2; do
  rm -rf "$folder/resumed"
  for part in "0.1 1" "0.2 $ranks"; do
    "$1/scripts/launch.sh" --alone --ranks "1:1:${part#* }" --bin "$2" "$1/tests/solid/alone.yaml" --set resume=last \
      --set output.folder="$folder/resumed" --set time.end="${part% *}" >"$folder/resumed.log" 2>&1 || { cat "$folder/resumed.log"; exit 1; }
  done
  paste -d, "$folder/1/solid.csv" "$folder/resumed/solid.csv" | awk -F, 'NR > 1 {
    n = NF / 2
    if ($(1 + n) == "") { print "no row", NR; exit 1 }
    for (k = 1; k <= 10; k++) if (($k - $(k + n)) ^ 2 > 1e-16) { print "resumed: row", NR, "column", k ":", $k, "and", $(k + n); exit 1 } }'
done
grep -q '"resumed_at": 0[.]\(0999\|1\)' "$folder/resumed/summary.json" || { cat "$folder/resumed/summary.json"; exit 1; }
[ ! -e "$folder/resumed/checkpoint.10" ] && [ -e "$folder/resumed/checkpoint/solid.h5" ] || { echo "checkpoints:"; ls "$folder/resumed"; exit 1; }
if "$2/solid/coracle-solid" --alone "$1/tests/solid/alone.yaml" --set output.folder="$folder/resumed" --set resume=last >"$folder/bad.log" 2>&1; then
  echo "a run that has ended was resumed"; exit 1
fi
grep -q "key 'time.end': the checkpoint to resume from is at t = 0.2 s already" "$folder/bad.log" || { cat "$folder/bad.log"; exit 1; }
if "$2/solid/coracle-solid" --alone "$1/tests/solid/alone.yaml" --set output.folder="$folder/resumed" --set resume=last --set time.end=0.3 \
  --set 'solid.bodies[1]={shape: disc, centre: [0.5, 0.2], radius: 0.1, size: 0.05, material: stone}' >"$folder/bad.log" 2>&1; then
  echo "a checkpoint of other bodies was taken"; exit 1
fi
grep -q "^coracle solid.0.: error: cannot resume from .*it has 1 bodies, the case has 2" "$folder/bad.log" && ! grep -qi petsc "$folder/bad.log" ||
  { cat "$folder/bad.log"; exit 1; }
# what is wrong is said once, by name
if "$2/solid/coracle-solid" --alone "$1/tests/solid/alone.yaml" --set time.end=-1 >"$folder/bad.log" 2>&1; then
  echo "a negative end was taken"; exit 1
fi
grep -q "key 'time.end': expected a number > 0" "$folder/bad.log" || { cat "$folder/bad.log"; exit 1; }
