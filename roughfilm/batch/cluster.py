"""The workers of a dask cluster: what they can run, jobs for them, and an end of the batch where all are gone."""

import logging
import platform
import ssl
import time
import warnings
from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from ipaddress import ip_address
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughfilm.batch.execute import GONE
from roughfilm.batch.keys import key_options, security_of
from roughfilm.contact.foundation.errors import UnavailableError
from roughfilm.ladder import models
from roughfilm.rom.ladder.model import Availability, Model
from roughfilm.rom.ladder.provenance import code, versions
from roughfilm.terminal.console import duration, messages, print_message

if TYPE_CHECKING:
    from distributed import Client, Security

SCHEDULER_TIMEOUT_S = 5

POLL_S = 0.2
"""Time between two looks for the first worker, s."""

REFRESH_S = 5.0
"""Time for which an answer on the workers is used again, s."""

ENCRYPTED = ("tls", "wss", "inproc")
"""Protocols of dask that others cannot read or use."""


@dataclass(frozen=True, kw_only=True)
class Offer:
    """What a worker can run: its ``host``, its ``code`` with the libraries, and its ``models`` by name."""

    host: str
    code: tuple[str, Mapping[str, str]]
    models: Mapping[str, Availability]


def offer(kind: str) -> Offer:
    """The models for a kind of scene that this process can run."""
    available = {model.name: model.available() for model in models(kind)}
    return Offer(host=platform.node(), code=(code(), versions()), models=available)


@dataclass(kw_only=True)
class Cluster:
    """The workers of a scheduler, which may come and go.

    Attributes
    ----------
    address : address of the scheduler.
    client : the connection to it.
    wait : time without workers after which the batch ends, s.
    tls : directory with the keys that the batch was given; None without one.
    lacking : for each model that was asked for and that no worker can run, the reason, by name.
    """

    address: str
    client: "Client"
    wait: float
    tls: Path | None = None
    lacking: dict[str, str] = field(default_factory=dict)
    _kind: str = ""
    _offers: dict[str, Offer] = field(default_factory=dict)
    _asked: float = 0.0
    _deserted_since: float | None = None

    def models(self, kind: str | None) -> tuple[Model, ...]:
        """The models of a kind, each available where a worker can run it; workers are asked when a study needs one."""
        return tuple(replace(one, available=partial(self._availability, one.kind, one.name)) for one in models(kind))

    def count(self) -> int:
        """The number of workers, each of which runs one job at a time."""
        return len(self._workers() or {})

    def executor(self, needs: str | None = None) -> Executor:
        """The executor of all workers, or of those that can run models with the availability ``needs``, in words."""
        able = [] if needs is None else self._able(needs)
        options = {"workers": able, "allow_other_workers": True} if able else {}
        executor: Executor = self.client.get_executor(pure=False, **options)
        return executor

    def watch(self) -> None:
        """Say once that there are no workers.

        Raises UnavailableError if none comes in the time ``wait``, or if the connection to the scheduler is lost, with
        which all jobs are lost that were sent.
        """
        if self.client.status != "running":
            raise UnavailableError(GONE)
        workers = self._workers()
        if workers:
            self._deserted_since = None
            return
        answers = workers is not None
        limit = f"{duration(self.wait)} (--wait)"
        if self._deserted_since is None:
            self._deserted_since = time.monotonic()
            state = "has no workers" if answers else "does not answer"
            messages.print(f"{self.address} {state}; waiting for {limit}", markup=False, soft_wrap=True)
        if time.monotonic() - self._deserted_since >= self.wait:
            state = "has had no workers" if answers else "has not answered"
            keys = "" if self.tls is None else f" {key_options(self.tls)}"
            remedy = f"start some with: dask worker {self.address} --nthreads 1{keys}"
            raise UnavailableError(
                f"scheduler: {self.address} {state} for {limit}; {remedy}. Results are kept; the same command continues"
            )

    def _workers(self) -> Mapping[str, Any] | None:
        """The workers by address; None if the scheduler does not answer."""
        identity = self.client.scheduler.identity
        try:
            seen: Mapping[str, Any] = self.client.sync(identity, callback_timeout=SCHEDULER_TIMEOUT_S)["workers"]
        except Exception:  # any error of a connection that ends
            return None
        return seen

    def _availability(self, kind: str, name: str) -> Availability:
        """The availability of a model: the programs that most workers have, or the reason why none can run it."""
        if self._kind != kind:
            self._kind = kind
            self._offers = self._first_offers()
        answers = [one.models[name] for one in self._offers.values()]
        found = Counter(one.detail for one in answers if one.available)
        if found:
            return Availability(available=True, detail=found.most_common(1)[0][0])
        self.lacking[name] = f"no worker can run it ({answers[0].detail})"
        return Availability(available=False, detail=self.lacking[name])

    def _first_offers(self) -> dict[str, Offer]:
        """The offers of the workers that have the code of this process, after the first worker has come.

        Raises UnavailableError if none comes, or none has this code.
        """
        while not self._workers():
            self.watch()
            time.sleep(POLL_S)
        if any(worker["nthreads"] > 1 for worker in (self._workers() or {}).values()):
            print_message(
                "warning", "a worker runs one job at a time, whatever its threads; start workers with --nthreads 1"
            )
        answers = self._ask()
        if offers := _with_this_code(answers):
            return offers
        reasons = [
            f"{one.host} has other code or libraries than the sender" if isinstance(one, Offer) else f"{at}: {one}"
            for at, one in answers.items()
        ]
        reason = " ".join(reasons[0].split()) if reasons else "they left"
        raise UnavailableError(f"workers: none can run a job ({reason}); install on them what is installed here")

    def _able(self, needs: str) -> list[str]:
        """The addresses of the workers that can run models with an availability."""
        if time.monotonic() - self._asked > REFRESH_S:
            self._offers = _with_this_code(self._ask())
        has = Availability(available=True, detail=needs)
        return [address for address, one in self._offers.items() if has in one.models.values()]

    def _ask(self) -> Mapping[str, Any]:
        """The offers of all workers by address; an error in place of that of a worker that cannot answer."""
        self._asked = time.monotonic()
        answers: Mapping[str, Any] = self.client.run(offer, self._kind, on_error="return")
        return answers


def _with_this_code(answers: Mapping[str, Any]) -> dict[str, Offer]:
    own = (code(), versions())
    return {at: one for at, one in answers.items() if isinstance(one, Offer) and one.code == own}


@contextmanager
def dask(address: str, *, wait: float, tls: Path | None = None) -> Iterator[Cluster]:
    """Yield the workers of a running dask cluster that have roughfilm.

    Parameters
    ----------
    address : address of the scheduler, such as "tls://host:8786".
    wait : time without workers after which a batch ends, s.
    tls : directory with keys for TLS, as ``roughfilm cluster keys`` writes; None for those of dask's configuration.

    Raises
    ------
    InputError
        If ``tls`` has not the keys, or the address is one without TLS.
    UnavailableError
        If dask is not installed or the scheduler does not answer.
    """
    import asyncio  # slow to import, with ssl

    try:
        import distributed
    except ImportError:
        message = "executor dask: needs the library distributed; install it with: pip install 'roughfilm[cluster]'"
        raise UnavailableError(message) from None
    security, before = security_of(address, tls), logging.root.manager.disable
    logging.disable()  # dask and tornado would print many lines in addition to the error
    try:
        try:
            seen = asyncio.run(asyncio.wait_for(_greet(address, security), SCHEDULER_TIMEOUT_S))
            with warnings.catch_warnings(action="ignore"):  # on versions of libraries, which the offers compare
                client = distributed.Client(address, security=security, set_as_default=False)
        except Exception as error:  # another program at this address may send anything
            reason = " ".join(str(error).split()) or f"silent for {SCHEDULER_TIMEOUT_S} s"
            if refuses(error):
                remedy = "give it the keys it was started with (--tls DIR)"
                raise UnavailableError(
                    f"scheduler {address}: a scheduler answers but refuses these keys; {remedy}"
                ) from None
            remedy = "start one with: dask scheduler --host 127.0.0.1"
            if address.startswith("tcp://"):
                remedy += "; one that was started with keys is at tls://HOST:PORT"
            message = f"scheduler {address}: no dask scheduler answers there ({reason}); {remedy}"
            raise UnavailableError(message) from None
        if open_to_all := next(filter(is_open, (seen["address"], *seen["workers"])), None):
            print_message(
                "warning",
                f"whoever reaches {open_to_all} can run programs there; use TLS, see: roughfilm cluster --help",
            )
        with client:
            yield Cluster(address=address, client=client, wait=wait, tls=tls)
    finally:
        logging.disable(before)


async def _greet(address: str, security: "Security") -> Mapping[str, Any]:
    """The identity of a scheduler; ValueError if another server of dask answers."""
    from distributed import rpc

    async with rpc(address, connection_args=security.get_connection_args("client")) as server:
        identity: Mapping[str, Any] = await server.identity()
    if identity["type"] != "Scheduler":
        raise ValueError(f"it is a {identity['type']}")
    return identity


def refuses(error: BaseException | None) -> bool:
    """Whether an error of a connection, or one that caused it, is that of certificates that do not fit."""
    while error is not None:
        if isinstance(error, ssl.SSLCertVerificationError) or "CERTIFICATE_VERIFY_FAILED" in str(error):
            return True
        error = error.__cause__ or error.__context__
    return False


def is_open(address: str) -> bool:
    """Whether an address of dask is not encrypted and may be reached from other machines."""
    from distributed.comm import get_address_host, parse_address

    if parse_address(address)[0] in ENCRYPTED:
        return False
    host = get_address_host(address)
    try:
        return not ip_address(host).is_loopback
    except ValueError:  # a name
        return bool(host != "localhost")
