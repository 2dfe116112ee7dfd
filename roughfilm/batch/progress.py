"""The progress of a batch: the number of jobs by state, and the cost of the remaining jobs."""

from collections import defaultdict
from dataclasses import dataclass, field
from enum import StrEnum

from roughfilm.batch.execute import STORING_S, expected_cost
from roughfilm.batch.jobs import Failure, Job
from roughfilm.rom.ladder.result import Result


class State(StrEnum):
    """The state of a job; ``FINISHED`` means solved by an earlier run, ``SOLVED`` by this one."""

    FINISHED = "finished"
    SOLVED = "solved"
    FAILED = "failed"
    LEFT_OUT = "left out"
    TO_DO = "to do"


@dataclass(kw_only=True)
class Account:
    """The jobs of one setting and their CPU time.

    Attributes
    ----------
    jobs : number of jobs by state.
    to_come : expected CPU time of the remaining jobs, s.
    largest : expected CPU time of the most expensive job of this run, s.
    expected : expected CPU time of the solved jobs, s.
    measured : measured CPU time of the solved jobs, s.
    """

    jobs: dict[State, int] = field(default_factory=lambda: dict.fromkeys(State, 0))
    to_come: float = 0.0
    largest: float = 0.0
    expected: float = 0.0
    measured: float = 0.0

    @property
    def ratio(self) -> float:
        """The ratio of measured to expected CPU time, which corrects the expected time of the remaining jobs."""
        return self.measured / self.expected if self.expected else 1.0

    @property
    def remaining(self) -> float:
        """The corrected CPU time of the remaining jobs, s."""
        return self.to_come * self.ratio if self.jobs[State.TO_DO] else 0.0


@dataclass(kw_only=True)
class BatchProgress:
    """The progress of all settings of a batch.

    Attributes
    ----------
    accounts : account by name of the setting.
    failures : jobs that failed, with the reason.
    warned : number of results with a warning in the table, counted when that is made.
    spent : corrected expected CPU time of the jobs that this run finished, s.
    """

    accounts: dict[str, Account] = field(default_factory=lambda: defaultdict(Account))
    failures: list[tuple[Job, Failure]] = field(default_factory=list)
    warned: int = 0
    spent: float = 0.0

    def expect(self, job: Job) -> None:
        """Count a job that is to be solved."""
        account, cost = self.accounts[job.setting.name], expected_cost(job)
        account.jobs[State.TO_DO] += 1
        account.to_come += cost
        account.largest = max(account.largest, cost)

    def leave_out(self, job: Job) -> None:
        """Count a job whose model does not apply to its scene."""
        self.accounts[job.setting.name].jobs[State.LEFT_OUT] += 1

    def reuse(self, job: Job, answer: Result | Failure) -> None:
        """Count an answer from an earlier run."""
        self._take(job, answer, State.FINISHED)

    def receive(self, job: Job, answer: Result | Failure) -> None:
        """Count the answer of a job that was expected."""
        account, cost = self.accounts[job.setting.name], expected_cost(job)
        account.jobs[State.TO_DO] -= 1
        account.to_come -= cost
        self._take(job, answer, State.SOLVED)
        self.spent += cost * account.ratio

    def _take(self, job: Job, answer: Result | Failure, state: State) -> None:
        account = self.accounts[job.setting.name]
        if isinstance(answer, Failure):
            account.jobs[State.FAILED] += 1
            self.failures.append((job, answer))
            return
        account.jobs[state] += 1
        account.expected += expected_cost(job)
        account.measured += answer.numerics.cpu_s + STORING_S

    def total(self, *states: State) -> int:
        """The number of jobs in the given states, by default in all states."""
        return sum(account.jobs[state] for account in self.accounts.values() for state in states or State)

    @property
    def cpu_s(self) -> float:
        """The corrected CPU time of the remaining jobs of all settings, s."""
        return sum(account.remaining for account in self.accounts.values())

    def wall_s(self, processes: int) -> float:
        """The shortest possible wall time of the remaining jobs with a number of processes, s."""
        largest = max((a.largest * a.ratio for a in self.accounts.values() if a.jobs[State.TO_DO]), default=0.0)
        return max(self.cpu_s / processes, largest)

    @property
    def done(self) -> float:
        """The done fraction of the CPU time of this run, 0 to 1."""
        whole = self.spent + self.cpu_s
        return self.spent / whole if whole else 1.0

    @property
    def words(self) -> str:
        """The text with the number of jobs that have an answer and of those that failed."""
        failed = f", {len(self.failures)} failed" if self.failures else ""
        return f"{self.total() - self.total(State.TO_DO)} of {self.total()} jobs{failed}"
