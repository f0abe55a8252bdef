#!/usr/bin/env bash
# An output folder: results of a finished run survive every run that is refused, a second run at the same time, and a new one;
# a checkpoint with a file of another one, or with a flipped bit, is refused.  Usage: folder.sh ROOT BUILD
set -euo pipefail
source "$(dirname "$0")/../coupled/run.sh"
case=$here/../coupled/disc.yaml
fail() { echo "$1"; exit 1; }
sums() { (cd "$scratch/x" && find . -path ./earlier.1 -prune -o -type f -print0 | sort -z | xargs -0 md5sum; readlink checkpoint); }
same() { [ "$(sums)" = "$before" ] || fail "$1 has changed the results"; }
# refused EXPECTED --set ...: a run into x ends with this error and leaves all as it was
refused() {
  local expect=$1
  shift
  ! run x 1:1:1 "$@" || fail "it ran: $*"
  [ "$(grep -c 'error:' "$scratch/x.log")" -eq 1 ] && grep -q "error:.*$expect" "$scratch/x.log" || { cat "$scratch/x.log"; fail "expected $expect"; }
  same "$*"
}

must x 1:1:1 --set time.end=0.05 --set output.trace=true --set 'fluid.probes=[{name: middle, point: [1.0, 1.0]}]' --set 'solid.probes=[{name: top, point: [1.0, 1.2]}]'
before=$(sums)
# the solid's seconds are those since its output is open: its wait for the others' set-up is not among them
tail -n +2 "$scratch/x/solid.csv" | awk -F, '$(NF-1) < 0 || $NF < 0 {exit 1}' || fail "computing or waiting took less than no time"
# the copy of the case says what it was run with, and is the case
head -1 "$scratch/x/case.yaml" | grep -q '^# coracle .* ranks of fluid, coupler, solid 1:1:1$' || fail "case.yaml does not say what ran"
grep -q "^#   --set 'time.end=0.05'$" "$scratch/x/case.yaml" || fail "case.yaml has no settings"
cmp <(grep -v '^#' "$scratch/x/case.yaml") <(grep -v '^#' "$case") || fail "case.yaml is not the case"
refused "fluid.boundaries.top" --set fluid.boundaries.top=slippery
refused "solid.bodies\[0\].colour" --set 'solid.bodies[0].colour=2'
refused "outside of the fluid domain" --set 'solid.bodies[0].centre=[1.95, 1.1]'
refused "coupler.mode" --set coupler.mode=magic

# while another run is writing there
exec 9<>"$scratch/x/running"
echo "process 1 on elsewhere since then" >&9
flock -n 9 || fail "no lock"
! run x 1:1:1 || fail "two runs in one folder"
grep -q "error: .*output.folder.*process 1 on elsewhere since then" "$scratch/x.log" || { cat "$scratch/x.log"; fail "the other run is not named"; }
exec 9>&-
rm "$scratch/x/running"
same "a second run"

# a case that is in its output folder is kept, too
mkdir "$scratch/y"
cp "$case" "$scratch/y/case.yaml"
case=$scratch/y/case.yaml must y 1:1:1 --set time.end=0.02
cmp "$here/../coupled/disc.yaml" "$scratch/y/earlier.1/case.yaml" || fail "the user's case is lost"
cmp <(grep -v '^#' "$scratch/y/case.yaml") <(grep -v '^#' "$scratch/y/earlier.1/case.yaml") || fail "the copy is another"

# a new run keeps the old results, with what Open MPI leaves of a run that is killed
touch "$scratch/x/coupler.h5-1234.lock"
must x 1:1:1 --set time.end=0.03
[ -e "$scratch/x/earlier.1/checkpoint/fluid.h5" ] && [ -s "$scratch/x/earlier.1/solid.h5" ] || fail "earlier results are lost"
for file in trace.json fluid_forces.csv fluid_probes.csv solid_probes.csv; do
  [ -s "$scratch/x/earlier.1/$file" ] || fail "$file is not with the earlier results"
done
[ -e "$scratch/x/earlier.1/coupler.h5-1234.lock" ] && [ ! -e "$scratch/x/coupler.h5-1234.lock" ] || fail "a lock of the earlier run is left"
[ ! -e "$scratch/x/fluid_probes.csv" ] || fail "probes of the earlier run are among the new results"
[ ! -e "$scratch/x/running" ] || fail "the folder is still locked"

# a name that Open MPI cannot take
long=$(printf 'a%.0s' $(seq 240))
! run long 1:1:1 --set "output.folder=$scratch/$long" || fail "a long name is accepted"
[ "$(grep -c error: "$scratch/long.log")" -eq 1 ] && grep -q "output.folder.*characters" "$scratch/long.log" || { cat "$scratch/long.log"; fail "not one line"; }

# checkpoints: of one step, and undamaged
must y 1:1:1 --set time.end=0.05
cp -r "$scratch/y" "$scratch/z"
cp "$scratch/x/checkpoint/solid.h5" "$scratch/z/checkpoint/solid.h5"
! run z 1:1:1 --set resume=last || fail "a file of another checkpoint is accepted"
grep -q "error: .*solid.h5 is not of this checkpoint: expected run .*, step 5, .* found run .*, step 3" "$scratch/z.log" ||
  { cat "$scratch/z.log"; fail "another message"; }
"$python" - "$scratch/y/checkpoint" "$scratch" <<'E2'
import h5py, numpy, os, sys
folder, scratch = sys.argv[1:]
def arrays(group):
    for item in group.values():
        yield from arrays(item) if isinstance(item, h5py.Group) else [item]
for name in ("fluid", "solid"):
    with h5py.File(f"{folder}/{name}.h5") as file:
        for array in arrays(file):
            assert array.fletcher32 or not array.size, f"{name}.h5: {array.name} has no checksum"
        largest = max(arrays(file), key=lambda a: a.nbytes)
        at = largest.id.get_chunk_info(0).byte_offset + 8 * 5 + 3
    damaged = f"{scratch}/damaged-{name}"
    os.system(f"cp -rL {folder} {damaged}")
    with open(f"{damaged}/{name}.h5", "r+b") as file:
        file.seek(at)
        byte = file.read(1)[0]
        file.seek(at)
        file.write(bytes([byte ^ 16]))
E2
for name in fluid solid; do
  ! run broken 1:1:1 --set "resume=$scratch/damaged-$name" --set time.end=0.1 || fail "a flipped bit in $name.h5 is accepted"
  grep -q "error: .*$name.h5\|error: .*HDF5 cannot read" "$scratch/broken.log" || { cat "$scratch/broken.log"; fail "another message"; }
done

# what a checkpoint is made of is on the disk before the link means it
if command -v strace >/dev/null; then
  strace -f -e trace=fsync,rename,openat -y -o "$scratch/trace" "$root/scripts/launch.sh" --bin "$build" "$case" --set "output.folder=$scratch/s" \
    --set time.end=0.02 >/dev/null 2>&1 || true
  if grep -q 'rename.*checkpoint' "$scratch/trace"; then
    sed '/rename.*checkpoint.new/,$d' "$scratch/trace" >"$scratch/before"
    for name in fluid.h5 solid.h5 coupler.h5 identity; do
      grep -q "fsync(.*checkpoint.2/$name>" "$scratch/before" || fail "$name is not synced"
    done
    grep -q "fsync(.*checkpoint.2>)" "$scratch/before" || fail "the checkpoint's folder is not synced"
    sed '1,/rename.*checkpoint.new/d' "$scratch/trace" >"$scratch/after"
    grep -q "fsync(.*$scratch/s>)" "$scratch/after" || fail "the link is not synced"
  fi
fi
