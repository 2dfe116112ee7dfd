"""The scripts that run all generated cases: one after the other, or as an array of jobs under Slurm."""

from roughfilm.foamcases.openfoam.allrun import FINISHED

ALL = "Allrun.all"
SLURM = "Allrun.slurm"

LIST = "cases.txt"
"""File with the directory of each case in a line."""

ALL_TEXT = f"""\
#!/bin/sh
# Runs all cases of {LIST} one after the other. A case that has finished is not run again; one that fails stops nothing.
cd "$(dirname "$0")" || exit 1
child=
trap 'trap "" INT TERM HUP; [ -n "$child" ] && kill "$child" 2>/dev/null && wait "$child"; exit 130' INT TERM HUP
failed=
number=0
total=$(grep -c . {LIST})
while read -r directory; do
    number=$((number + 1))
    if [ "$(cat "$directory/{FINISHED}" 2>/dev/null)" = 0 ]; then
        echo "$number of $total: $directory has finished before"
        continue
    fi
    echo "$number of $total: $directory"
    "$directory/Allrun" < /dev/null &
    child=$!
    wait "$child" || failed="$failed $directory"
    child=
done < {LIST}
if [ -z "$failed" ]; then echo "all $total cases have finished"; exit 0; fi
echo "failed:" >&2
for directory in $failed; do echo "  $directory" >&2; done
exit 1
"""

SLURM_TEXT = """\
#!/bin/bash
#SBATCH --job-name=roughfilm
#SBATCH --array=1-{last}
#SBATCH --ntasks={processes}
#SBATCH --cpus-per-task=1
#SBATCH --output=slurm-%A_%a.out
# Runs each case of {list} in a task of its own. Submit it in this directory: sbatch {name}
# Edit above: time limit (#SBATCH --time=1:00:00), partition, account, and tasks at a time (--array=1-{last}%20).
# Edit below: how OpenFOAM is found on the nodes, such as
#   module load openfoam      # if "module" is not found, write above: #!/bin/bash -l
#   . /opt/openfoam13/etc/bashrc
# Clusters limit the number of tasks. Further cases: sbatch --array=1-1000 --export=ALL,SKIP=1000 {name}
cd "${{SLURM_SUBMIT_DIR:-.}}" || exit 1
if [ ! -f {list} ]; then echo "{list} is not here; submit in the directory that has it" >&2; exit 1; fi
directory=$(sed -n "$((SLURM_ARRAY_TASK_ID + ${{SKIP:-0}}))p" {list})
if [ -z "$directory" ]; then echo "no case $SLURM_ARRAY_TASK_ID"; exit 0; fi
if [ "$(cat "$directory/{finished}" 2>/dev/null)" = 0 ]; then echo "$directory has finished before"; exit 0; fi
echo "$directory"
exec "$directory/Allrun"
"""


def slurm_text(cases: int, processes: int) -> str:
    """The text of the Slurm script for a number of cases, each with a number of processes."""
    return SLURM_TEXT.format(last=cases, processes=processes, list=LIST, name=SLURM, finished=FINISHED)
