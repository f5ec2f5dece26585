"""Whether who listens at a Unix socket may: in /tmp, say, anybody may have made the path first."""
import os
import pathlib
import socket
import stat
import struct

from metamer.errors import NoServer


def peer_user(unix: socket.socket) -> int:
    """The user id of who listens at a connected Unix socket, by the system's word (SO_PEERCRED)."""
    credentials = unix.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, struct.calcsize("3i"))
    return struct.unpack("3i", credentials)[1]


def check_server_owner(user: int, path: str) -> None:
    """Raises NoServer unless `user` is we ourselves, root, or one to whom these have given a folder above `path` (or
    the socket's file) where nobody else could put one."""
    trusted = {os.geteuid(), 0}
    if user in trusted:
        return
    stranger = NoServer(f"uid {user} listens at {path}, where neither root nor you have let that user; nothing was sent")
    try:
        folder = pathlib.Path(path).absolute().parent.resolve(strict=True)
        # From the root down: as long as only the trusted can make entries, their owners are as wanted.
        at = folder / pathlib.Path(path).name
        for entry in [*reversed(at.parents), at]:
            status = os.lstat(entry)
            if status.st_uid == user:
                return
            if status.st_uid not in trusted or status.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
                raise stranger
    except OSError as error:
        raise stranger from error
    raise stranger
