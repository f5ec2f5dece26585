"""The way to a server, and whether it may be told anything."""
import asyncio
import hashlib
import ipaddress
import socket
import ssl

from metamer.address import Address
from metamer.credentials import Credentials
from metamer.errors import InputError, NoServer
from metamer.server_owner import check_server_owner, peer_user

Streams = tuple[asyncio.StreamReader, asyncio.StreamWriter]

CONNECT_SECONDS = 10.0


def _tls_context(credentials: Credentials) -> ssl.SSLContext:
    """TLS 1.3 and nothing older. With a fingerprint the certificate itself is compared, once it is there."""
    try:
        context = ssl.create_default_context(cafile=credentials.authorities or None)
        context.minimum_version = ssl.TLSVersion.TLSv1_3
        if credentials.fingerprint:
            context.check_hostname = False
            context.verify_mode = ssl.CERT_NONE
        if credentials.certificate:
            context.load_cert_chain(credentials.certificate, credentials.key or None)
    except (OSError, ssl.SSLError) as error:
        raise InputError(f"can't use the credentials: {error}") from error
    return context


def _check_fingerprint(writer: asyncio.StreamWriter, address: Address, wanted: str) -> None:
    certificate = writer.get_extra_info("ssl_object").getpeercert(binary_form=True)
    found = hashlib.sha256(certificate).hexdigest()
    if found != wanted.lower():
        raise NoServer(f"can't trust {address}: its certificate's fingerprint is {found}, not {wanted}")


async def reach(address: Address, credentials: Credentials) -> Streams:
    """Connects, within CONNECT_SECONDS. Raises NoServer: nobody is there, or somebody who is not to be trusted;
    InputError: a token that others could read on its way."""
    try:
        async with asyncio.timeout(CONNECT_SECONDS):
            reader, writer = await _open(address, credentials)
    except TimeoutError as error:
        raise NoServer(f"can't connect to {address}: no connection within {CONNECT_SECONDS:g} s") from error
    except ssl.SSLError as error:
        raise NoServer(f"can't trust {address}: {error}; see `metamer login`") from error
    except OSError as error:
        raise NoServer(f"can't connect to {address}: {error.strerror or error}") from error
    try:
        _check_peer(writer, address, credentials)
    except BaseException:
        writer.transport.abort()
        raise
    return reader, writer


async def _open(address: Address, credentials: Credentials) -> Streams:
    if address.path:
        return await asyncio.open_unix_connection(address.path)
    if not address.tls:
        return await asyncio.open_connection(address.host, address.port)
    return await asyncio.open_connection(address.host, address.port, ssl=_tls_context(credentials))


def _check_peer(writer: asyncio.StreamWriter, address: Address, credentials: Credentials) -> None:
    if address.path:
        check_server_owner(peer_user(writer.get_extra_info("socket")), address.path)
        return
    writer.get_extra_info("socket").setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    if address.tls:
        if credentials.fingerprint:
            _check_fingerprint(writer, address, credentials.fingerprint)
    elif credentials.token and not ipaddress.ip_address(writer.get_extra_info("peername")[0]).is_loopback:
        raise InputError(f"your token for {address} would be sent where others can read it: use tls:{address}")
