#!/usr/bin/env bash
# A run that cannot work must end within seconds with one message that says why.
# Usage: bad_start.sh SCENARIO BIN CASE MPIRUN...   (BIN: where the fake participants are)
set -uo pipefail
scenario=$1 bin=$2 case=$3
shift 3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
good=$scratch/case.yaml # a path of its own: what is still running afterwards is ours
cp "$case" "$good"

fluid=("$bin/fake_fluid" "$good") coupler=("$bin/stub_coupler" "$good") solid=("$bin/fake_solid" "$good")
f=2 c=1 s=1
with() { fluid+=(--set "$1"); coupler+=(--set "$1"); solid+=(--set "$1"); }
limit=10 extra=() more=() # extra: environment; more: a last part of the command line

case $scenario in
  no_coupler) c=0 expect='there is no coupler among the 3 ranks' ;;
  no_solid) s=0 expect='there is no solid among the 3 ranks' ;;
  no_fluid) f=0 expect='there is no fluid among the 2 ranks' ;;
  two_fluids)
    cp "$bin/fake_fluid" "$scratch/other_fluid"
    more=(: -n 1 "$scratch/other_fluid" "$good") expect='two programs want to be the fluid: fluid rank 0 .* fluid rank 2' ;;
  two_couplers)
    cp "$bin/stub_coupler" "$scratch/other_coupler"
    more=(: -n 1 "$scratch/other_coupler" "$good") expect='two programs want to be the coupler' ;;
  different_files)
    { cat "$good"; echo '# another'; } >"$scratch/other.yaml"
    solid=("$bin/fake_solid" "$scratch/other.yaml") expect='different case files: solid rank 0 .*other.yaml' ;;
  other_protocol) # what an adapter has that was built before a field was added
    LC_ALL=C sed 's/%s, protocol %08x/%s, protocol 1234/' "$bin/fake_solid" >"$scratch/solid"
    chmod +x "$scratch/solid"
    solid=("$scratch/solid" "$good")
    expect='different versions: solid rank 0 .* has .*protocol 1234, .* build the older one again with the other.s client library' ;;
  different_sets) solid+=(--set time.end=1); expect='different settings: the --set arguments of solid rank 0' ;;
  wrong_role) extra=(TEST_SOLID_ROLE=solids) expect="'solids' is no role" ;;
  coupler_as_client) extra=(TEST_SOLID_ROLE=coupler) expect='CoracleOpen joins a fluid or a solid' ;;
  solid_absent) solid=("$bin/absent" "$good") extra=(CORACLE_TIMEOUT=2)
    expect='fluid.0.: error: not all 4 ranks of this job have called CoracleOpen within 2 s' ;;
  fluid_absent) f=1 fluid=("$bin/absent" "$good") extra=(CORACLE_TIMEOUT=2) limit=15
    expect='coupler.0.: error: not all 3 ranks of this job have called CoracleOpen within 2 s' ;;
  solid_leaves) solid=("$bin/absent" "$good" leaves) extra=(CORACLE_TIMEOUT=2)
    expect='fluid.0.: error: not all 4 ranks of this job have called CoracleOpen within 2 s' ;;
  solid_unstarted) solid=("$bin/absent" "$good" unstarted) extra=(CORACLE_TIMEOUT=1) limit=20
    expect='fluid.0.: error: not all programs of this job have called MPI_Init within 11 s' ;;
  no_case_file) rm "$good"; expect='case.yaml.: No such file or directory' ;;
  no_argument) fluid=("${fluid[0]}") coupler=("${coupler[0]}") solid=("${solid[0]}") expect='no case file' ;;
  bad_yaml) echo 'time: [1, 2' >>"$good"; expect='case.yaml:[0-9]*: not valid YAML' ;;
  bad_set) with time.end=[1; expect='the value is not valid YAML' ;;
  unknown_section) echo 'fluidd: {a: 1}' >>"$good"; expect="unknown section 'fluidd' .did you mean 'fluid'" ;;
  unknown_key) with solid.falt=none; expect="unknown key 'solid.falt' .did you mean 'fault'" ;;
  bad_word) with fluid.fault=sing; expect="key 'fluid.fault': expected one of none, kill" ;;
  bad_wait) extra=(CORACLE_WAIT=nap) expect='CORACLE_WAIT must be spin, yield or sleep' ;;
  bad_timeout) extra=(CORACLE_TIMEOUT=soon) expect='CORACLE_TIMEOUT must be a number' ;;
  solid_killed) with solid.fault=kill; expect='solid rank 0 .process [0-9]*. died in step 4' ;;
  fluid_killed) with fluid.fault=kill; expect='fluid rank 1 .process [0-9]*. died in step 4' ;;
  coupler_killed) with coupler.fault=kill; expect='coupler rank 0 .process [0-9]*. died in step' ;;
  solid_segv) with solid.fault=segv; expect='solid.0.: error: received SIGSEGV (invalid memory access) in step 4: the job ends' ;;
  fluid_bus) with fluid.fault=bus; expect='fluid.1.: error: received SIGBUS .* in step 4: the job ends' ;;
  coupler_fpe) with coupler.fault=fpe; expect='coupler.0.: error: received SIGFPE .* in step 4: the job ends' ;;
  fluid_term) with fluid.fault=term; expect='fluid.1.: error: received SIGTERM in step 4: the job ends' ;;
  solid_overflow) with solid.fault=overflow; expect='solid.0.: error: received SIGSEGV .* in step 4: the job ends' ;;
  solid_finalizes) with solid.fault=finalize; expect='solid.0.: error: left the job in step 4' ;;
  fluid_finalizes) with fluid.fault=finalize; expect='fluid.1.: error: left the job in step 4' ;;
  coupler_finalizes) with coupler.fault=finalize; expect='coupler.0.: error: left the job in step 4' ;;
  solid_exits) with solid.fault=exit; expect='solid.0.: error: the program exited in step 4' ;;
  fluid_exits) with fluid.fault=exit; expect='fluid.1.: error: the program exited in step 4' ;;
  coupler_exits) with coupler.fault=exit; expect='coupler.0.: error: the program exited in step 4' ;;
  solid_closes) with solid.fault=close; expect='solid.0.: error: closed in step 4, before the end' ;;
  solid_nan) with solid.fault=nan; expect='solid.0.: error: velocity is -*nan at node [0-9]*, component 1, in step 4' ;;
  fluid_nan) with fluid.fault=nan; expect='fluid.1.: error: pressure is inf at element 6, component 4, in step 4' ;;
  coupler_nan) with coupler.fault=nan; expect='coupler.0.: error: force is -*nan at node 0, component 0, in step 4' ;;
  solid_handler) with solid.fault=close; extra=(TEST_HANDLER=1)
    expect="the host's handler has received: closed in step 4, before the end" ;;
  solid_order) with solid.fault=order
    expect='CoracleSubstep was called before CoracleReady: its place is between CoracleBegin and CoracleEnd' ;;
  solid_clockwise) with solid.fault=clockwise
    expect='element 1 (nodes 17, 10, 24) has the area -.* its nodes must be in counter-clockwise order' ;;
  solid_twice) with solid.fault=twice
    expect='element 0 of rank 0 and element 1 of rank 0 have the edge between nodes .* each must be given once' ;;
  solid_open) with solid.fault=open
    expect='the edge between nodes 3 and 10 of element 0 of rank 0 is on the volume.s boundary but no facet' ;;
  solid_turned) with solid.fault=turned
    expect='facet 1 of rank 0 .* is not on the volume.s boundary with the solid on its left' ;;
  solid_ids) with solid.fault=ids; expect='two nodes of this rank have the id 3 in step 0: ids must be unique' ;;
  solid_drift) with solid.fault=drift
    expect='node 38 has moved by .* in component 1 in step 4, its velocities over the substeps sum up to' ;;
  fluid_order) with fluid.fault=order; expect='CoracleEnd: CoracleSetFlow comes first, in every step' ;;
  fluid_missing) with fluid.fault=missing; expect='the pressure of 7 elements is missing in step 4' ;;
  solid_load) with solid.fault=load; expect='CoracleSetNodes: the mesh of a solid with CoracleSetPressureLoad does not change' ;;
  solid_hangs) with solid.fault=hang; extra=(CORACLE_TIMEOUT=2)
    expect='error: waited 2 s for MOTION of step 4 from solid rank 0' ;;
  fluid_hangs) with fluid.fault=hang; extra=(CORACLE_TIMEOUT=2)
    expect='fluid rank 1 on .* has not taken COUPLING of step 4 within 2 s\|waited 2 s for FLOW of step 4 from fluid rank 1' ;; # whether MPI buffers COUPLING
  coupler_hangs) with coupler.fault=hang; extra=(CORACLE_TIMEOUT=1)
    expect='error: .*coupler rank 0 on .* does it hang' ;;
  *) echo "no scenario '$scenario'" >&2; exit 2 ;;
esac

line=() # the parts of the command line that have ranks
part() { [ "$1" -eq 0 ] || line+=(${line[0]+:} -n "$@"); }
part "$f" "${fluid[@]}"
part "$c" "${coupler[@]}"
part "$s" "${solid[@]}"

start=$(date +%s%N)
timeout -k 5 30 env "${extra[@]}" "$@" "${line[@]}" "${more[@]}" >"$scratch/log" 2>&1
status=$?
elapsed=$((($(date +%s%N) - start) / 1000000)) # ms

fail() {
  echo "$scenario: $1 (status $status, ${elapsed} ms); expected '$expect', the run said:"
  cat "$scratch/log"
  exit 1
}
[ $status -ne 0 ] || fail 'the run ended as if all were well'
[ $elapsed -lt $((1000 * limit)) ] || fail "took longer than $limit s"
[ "$(grep -c 'error:' "$scratch/log")" -eq 1 ] || fail 'not exactly one error'
grep -qE "^coracle [a-z]+\[[0-9]+\]: error: " "$scratch/log" || fail 'the error has another form'
grep -q "$expect" "$scratch/log" || fail 'another error'
for _ in 1 2 3 4 5 6 7 8; do
  pgrep -f "$good" >/dev/null || exit 0
  sleep 0.25
done
fail 'processes are left over'
