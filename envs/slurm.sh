#!/bin/sh
# Slurm and munge for tests/test_slurm.py, from Debian's packages; their services are not needed, and not started.
set -eu
missing=
for program in slurmctld slurmd sbatch munged; do
    command -v "$program" >/dev/null || missing="$missing $program"
done
if [ -z "$missing" ]; then
    exit 0
elif command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends slurmctld slurmd slurm-client munge >/dev/null
else
    echo "missing:$missing; as root on Debian: apt-get install slurmctld slurmd slurm-client munge" >&2
    exit 1
fi
