"""What a job is known by: its number, and the server that gave it, "7@3f9c2a1b" (as client/session/job_handle.h)."""
import re

from metamer.errors import InputError

Job = int | str  # a number, or a handle
_HANDLE = re.compile(r"([1-9][0-9]{0,19})(?:@([0-9a-fA-F]{6,32}))?", re.ASCII)
_DIGITS = 8  # that are written


def job_handle(number: int, server_id: bytes) -> str:
    """To be pasted; a number alone of a server that keeps no jobs."""
    return f"{number}@{server_id.hex()[:_DIGITS]}" if server_id else str(number)


def job_number(job: Job, server_id: bytes) -> int:
    """InputError: it is no handle, or one of another server, whose number would find another job here."""
    if isinstance(job, int):
        return job
    read = _HANDLE.fullmatch(job)
    if read is None:
        raise InputError(f'"{job}" is no job: one is named by its handle, such as 7@3f9c2a1b, or by its number alone')
    number, server = read.groups()
    here = server_id.hex()
    if server and not here.startswith(server.lower()):
        ours = f"this one's end in @{here[:_DIGITS]}" if here else "this one's jobs have a number alone"
        raise InputError(f"job {job} is of another server: {ours}")
    return int(number)
