r"""The script ``Allrun`` of a case, which runs it with OpenFOAM and a POSIX shell alone, as this library runs it.

It checks the mesh, runs simpleFoam for each flow until the flow has settled, takes stronger settings if it does not
converge, and verifies the fields by one more iteration in a new process. The flow has settled by the criterion of
:func:`roughfilm.foamcases.openfoam.settling.settled_within`, which the script computes with ``awk``. It waits for each
program itself, so that nothing of it is left when it ends.
"""

from collections.abc import Mapping

from roughfilm.foamcases.openfoam.dialect import Dialect
from roughfilm.foamcases.openfoam.dictionaries import SECOND_TRY
from roughfilm.foamcases.openfoam.installation import NAMES, PLACES, SETTINGS, VARIABLE
from roughfilm.foamcases.openfoam.iterate import STOP
from roughfilm.foamcases.openfoam.residuals import PATIENCE, Judged
from roughfilm.foamcases.openfoam.settling import MAX_STEP_RATIO, MEAN_VELOCITY, MIN_VELOCITY, WINDOW

ALLRUN = "Allrun"
"""Name of the script."""

FINISHED = "finished"
"""Name of the file that ``Allrun`` writes at its end, with its exit code."""

DIGESTS = "digests.sha256"
"""Name of the file that ``Allrun`` writes at its end, with the digest of every file of the case."""

EXIT_CODE = "Allrun: exit code"
"""Words before the exit code of a program in the last line of its log."""

RUNNING = "running/process"
"""Name of the file with host and process of an ``Allrun`` that runs; its directory is the lock of the case."""

SETTLED = "Allrun: the flow has settled"
"""Line of a log for a run that was ended because its flow had settled."""

HEAD = f"""\
#!/bin/bash
# Checks the mesh, runs simpleFoam until the flow has settled, and verifies the fields by one more iteration.
# It needs OpenFOAM and a shell. The mesh is in constant/polyMesh: no blockMesh is needed.
# Each log ends with the exit code of its program. The file "{FINISHED}" is written at the end, with the exit code.
# OpenFOAM is the one that {VARIABLE} names, else that on the PATH, else the first that is found.
named=${VARIABLE}
if [ -e "$named" ]; then case $named in /*) ;; *) named=$PWD/$named ;; esac; fi
cd "$(dirname "$0")" || exit 1
set --
if [ -d "$named" ]; then named=$named/etc/bashrc; fi
if [ "${{named##*/}}" = bashrc ] || {{ [ -f "$named" ] && [ ! -x "$named" ]; }}; then
    if [ ! -f "$named" ]; then echo "{VARIABLE}: no file $named; it must be {NAMES}" >&2; exit 1; fi
    . "$named"
elif [ -n "$named" ]; then
    if ! command -v "${{named%% *}}" > /dev/null; then
        echo "{VARIABLE}: got '$named'; it must be {NAMES}" >&2
        exit 1
    fi
    unset {VARIABLE}
    exec $named "$PWD/Allrun"
elif ! command -v simpleFoam > /dev/null; then
    for place in $WM_PROJECT_DIR {" ".join(PLACES)}; do
        if [ -f "$place/etc/bashrc" ]; then . "$place/etc/bashrc"; break; fi
    done
elif [ -z "$WM_PROJECT_DIR" ]; then
    WM_PROJECT_DIR=$(dpkg -L openfoam 2>/dev/null | sed -n 's|/etc/controlDict$||p' | head -n 1)
    export WM_PROJECT_DIR
fi
export FOAM_SIGFPE=true
"""

BODY = r"""
# Rules of awk that find the residuals of each iteration in a log. They call iteration() with the greatest residual of
# the judged fields in "greatest", which is -1 if a residual is not finite.
residual_rules='
    BEGIN {
        count = split(judged, names, " ")
        for (k = 1; k <= count; k++) known[names[k]] = 1
        main = names[1]
    }
    in_log && /Solving for (Ux|Uy|Uz|p), Initial residual = / {
        name = $0; sub(/.*Solving for /, "", name); value = name
        sub(/,.*/, "", name)
        sub(/.*Initial residual = /, "", value); sub(/,.*/, "", value)
        if (value !~ /^[0-9]/) broken = 1
        found[name] = value + 0
        if (name == "p" && main in found) {
            greatest = broken ? -1 : 0
            for (one in found) if (!broken && one in known && found[one] > greatest) greatest = found[one]
            split("", found); broken = 0
            iteration()
        }
    }'

# Whether the greatest residual in a log has not halved for "patience" iterations: stagnant LOG
stagnant() {
    awk -v judged="$judged" -v patience="$patience" -v in_log=1 "$residual_rules"'
        function iteration() {
            n++
            if (greatest >= 0 && (!marked || greatest <= mark / 2)) { mark = greatest; marked = n }
            if (n - marked >= patience) { stuck = 1; exit }
        }
        END { exit !stuck }' "$1"
}

# Whether the flow has settled, by its last residuals and mean velocities: settled LOG
settled() {
    means=postProcessing/$means_name/$from/volFieldValue.dat
    [ -f "$means" ] || return 1
    { tail -n $((2 * window + 1)) "$means"; echo log; tail -c 8000 "$1"; } | awk \
        -v judged="$judged" -v most="$most" -v tolerance="$tolerance" -v window="$window" \
        -v least_velocity="$least_velocity" -v greatest_ratio="$greatest_ratio" "$residual_rules"'
        function iteration() { complete = 1 }
        BEGIN { column = main == "Uy" ? 3 : 2 }
        $0 == "log" { in_log = 1; next }
        !in_log && /^[0-9].*\)$/ { gsub(/[()]/, " "); mean[++means] = $column + 0 }
        END {
            if (!complete || greatest < 0 || greatest > most || means <= 2 * window) exit 1
            for (k = means; k > means - 2 * window; k--) {
                step = mean[k] - mean[k - 1]; if (step < 0) step = -step
                if (k > means - window) { if (step > last) last = step }
                else if (step > before) before = step
            }
            ratio = before > 0 && last > 0 ? exp(log(last / before) / window) : 1
            if (ratio > greatest_ratio) ratio = greatest_ratio
            size = mean[means] < 0 ? -mean[means] : mean[means]
            if (size < least_velocity) size = least_velocity
            exit (last * ratio / (1 - ratio) / size > tolerance)
        }'
}

# Runs a program with its output in log.NAME, to which its exit code is added: run NAME COMMAND...
# With watch=settling it ends the program by the file STOP as soon as the flow has settled, and sets watch=settled.
# With watch=settling or watch=residual it stops a program whose residual stagnates, and sets watch=stagnant.
run() {
    name=$1; shift
    "$@" > "log.$name" 2>&1 &
    child=$!
    looks=0
    while { [ "$watch" = settling ] || [ "$watch" = residual ]; } && kill -0 "$child" 2>/dev/null; do
        looks=$((looks + 1))
        if [ "$looks" -le 200 ]; then pause=0.05; else pause=0.5; fi
        sleep "$pause" 2>/dev/null || sleep 1
        if [ "$watch" = settling ] && settled "log.$name"; then
            : > "$stop_file"; watch=settled
        elif [ $((looks % 40)) = 0 ] && stagnant "log.$name"; then
            kill "$child" 2>/dev/null; watch=stagnant
        fi
    done
    wait "$child"; code=$?
    child=
    if [ "$watch" = settled ] && [ "$code" = 0 ]; then echo "$settled_line" >> "log.$name"; fi
    echo "$code_words $code" >> "log.$name"
    return "$code"
}

# The number of the last iteration on disk.
latest() {
    if [ -d processor0 ]; then ls processor0; else ls; fi | grep '^[0-9][0-9]*$' | sort -n | tail -n 1
}

# Runs simpleFoam from the last fields. Returns 0 if it converges, 1 if not, 2 after another error: try NAME WATCH
try() {
    watch=
    if [ "$processes" -gt 1 ] && [ ! -d processor0 ]; then run decomposePar decomposePar || return 2; fi
    rm -f "$stop_file"
    from=$(latest)
    watch=$2
    if [ "$processes" -gt 1 ]; then
        run "$1" mpirun -np "$processes" simpleFoam -parallel
    else
        run "$1" simpleFoam
    fi
    if [ "$watch" = settled ] && [ "$code" = 0 ]; then return 0; fi
    if grep -q "SIMPLE solution converged in" "log.$1"; then return 0; fi
    if [ "$code" = 0 ] || [ "$code" = 136 ] || [ "$watch" = stagnant ]; then return 1; fi
    return 2
}

# Removes the fields, means and parts of an earlier run.
clean() {
    for name in [1-9]*; do
        case $name in *[!0-9]*) ;; *) rm -rf "$name" ;; esac
    done
    rm -rf processor* postProcessing "$stop_file"
}

# Gives back the dictionaries in system that a second try or the verification has changed.
restore() {
    if [ -d system.asked ]; then rm -rf system && mv system.asked system; fi
}

# Computes a flow and verifies it: flow DIRECTORY FIELDS
flow() {
    cd "$1" || return 1
    label=$1
    [ "$label" != . ] || label="the flow"
    judged=$2
    restore
    clean
    rm -f log.decomposePar log.simpleFoam log.start log.retry log.reconstructPar log.verify
    try simpleFoam "$criterion"
    ended=$?
    if [ "$ended" = 1 ]; then
        echo "$label: not converged; a second try with stronger settings follows"
        clean
        cp -R system system.asked
        cp "$second_try/start/system/"* system
        try start residual
        ended=$?
        if [ "$ended" = 0 ]; then
            cp "$second_try/rest/system/"* system
            try retry "$criterion"
            ended=$?
        fi
    fi
    watch=
    if [ "$ended" = 0 ] && [ "$processes" -gt 1 ]; then
        run reconstructPar reconstructPar -latestTime || ended=2
    fi
    if [ "$ended" = 0 ]; then
        rm -rf processor*
        iterations=$(latest)
        [ -d system.asked ] || cp -R system system.asked
        sed "s/^endTime .*/endTime $((iterations + 1));/" system.asked/controlDict > system/controlDict
        run verify simpleFoam || ended=2
    fi
    restore
    grep -h "SIMPLE solution converged" log.simpleFoam log.start log.retry 2>/dev/null
    case $ended in
        0) echo "$label: converged after $iterations iterations" ;;
        1) echo "$label: not converged; see the logs" ;;
        *) echo "$label: a program stopped in error; see the logs" ;;
    esac
    cd "$top" || return 1
    return "$ended"
}

# The dialect that the OpenFOAM of a log reads; nothing if the log states no release: dialect_of LOG
dialect_of() {
    head -n 40 "$1" | awk '
        /^Build *:.*OPENFOAM=[0-9]/ { print "com"; exit }
        /openfoam\.org/ { org = 1 }
        org && sub(/.*Version: +/, "") { sub(/[ |-].*/, ""); print ($0 == "7" ? "com" : "org"); exit }'
}

# Takes the lock of the case, the directory "running", or ends with the reason; that of a process that is gone is taken.
lock() {
    host= process=
    if [ -f running/process ]; then read -r host process < running/process; fi
    if [ "$host" = "$(uname -n)" ] && ! kill -0 "$process" 2>/dev/null && [ ! -d "/proc/$process" ]; then
        rm -rf running
    fi
    if ! mkdir running 2>/dev/null; then
        if [ -d running ]; then
            echo "$top: is running on ${host:-another host} (process ${process:-unknown});" \
                "remove $top/running if it is not" >&2
        else
            echo "$top: cannot be written" >&2
        fi
        exit 1
    fi
    trap 'rm -rf "$top/running"' EXIT
    echo "$(uname -n) $$" > running/process
}

# Ends the running program, gives back the dictionaries, and ends with an exit code.
interrupt() {
    trap '' INT TERM HUP
    if [ -n "$child" ]; then kill "$child" 2>/dev/null; wait "$child"; fi
    restore
    exit "$1"
}

LC_ALL=C
export LC_ALL
top=$(pwd)
child=
watch=
trap 'interrupt 130' INT
trap 'interrupt 143' TERM
trap 'interrupt 129' HUP
if [ -n "$first" ]; then
    if ! command -v simpleFoam > /dev/null; then
        echo "no OpenFOAM: no simpleFoam on the PATH; source its bashrc, or name it in $variable" >&2
        exit 1
    fi
    case $top in *[[:space:]]*)
        echo "'$top': OpenFOAM takes no blanks in a path; move the case to another place" >&2
        exit 1 ;;
    esac
fi
lock
rm -f finished digests.sha256
status=0
if [ -n "$first" ]; then
    cd "$first" || exit 1
    if [ -n "$mesher" ]; then run "${mesher%% *}" $mesher || status=1; fi
    if [ "$status" = 0 ]; then run checkMesh checkMesh || status=1; fi
    grep -h "Mesh OK" log.checkMesh
    found=
    if [ "$status" = 0 ]; then found=$(dialect_of log.checkMesh); fi
    if [ -n "$found" ] && [ "$found" != "$dialect" ]; then echo "$top: $refusal" >&2; status=1; fi
    cd "$top" || exit 1
fi
"""

FOOT = f"""\
if command -v sha256sum > /dev/null; then
    find . -type f ! -path './running/*' ! -name '.*' -exec sha256sum {{}} + > .digests && mv .digests {DIGESTS}
fi
echo "$status" > .finished && mv .finished finished
exit "$status"
"""


def allrun(
    flows: Mapping[str, Judged],
    *,
    tolerance: float,
    processes: int,
    dialect: Dialect,
    settles: bool = True,
    mesher: str = "",
) -> str:
    """The text of ``Allrun``.

    Parameters
    ----------
    flows : the directory of each flow below that of the script, with the criteria by which it has converged.
    tolerance : the residual, or the remaining relative change of the flow, at which a run ends.
    processes : number of processes.
    dialect : the dialect in which the case is written; the script refuses an OpenFOAM that reads the other.
    settles : whether a run may end when its flow has settled, before simpleFoam's residual control ends it.
    mesher : program, with its options, that makes the mesh in the first directory; "" if the mesh is written.
    """
    slack = max((judged.slack for judged in flows.values()), default=1.0)
    values = {
        "first": next(iter(flows), ""),
        "mesher": f"'{mesher}'",
        "processes": processes,
        "variable": VARIABLE,
        "dialect": dialect.name,
        "refusal": f"'{dialect.refusal}'",
        "tolerance": f"{tolerance:.12g}",
        "most": f"{slack * tolerance:.12g}",
        "criterion": "settling" if settles else "residual",
        "patience": PATIENCE,
        "window": WINDOW,
        "least_velocity": f"{MIN_VELOCITY:.12g}",
        "greatest_ratio": MAX_STEP_RATIO,
        "means_name": MEAN_VELOCITY,
        "stop_file": STOP,
        "second_try": SECOND_TRY,
        "settled_line": f"'{SETTLED}'",
        "code_words": f"'{EXIT_CODE}'",
    }
    head = "".join(f"{name}={value}\n" for name, value in values.items())
    if processes > 1:
        head += "".join(f"export {name}={value}\n" for name, value in SETTINGS.items())
    steps = []
    for name, judged in flows.items():
        fields = " ".join((judged.main, *(field for field in judged.fields if field != judged.main)))
        steps.append(f"if [ \"$status\" = 0 ]; then flow '{name}' '{fields}' || status=1; fi\n")
    return HEAD + head + BODY + "".join(steps) + FOOT
