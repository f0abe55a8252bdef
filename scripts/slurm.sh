#!/bin/bash
# A batch job for Slurm: copy it, change the lines below, and `sbatch slurm.sh my_case.yaml [--set key=value]...`
#SBATCH --job-name=coracle
#SBATCH --ntasks=21
#SBATCH --cpus-per-task=1
#SBATCH --time=02:00:00
#SBATCH --output=%x-%j.log
set -euo pipefail
ranks=16:1:4                 # fluid : coupler : solid, together --ntasks
coracle=$HOME/coracle        # the repository with its build folder; of an installed package: /usr/share/coracle
bin=$coracle/build           # of an installed package: /usr/bin

export OPENBLAS_NUM_THREADS=1
programs=coracle-$SLURM_JOB_ID.conf
# the run ends five minutes before the job does, or half way if that is sooner, with a checkpoint; sbatch slurm.sh my_case.yaml --set resume=last goes on
if [ -n "${SLURM_JOB_END_TIME:-}" ]; then
  left=$((SLURM_JOB_END_TIME - $(date +%s)))
  set -- "$@" --set time.walltime=$((left > 600 ? left - 300 : left > 2 ? left / 2 : 1))
fi
"$coracle/scripts/launch.sh" --bin "$bin" --ranks "$ranks" --print srun --write "$programs" "$@"
srun -n "$SLURM_NTASKS" --multi-prog "$programs"
