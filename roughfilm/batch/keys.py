"""Keys for TLS between the sender, the scheduler and the workers of a dask cluster."""

import os
import shlex
from pathlib import Path
from typing import TYPE_CHECKING

from roughfilm.contact.foundation.errors import InputError, UnavailableError, unwritable

if TYPE_CHECKING:
    from distributed import Security

AUTHORITY, CERTIFICATE, KEY = "ca.pem", "cert.pem", "key.pem"
"""Files of a directory of keys: the authority that is trusted, and the certificate with its private key."""


def write_keys(directory: Path) -> None:
    """Write a new private key that only its owner may read, its certificate, and the authority that signed it.

    The sender, the scheduler and all workers use the same files. The certificate is valid for a year.

    Raises
    ------
    InputError
        If the directory holds such files already, or cannot be written.
    UnavailableError
        If distributed or cryptography are not installed.
    """
    try:
        from distributed import Security

        made = Security.temporary()
    except ImportError:
        message = "keys: need the libraries distributed and cryptography; install them with: pip install"
        raise UnavailableError(f"{message} 'roughfilm[cluster]'") from None
    texts = {KEY: made.tls_client_key, CERTIFICATE: made.tls_client_cert, AUTHORITY: made.tls_ca_file}
    begun: list[Path] = []
    try:
        directory.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            mode = 0o600 if name == KEY else 0o644
            with os.fdopen(os.open(directory / name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, mode), "w") as file:
                begun.append(directory / name)
                file.write(text)
    except FileExistsError as error:
        for path in begun:
            path.unlink()
        raise InputError(f"{error.filename}: keys exist; delete them or name another directory") from error
    except OSError as error:
        for path in begun:
            path.unlink()
        raise unwritable(error.filename or directory, error) from error


def key_options(directory: Path) -> str:
    """The options with which ``dask scheduler`` and ``dask worker`` take the keys of a directory."""
    places = {"ca-file": AUTHORITY, "cert": CERTIFICATE, "key": KEY}
    return "".join(f" --tls-{name} {shlex.quote(str(directory / file))}" for name, file in places.items()).strip()


def security_of(address: str, tls: Path | None) -> "Security":
    """The settings with which a scheduler is reached: those of a directory of keys, or of dask's configuration.

    Raises
    ------
    InputError
        If the directory lacks a file, the address is one without TLS, or there are no keys for one with TLS.
    """
    from distributed import Security

    if tls is not None:
        if not address.startswith("tls://"):
            raise InputError(f"tls: is for a scheduler at tls://HOST:PORT, got {address}; leave it out or start such")
        if missing := [name for name in (AUTHORITY, CERTIFICATE, KEY) if not (tls / name).is_file()]:
            raise InputError(f"tls {tls}: has no {missing[0]}; write the keys with: roughfilm cluster keys {tls}")
        return Security(
            tls_ca_file=str(tls / AUTHORITY),
            tls_client_cert=str(tls / CERTIFICATE),
            tls_client_key=str(tls / KEY),
            require_encryption=True,
        )
    security = Security()
    if address.startswith("tls://") and security.tls_client_cert is None:
        raise InputError(f"tls: missing for {address}; give the keys that 'roughfilm cluster keys DIR' wrote")
    return security
