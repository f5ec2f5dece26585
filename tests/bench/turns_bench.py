#!/usr/bin/env python3
"""What two users get of a worker, and what a yield costs: python3 tests/bench/turns_bench.py [BIN [SECONDS [TURN]]]"""
import json
import os
import socket
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BIN = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build/release/bin")
SECONDS = float(sys.argv[2]) if len(sys.argv) > 2 else 40
TURN = sys.argv[3] if len(sys.argv) > 3 else "2"
BOOTH = os.path.join(ROOT, "deploy/booth/booth.txtpb")
HEAVY = ["--size", "1920x1280", "--spp", "1024"]
LIGHT = ["--size", "320x200", "--spp", "16"]


def metamer(server, *words):
    answer = subprocess.run([os.path.join(BIN, "metamer"), *words, "--json", "--server", server], check=True,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return json.loads(answer.stdout)


def jobs(server, *words):
    return metamer(server, "jobs", *words)["jobs"]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def yields(server, job):
    """How often it has given way so far: its events, as a watcher of none of its tiles gets them."""
    watch = subprocess.run([os.path.join(BIN, "metamer"), "watch", job, "--json", "--server", server], check=False,
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return watch.stdout.count(b"others have their turn")


def longest_turn(server, job):
    """Seconds, of a job that has ended: from one of its starts to what ended that turn."""
    watch = subprocess.run([os.path.join(BIN, "metamer"), "watch", job, "--json", "--server", server], check=False,
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    longest, began = 0, None
    for event in map(json.loads, watch.stdout.splitlines()):
        if "started" in event:
            began = event["time"]
        elif began is not None and ("queued" in event or "cancelled" in event):
            longest, began = max(longest, event["time"] - began), None
    return longest


def main():
    folder = tempfile.mkdtemp(prefix="metamer-turns-")
    unix, tcp = f"unix:{folder}/socket", f"127.0.0.1:{free_port()}"
    # What jobs took is summed in the end, so that all of them have to stay listed.
    words = ["--listen", unix, "--listen", tcp, "--unconfined", "--log-level", "off", "--turn", TURN,
             "--ended-jobs", "100000"]
    if "--open" in subprocess.run([os.path.join(BIN, "metamerd"), "--help"], check=True, stdout=subprocess.PIPE,
                                  text=True).stdout:
        words.append("--open")
    daemon = subprocess.Popen([os.path.join(BIN, "metamerd"), *words])
    try:
        while not os.path.exists(f"{folder}/socket"):
            time.sleep(0.05)
        # One user has a job that never ends, the other many short ones: as many as fit in, at any time.
        heavy = str(metamer(unix, "submit", BOOTH, *HEAVY)["job_id"])
        end, short = time.monotonic() + SECONDS, 0
        while time.monotonic() < end:
            waiting = [one for one in jobs(tcp) if one["state"] in ("queued", "running") and str(one["job_id"]) != heavy]
            for _ in range(4 - len(waiting)):
                metamer(tcp, "submit", BOOTH, *LIGHT)
                short += 1
            time.sleep(0.05)
        listed = {str(one["job_id"]): one for one in jobs(unix) + jobs(tcp)}
        greedy = listed[heavy]["worker_seconds"]
        modest = sum(one["worker_seconds"] for job, one in listed.items() if job != heavy)
        metamer(unix, "cancel", heavy)
        longest = longest_turn(unix, heavy)
        print(f"one job without an end: {greedy:.2f} s of the worker; {short} of {modest / max(1, short):.2f} s: {modest:.2f} s; "
              f"ratio {greedy / modest:.3f}")
        # A window of few turns says nothing of the shares: on a loaded machine a turn is long.
        print(f"they differ by {abs(greedy - modest):.2f} s; the longest turn took {longest:.2f} s, of {greedy + modest:.2f} s in all")
        for one in jobs(tcp):
            if one["state"] in ("queued", "running"):
                subprocess.run([os.path.join(BIN, "metamer"), "cancel", str(one["job_id"]), "--server", tcp], check=False,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        # The same picture at once, and in turns with another that never ends.
        spent = []
        for beside in (False, True):
            rival = str(metamer(tcp, "submit", BOOTH, *HEAVY)["job_id"]) if beside else None
            job = str(metamer(unix, "submit", BOOTH, "--spp", "64")["job_id"])
            given_way = yields(unix, job)
            spent.append((next(one for one in jobs(unix) if str(one["job_id"]) == job)["worker_seconds"], given_way))
            if rival:
                metamer(tcp, "cancel", rival)
        (alone, _), (turns, times) = spent
        print(f"a picture of {alone:.2f} s of the worker took {turns:.2f} s with {times} yields: "
              f"{1000 * (turns - alone) / max(1, times):.0f} ms each; ratio {turns / alone:.3f}")
    finally:
        daemon.terminate()
        daemon.wait()


main()
