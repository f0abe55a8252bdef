#!/usr/bin/env bash
# The launcher must start a run, and each of the ways it writes must be one that the launcher in question reads.
# Usage: launch.sh LAUNCHER BIN CASE
set -uo pipefail
launcher=$1 bin=$2 case=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
run=("$launcher" --fluid "$bin/fake_fluid" --coupler "$bin/stub_coupler" --solid "$bin/fake_solid" --ranks 2:1:2)

fail() { echo "$1"; cat "$scratch/log"; exit 1; }
expect() { # WHAT EXPECTED
  "${run[@]}" --print "$1" "$case" --set time.end=1 >"$scratch/log" 2>&1 || fail "--print $1 failed"
  diff "$scratch/log" - <<<"$2" || fail "--print $1 is another"
}
fluid="$bin/fake_fluid $case --set time.end=1"
coupler="$bin/stub_coupler $case --set time.end=1"
solid="$bin/fake_solid $case --set time.end=1"
expect hydra "-n 2 $fluid
-n 1 $coupler
-n 2 $solid"
expect srun "0-1 $fluid
2-2 $coupler
3-4 $solid"

timeout -k 5 30 "${run[@]}" "$case" --set time.end=1 >"$scratch/log" 2>&1 || fail 'the run failed'
runs=$(printf '1\n2\n' | while read -r end; do
  timeout -k 5 30 "${run[@]}" "$case" --set time.end="$end" >>"$scratch/log" 2>&1 && echo "$end"
done | wc -l)
[ "$runs" -eq 2 ] || fail "the launcher has read its caller's input: $runs runs of 2"
forms=(colon hydra)
! mpirun --version | grep -qi "open mpi" || forms=(colon appfile)
for form in "${forms[@]}"; do
  use=$("${run[@]}" --print $form --write "$scratch/$form" "$case" --set time.end=1) || fail "--write of $form failed"
  # shellcheck disable=SC2086 # the command is words
  timeout -k 5 30 $use >"$scratch/log" 2>&1 || fail "'$use' failed"
done

refuse() { # EXPECTED ARGUMENTS...
  local expected=$1
  shift
  "${run[@]}" "$@" >"$scratch/log" 2>&1 && fail "accepted $*"
  grep -q "$expected" "$scratch/log" || fail "another refusal than '$expected'"
}
refuse "no case file" "$scratch/none.yaml"
refuse "is a folder" "$scratch"
refuse "expected F:C:S" "$case" --ranks 1:0:1
refuse "unknown option" "$case" --rank 1:1:1
refuse "no coracle-fluid under" "$case" --bin "$scratch" --fluid ""
refuse "has blanks or quotes" "$case" --print srun --set "case='a b'"
PYTHONPATH="/a b" refuse "cannot hold 'PYTHONPATH=/a b'" "$case" --print appfile
