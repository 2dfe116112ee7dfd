"""Where the jobs of a batch stand, and what those to come will cost."""

from collections import defaultdict
from dataclasses import dataclass, field
from enum import StrEnum

from roughfilm.batch.execute import STORING_S, expected_cost
from roughfilm.batch.jobs import Failure, Job
from roughfilm.rom.ladder.result import Result


class State(StrEnum):
    """Where a job stands: ``FINISHED`` by an earlier run, ``SOLVED`` by this one."""

    FINISHED = "finished"
    SOLVED = "solved"
    FAILED = "failed"
    LEFT_OUT = "left out"
    TO_DO = "to do"


@dataclass(kw_only=True)
class Account:
    """The jobs of one setting by state, and their CPU seconds: ``expected`` of those that are ``measured``."""

    jobs: dict[State, int] = field(default_factory=lambda: dict.fromkeys(State, 0))
    to_come: float = 0.0
    dearest: float = 0.0
    expected: float = 0.0
    measured: float = 0.0

    @property
    def ratio(self) -> float:
        """How many times as dear the jobs were as expected, which corrects those to come."""
        return self.measured / self.expected if self.expected else 1.0

    @property
    def remaining(self) -> float:
        """CPU seconds still to come."""
        return self.to_come * self.ratio if self.jobs[State.TO_DO] else 0.0


@dataclass(kw_only=True)
class BatchProgress:
    """Accounts by setting; the jobs that failed, with the reason; how many results carry a warning."""

    accounts: dict[str, Account] = field(default_factory=lambda: defaultdict(Account))
    failures: list[tuple[Job, Failure]] = field(default_factory=list)
    warned: int = 0
    spent: float = 0.0

    def expect(self, job: Job) -> None:
        """Count a job that is to be solved."""
        account, cost = self.accounts[job.setting.name], expected_cost(job)
        account.jobs[State.TO_DO] += 1
        account.to_come += cost
        account.dearest = max(account.dearest, cost)

    def leave_out(self, job: Job) -> None:
        """Count a job whose model does not apply to its scene."""
        self.accounts[job.setting.name].jobs[State.LEFT_OUT] += 1

    def find(self, job: Job, answer: Result | Failure) -> None:
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
        self.warned += bool(answer.warnings)

    def total(self, *states: State) -> int:
        """Jobs in these states; in any, if none is named."""
        return sum(account.jobs[state] for account in self.accounts.values() for state in states or State)

    @property
    def cpu_s(self) -> float:
        """CPU seconds still to come."""
        return sum(account.remaining for account in self.accounts.values())

    def wall_s(self, processes: int) -> float:
        """The least seconds that the jobs to come take in so many processes."""
        dearest = max((a.dearest * a.ratio for a in self.accounts.values() if a.jobs[State.TO_DO]), default=0.0)
        return max(self.cpu_s / processes, dearest)

    @property
    def done(self) -> float:
        """The part of this run's CPU time that is spent, 0 to 1."""
        whole = self.spent + self.cpu_s
        return self.spent / whole if whole else 1.0

    @property
    def words(self) -> str:
        """How many of the jobs have an answer, and how many of these failed."""
        failed = f", {len(self.failures)} failed" if self.failures else ""
        return f"{self.total() - self.total(State.TO_DO)} of {self.total()} jobs{failed}"
