"""A Slurm of one node, whose programs are children of the tests and listen on the loopback interface alone."""

import getpass
import os
import shutil
import socket
import subprocess
import tempfile
from contextlib import ExitStack, closing
from pathlib import Path

import pytest
from batches import wait_for

from roughfilm.contact.foundation.child_processes import terminate_with_parent

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scancel", "squeue", "sinfo")
PATH = f"{os.environ['PATH']}:/usr/sbin:/sbin"

CONFIGURATION = """
ClusterName=tests
SlurmctldHost={node}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={place}/munge.socket
CredType=cred/munge
StateSaveLocation={place}/state
SlurmdSpoolDir={place}/spool
SlurmctldPidFile={place}/slurmctld.pid
SlurmdPidFile={place}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SchedulerParameters=batch_sched_delay=0,sched_interval=1
KillWait=2
NodeName={node} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=tests Nodes={node} Default=YES OverSubscribe=FORCE:4 State=UP
"""


class SlurmNode:
    """The programs of Slurm with their keys, state and logs in a directory that ends with them."""

    def __init__(self) -> None:
        if missing := [program for program in PROGRAMS if shutil.which(program, path=PATH) is None]:
            pytest.skip(f"Slurm is not here: no {missing[0]}; ./scripts/setup installs it where it may")
        self._held = ExitStack()
        self.place = Path(self._held.enter_context(tempfile.TemporaryDirectory(prefix="slurm-")))
        self.place.chmod(0o755)
        for name in ("state", "spool"):
            (self.place / name).mkdir()
        key = self.place / "munge.key"
        key.touch(0o600)
        key.write_bytes(os.urandom(128))
        configuration = self.place / "slurm.conf"
        controller_port, node_port = _free_ports(2)
        configuration.write_text(
            CONFIGURATION.format(
                node=socket.gethostname().partition(".")[0],
                controller_port=controller_port,
                node_port=node_port,
                user=getpass.getuser(),
                place=self.place,
                cores=os.cpu_count(),
            )
        )
        self.environment = {**os.environ, "PATH": PATH, "SLURM_CONF": str(configuration)}
        files = {
            "socket": "munge.socket",
            "pid-file": "munged.pid",
            "log-file": "munged.log",
            "seed-file": "munge.seed",
        }
        self._start("munged", "--foreground", "--force", f"--key-file={key}", *self._options(files))
        wait_for((self.place / "munge.socket").exists)
        self._start("slurmctld", "-D")
        self._start("slurmd", "-D")
        try:
            wait_for(lambda: self.answer("sinfo", "--noheader", "--format=%T") == "idle")
        except AssertionError as error:
            for log in self.place.glob("*.out"):
                error.add_note(f"{log.name}: {log.read_text()[-2000:]}")
            self.end()
            raise

    def answer(self, *command: object) -> str:
        """What a program of Slurm prints."""
        done = subprocess.run([*map(str, command)], env=self.environment, capture_output=True, text=True, check=False)
        return done.stdout.strip()

    def submitted(self, script: str, *options: str) -> str:
        """The number of a batch job, which is submitted."""
        path = self.place / "job.sh"
        path.write_text(script)
        place = (f"--chdir={self.place}", f"--output={self.place}/job-%a.out")
        number = self.answer("sbatch", "--parsable", *place, *options, path)
        assert number.isdigit()
        return number

    def end(self) -> None:
        self.answer("scancel", f"--user={getpass.getuser()}")
        try:
            wait_for(lambda: not self.answer("squeue", "--noheader"))
        finally:
            self._held.close()

    def _options(self, files: dict[str, str]) -> list[str]:
        return [f"--{name}={self.place / file}" for name, file in files.items()]

    def _start(self, program: str, *arguments: str) -> None:
        with (self.place / f"{program}.out").open("w") as log:
            process = subprocess.Popen(
                [*terminate_with_parent(), program, *arguments], env=self.environment, stdout=log, stderr=log
            )
        self._held.callback(process.wait)
        self._held.callback(process.terminate)


def _free_ports(count: int) -> list[int]:
    with ExitStack() as held:
        sockets = [held.enter_context(closing(socket.socket())) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]
