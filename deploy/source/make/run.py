"""Calls `metamer`, against a metamerd of our own, and takes times in rounds."""

from contextlib import contextmanager
from pathlib import Path
import json
import os
import socket
import subprocess
import tempfile

ROOT = Path(__file__).resolve().parents[3]
BIN = Path(os.environ.get("METAMER_BIN", ROOT / "build/release/bin"))
OUT = ROOT / "build/source"
PICTURES = ROOT / "deploy/source/pictures"


@contextmanager
def server():
    """A metamerd that ends with us: it reads the end of a socket pair. METAMER_SERVER leads to it."""
    ours, theirs = socket.socketpair()
    with ours, tempfile.TemporaryDirectory(prefix="metamer-") as folder:
        address = f"unix:{folder}/socket"
        with theirs:
            daemon = subprocess.Popen([BIN / "metamerd", "--listen", address, "--parent-fd", str(theirs.fileno()),
                                       "--log-level", "warn", "--unconfined"], pass_fds=[theirs.fileno()])
        if not ours.recv(16).startswith(b"ready"):
            raise SystemExit("metamerd did not start")
        os.environ["METAMER_SERVER"] = address
        try:
            yield
        finally:
            del os.environ["METAMER_SERVER"]
            ours.close()
            daemon.wait()


def metamer(*words):
    """Runs it with --json and gives what it says."""
    done = subprocess.run([BIN / "metamer", *map(str, words), "--json"], stdout=subprocess.PIPE, text=True,
                          stderr=subprocess.PIPE)
    if done.returncode != 0:
        raise SystemExit(f"metamer {' '.join(map(str, words))}: exit code {done.returncode}\n{done.stderr}{done.stdout}")
    return json.loads(done.stdout)


def render(scene, output, *words):
    return metamer("render", scene, "-o", output, *words)


def cpu_seconds(said, phase):
    """Of all threads of the worker in this phase of the job, as its record has it: other work of the machine is not in it."""
    return next(part["cpu_seconds"] for part in said["record"]["phase"] if part["name"] == phase)


class Times:
    """The least CPU seconds of some rounds. Cases take turns, so that what else a machine does disturbs all alike."""

    def __init__(self, cases, rounds, phase="render"):
        """cases: name → (scene, options). Each is rendered once before it counts: drivers compile, files arrive."""
        self.seconds = {name: float("inf") for name in cases}
        for turn in range(rounds + 1):
            for name, (scene, words) in cases.items():
                said = render(scene, OUT / "timed.png", *words)
                if turn > 0:
                    self.seconds[name] = min(self.seconds[name], cpu_seconds(said, phase))

    def ratio(self, name, base):
        return self.seconds[name] / self.seconds[base]
