"""What `metamer login` keeps of each server: who the user is there, and how the server is known."""
import os
import pathlib
import tomllib
from dataclasses import dataclass

from metamer.errors import InputError


@dataclass(frozen=True)
class Credentials:
    token: str = ""
    authorities: str = ""  # a PEM file in place of the system's authorities
    fingerprint: str = ""  # SHA-256 of the server's certificate, 64 hexadecimal digits
    certificate: str = ""  # of the client, and its key: PEM files
    key: str = ""

    def __repr__(self) -> str:
        return f"Credentials(token={'set' if self.token else 'none'})"  # a token is for no log


def credentials_file() -> pathlib.Path:
    """servers.toml in $XDG_CONFIG_HOME/metamer, else in ~/.config/metamer."""
    config = os.environ.get("XDG_CONFIG_HOME")
    return (pathlib.Path(config) if config else pathlib.Path.home() / ".config") / "metamer" / "servers.toml"


def kept_credentials(server: str) -> Credentials:
    """Those of a server, by its address as str(Address) writes it; empty ones where none are kept. InputError: a file
    that others may read, since tokens stand in it, or that is no TOML."""
    file = credentials_file()
    try:
        with open(file, "rb") as stream:
            if os.fstat(stream.fileno()).st_mode & 0o077:
                raise InputError(f"{file}: others may read the tokens in it; chmod 600 it")
            servers = tomllib.load(stream)
    except (FileNotFoundError, NotADirectoryError):
        return Credentials()
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{file}: {error}") from error
    kept = servers.get(server)
    if not isinstance(kept, dict):
        return Credentials()

    def text(key: str) -> str:
        value = kept.get(key)
        return value if isinstance(value, str) else ""

    return Credentials(text("token"), text("ca"), text("fingerprint"), text("certificate"), text("key"))
