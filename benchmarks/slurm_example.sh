#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# An example of a job for Slurm: sbatch benchmarks/slurm_example.sh CASE.prm
# Copy it and change what your cluster wants otherwise: sinfo lists partitions,
# `scontrol show node` memory and cores of a node.

#SBATCH --job-name=nacre
#SBATCH --nodes=2
# A rank for each core: nacre uses one thread per rank.
#SBATCH --ntasks-per-node=16
#SBATCH --cpus-per-task=1
# Of a node. nacre prints an estimate before it assembles; doc/parallel.md tells
# how to compute it beforehand.
#SBATCH --mem=32G
#SBATCH --time=04:00:00
#SBATCH --output=%x_%j.log
# Slurm sends USR1 ten minutes before the end. nacre needs no warning: its
# checkpoints are complete whenever it is killed, and this job is queued again.
#SBATCH --signal=B:USR1@600
#SBATCH --requeue
# #SBATCH --partition=...
# #SBATCH --account=...

set -euo pipefail

prm=${1:?usage: sbatch slurm_example.sh CASE.prm [options of nacre]}
shift
nacre=${NACRE:-$HOME/nacre/build/release/nacre}
# A file system that all nodes see.
output=${OUTPUT:-$PWD/output}
name=$(basename "$prm" .prm)

# A cluster's modules, or a container with Debian's packages:
# module load openmpi trilinos p4est dealii
# nacre="apptainer exec nacre.sif nacre"

# One thread for each rank, AVX-512 kernels of OpenBLAS where it doesn't know
# the processor (scripts/environment). The transport is the cluster's choice:
# no OMPI_MCA_* here.
export OMP_NUM_THREADS=1
if grep -qw avx512f /proc/cpuinfo; then
  export OPENBLAS_CORETYPE=${OPENBLAS_CORETYPE:-SKYLAKEX}
fi

# A path goes on where it was stopped, on any number of ranks.
restart=()
if [ -e "$output/$name.checkpoint" ]; then
  restart=(--restart)
fi

# Before the time is over: stop, and into the queue again.
requeue() {
  echo "out of time: queued again"
  scontrol requeue "$SLURM_JOB_ID"
}
trap requeue USR1

# shellcheck disable=SC2086  # nacre may be a command with options
srun --cpu-bind=cores $nacre "$prm" "${restart[@]}" \
  --set "Study/Output folder=$output" \
  --set "Study/Output format=hdf5" \
  "$@" &
wait $!
