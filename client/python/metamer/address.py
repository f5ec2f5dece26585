"""Where a server listens: unix:PATH, HOST:PORT, [IPV6]:PORT, PORT, or tls: before one of the last three."""
from dataclasses import dataclass

from metamer.errors import InputError

_EXPECTED = "expected unix:PATH, HOST:PORT, PORT or tls:HOST:PORT"
_LONGEST_PATH = 107  # bytes: the kernel's bound


@dataclass(frozen=True)
class Address:
    path: str = ""  # of a Unix socket; empty: TCP
    host: str = ""
    port: int = 0
    tls: bool = False

    def __str__(self) -> str:
        """As parse_address reads it, and as `metamer login` keeps it."""
        if self.path:
            return f"unix:{self.path}"
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{'tls:' if self.tls else ''}{host}:{self.port}"


def parse_address(text: str) -> Address:
    """Raises InputError, which says what was expected."""
    if text.startswith("unix:"):
        path = text[5:]
        if not 0 < len(path.encode()) <= _LONGEST_PATH:
            raise InputError(f'"{text}": the path of a socket has 1 to {_LONGEST_PATH} bytes')
        return Address(path=path)
    tls = text.startswith("tls:")
    host, colon, port = (text[4:] if tls else text).rpartition(":")
    if not colon:
        host = "127.0.0.1"
    elif host.startswith("[") and host.endswith("]"):
        host = host[1:-1]
    elif ":" in host:
        raise InputError(f'"{text}": an IPv6 address needs brackets, as in [::1]:7777')
    if not host or not (port.isascii() and port.isdigit()):
        raise InputError(f'"{text}": {_EXPECTED}')
    if int(port) > 65535:
        raise InputError(f'"{text}": a port is at most 65535')
    return Address(host=host, port=int(port), tls=tls)
