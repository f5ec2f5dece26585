#!/usr/bin/env python3
"""How long a view waits for its frames beside the heaviest batch job: python3 tests/bench/frame_wait_bench.py [BIN [FRAMES]]"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BIN = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build/release/bin")
FRAMES = int(sys.argv[2]) if len(sys.argv) > 2 else 300
BOOTH = os.path.join(ROOT, "deploy/booth/booth.txtpb")


def metamer(server, *words):
    answer = subprocess.run([os.path.join(BIN, "metamer"), *words, "--json", "--server", server], check=True,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return json.loads(answer.stdout)


def view(server, name):
    """Prints how long frames took of a view whose camera moves all the time."""
    seen = metamer(server, "view", BOOTH, "--record", str(FRAMES), "--size", "320x240")
    apart, first = seen["apart"], seen["first"]["median"]
    print(f"{name}: {1000 * apart['median']:.1f} ms between frames, 95 % within {1000 * apart['percentile_95']:.1f} ms, "
          f"the longest {1000 * apart['longest']:.1f} ms; the first after {1000 * first:.1f} ms")
    return apart


def memory(pid):
    """MiB that a process has to itself, and of what it shares its part."""
    with open(f"/proc/{pid}/smaps_rollup") as rollup:
        return int(re.search(r"^Pss:\s+(\d+)", rollup.read(), re.MULTILINE).group(1)) / 1024


def workers(server):
    return metamer(server, "info")["info"]["worker"]


def main():
    folder = tempfile.mkdtemp(prefix="metamer-frames-")
    server = f"unix:{folder}/socket"
    daemon = subprocess.Popen([os.path.join(BIN, "metamerd"), "--listen", server, "--unconfined", "--log-level", "off"])
    try:
        while not os.path.exists(f"{folder}/socket"):
            time.sleep(0.05)
        alone = view(server, "alone")
        for worker in workers(server):
            if worker["pid"]:
                print(f"  {worker['backend']} worker, idle: {memory(worker['pid']):.1f} MiB")
        heavy = metamer(server, "submit", BOOTH, "--size", "2048x2048", "--spp", "1024", "--tile-size", "256",
                        "--depth", "8")
        job = str(heavy["job_id"])
        while next(one for one in metamer(server, "jobs")["jobs"] if str(one["job_id"]) == job)["tiles"] == 0:
            time.sleep(0.1)
        beside = view(server, "beside a job of 1024 samples in tiles of 256")
        print(f"longest wait beside the job / alone: {beside['longest'] / alone['longest']:.2f}; "
              f"median: {beside['median'] / alone['median']:.2f}")
        metamer(server, "cancel", job)
    finally:
        daemon.terminate()
        daemon.wait()


main()
