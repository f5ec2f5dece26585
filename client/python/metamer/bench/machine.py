"""The machine that a record is of."""
import hashlib
import os
import pathlib
import platform

import google.protobuf
import numpy as np

from metamer.v1 import plan_pb2, session_pb2

_TICKS = os.sysconf("SC_CLK_TCK")


def describe(info: session_pb2.Info, record: plan_pb2.RunRecord | None = None) -> dict[str, object]:
    """What a time depends on: by the `record` of a job, which knows the machine that rendered it. `build`: SHA-256 of the
    workers' program, where it runs on this machine and we may look. What is not known is empty."""
    gl = info.capabilities.gl
    machines = record.machine if record else []
    return {"cpu": _joined(machine.cpu for machine in machines), "host": _joined(machine.name for machine in machines),
            "isa": _joined(machine.isa for machine in machines), "cores": os.cpu_count(),
            "gpu": f"{gl.renderer}, {gl.version}" if gl.renderer else "", "threads": info.capabilities.threads,
            "system": platform.platform(), "server": info.server, "commit": record.build if record else "",
            "build": _build(info), "python": platform.python_version(), "numpy": np.__version__,
            "protobuf": google.protobuf.__version__}


def _joined(names) -> str:
    return ", ".join(sorted({name for name in names if name}))


def _build(info: session_pb2.Info) -> str:
    for worker in info.worker:
        try:
            with open(f"/proc/{worker.pid}/exe", "rb") as program:
                return hashlib.file_digest(program, "sha256").hexdigest()
        except OSError:
            continue
    return ""


def cpu_seconds(info: session_pb2.Info) -> dict[int, float]:
    """What each worker on this machine has used so far, with its children that have ended; by process id (proc(5))."""
    used = {}
    for worker in info.worker:
        try:
            words = pathlib.Path(f"/proc/{worker.pid}/stat").read_text().rpartition(")")[2].split()
            used[worker.pid] = sum(map(int, words[11:15])) / _TICKS
        except OSError:
            continue
    return used
