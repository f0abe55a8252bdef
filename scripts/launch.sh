#!/usr/bin/env bash
# Starts a coupled run, or writes how to start it.
# Usage: scripts/launch.sh [options] CASE [--set key=value]...
#   --ranks F:C:S   ranks of fluid, coupler and solid (default 1:1:1)
#   --bin DIR       where the programs are: a build folder or an installation's bin (default: build beside this script)
#   --fluid, --coupler, --solid PROGRAM   another program for that part, e.g. --solid my_solid
#   --print WHAT    start nothing, print: colon (mpirun's command line), appfile (mpirun --app FILE),
#                   hydra (mpiexec -configfile FILE), srun (srun -n N --multi-prog FILE)
#   --write FILE    with --print: into FILE, and say how to use it
#   --mpirun ARGS   more arguments for mpirun, e.g. --mpirun "--hostfile nodes" (one string, split at blanks)
#   --alone         the solid alone: coracle-solid --alone, on the solid's ranks of --ranks (no fluid, no coupler)
#   --cluster       ranks have cores of their own: leave binding and slots to mpirun (default within a batch job)
# The case and the --set arguments go to all three programs, as they must.
set -euo pipefail
unset CDPATH # with it cd prints where it goes
root=$(cd "$(dirname "$0")/.." && pwd)

die() { echo "launch.sh: $*" >&2; exit 2; }
usage() { sed -n '2,13p' "$0" | cut -c3-; exit "$1"; }

ranks=1:1:1 bin=$root/build print="" write="" mpirun_args="" case="" sets=() alone="" parts=(fluid coupler solid)
cluster=${SLURM_JOB_ID:-${PBS_JOBID:-${LSB_JOBID:-}}}
declare -A program=([fluid]="" [coupler]="" [solid]="")
while [ $# -gt 0 ]; do
  case "$1" in
    --ranks | --bin | --fluid | --coupler | --solid | --print | --write | --mpirun | --set)
      [ $# -ge 2 ] || die "$1 needs a value"
      case "$1" in
        --ranks) ranks=$2 ;;
        --bin) bin=$2 ;;
        --fluid | --coupler | --solid) program[${1#--}]=$2 ;;
        --print) print=$2 ;;
        --write) write=$2 ;;
        --mpirun) mpirun_args=$2 ;;
        --set) sets+=(--set "$2") ;;
      esac
      shift 2 ;;
    --cluster) cluster=yes; shift ;;
    --alone) alone=--alone parts=(solid); shift ;;
    -h | --help) usage 0 ;;
    -*) die "unknown option '$1' (see --help)" ;;
    *) [ -z "$case" ] || die "two case files: '$case' and '$1'"; case=$1; shift ;;
  esac
done
[ -n "$case" ] || usage 2
[ ! -d "$case" ] || die "'$case' is a folder: name its case file, as in ${case%/}/case.yaml"
[ -f "$case" ] || die "no case file '$case'"
[[ $ranks =~ ^([1-9][0-9]*):([1-9][0-9]*):([1-9][0-9]*)$ ]] || die "--ranks '$ranks': expected F:C:S, each at least 1"
declare -A n=([fluid]=${BASH_REMATCH[1]} [coupler]=${BASH_REMATCH[2]} [solid]=${BASH_REMATCH[3]})
total=0
for part in "${parts[@]}"; do total=$((total + n[$part])); done

for part in "${parts[@]}"; do
  if [ -z "${program[$part]}" ]; then
    for candidate in "$bin/coracle-$part" "$bin/$part/coracle-$part" "$bin/bin/coracle-$part"; do
      [ -x "$candidate" ] && program[$part]=$candidate && break
    done
    [ -n "${program[$part]}" ] || die "no coracle-$part under '$bin': build it, or say --bin or --$part"
  fi
  [ -x "${program[$part]}" ] || die "'${program[$part]}' cannot be run"
done

# Files of launchers know no quotes: an argument with a blank cannot be written into them.
plain() { # WORDS: others that are written
  local word
  for word in "$case" "${sets[@]}" "${program[@]}" "$@"; do
    [[ $word != *[[:space:]\"\'\\]* ]] || die "--print $print cannot hold '$word': it has blanks or quotes; use colon"
  done
}

# Threads of a BLAS would fight with the ranks for cores.
export OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}
env_names=$(compgen -e | grep -E '^(CORACLE_|OPENBLAS_NUM_THREADS$|OMP_NUM_THREADS$|PYTHONPATH$|LD_LIBRARY_PATH$)' || true)

# Of the command line that is used or printed: appfiles are Open MPI's, and so is what is printed where no mpirun is.
openmpi() {
  [ "$print" = appfile ] || ! command -v mpirun >/dev/null || mpirun --version 2>/dev/null | grep -qi 'open mpi'
}
options=() each=() # for mpirun, and for every part of its command line
if openmpi; then
  for name in $env_names; do each+=(-x "$name=${!name}"); done
  [ "$(id -u)" -ne 0 ] || options+=(--allow-run-as-root)
  [ -n "$cluster" ] || options+=(--oversubscribe --bind-to none)
elif [ -z "$cluster" ]; then
  options+=(-bind-to none)
fi
read -ra more <<<"$mpirun_args"
options+=("${more[@]}")

colon=()
for part in "${parts[@]}"; do
  colon+=(${colon[0]+:} -n "${n[$part]}" "${each[@]}" "${program[$part]}" $alone "$case" "${sets[@]}")
done

# One line for each program, by the launcher's own grammar.
lines() {
  local part first=0 last
  for part in "${parts[@]}"; do
    case $1 in
      appfile) echo "-np ${n[$part]} ${each[*]} ${program[$part]}${alone:+ $alone} $case ${sets[*]}" ;;
      hydra) echo "-n ${n[$part]} ${program[$part]}${alone:+ $alone} $case ${sets[*]}" ;;
      srun)
        last=$((first + n[$part] - 1))
        echo "$first-$last ${program[$part]}${alone:+ $alone} $case ${sets[*]}"
        first=$((last + 1)) ;;
    esac
  done
}

case $print in
  "")
    [ -z "$write" ] || die "--write goes with --print"
    exec mpirun "${options[@]}" "${colon[@]}" </dev/null ;; # not what a loop around this script reads
  colon)
    text=$(printf '%q ' mpirun "${options[@]}" "${colon[@]}") use="bash $write" ;;
  appfile)
    plain "${each[@]}"; text=$(lines appfile) use="mpirun ${options[*]} --app $write" ;;
  hydra)
    plain; text=$(lines hydra) use="mpiexec -configfile $write" ;;
  srun)
    plain; text=$(lines srun) use="srun -n $total --multi-prog $write" ;;
  *) die "--print '$print': expected colon, appfile, hydra or srun" ;;
esac
if [ -n "$write" ]; then
  printf '%s\n' "$text" >"$write"
  echo "$use"
else
  printf '%s\n' "$text"
fi
