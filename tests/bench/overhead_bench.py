#!/usr/bin/env python3
"""What whole commands cost beyond their work: python3 tests/bench/overhead_bench.py [BIN] [TURNS]"""
import glob
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
import zlib

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BIN = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build/release/bin")
TURNS = int(sys.argv[2]) if len(sys.argv) > 2 else 5
BOOTH = os.path.join(ROOT, "deploy/booth/booth.txtpb")
LIGHTS = ["A", "C", "D50", "D55", "D65", "F3", "E", "F1", "F2", "F7", "F11", "F12"]


def children_cpu():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(words):
    """Seconds of a command with all that it starts: of CPUs, and by the clock."""
    before, start = children_cpu(), time.perf_counter()
    subprocess.run([os.path.join(BIN, "metamer"), *words], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    return children_cpu() - before, time.perf_counter() - start


def worker_cpu(parent):
    """CPU seconds of the worker below a process so far; 0: there is none."""
    below = {parent}
    for status in sorted(glob.glob("/proc/[0-9]*/stat"), key=lambda path: int(path.split("/")[2])):
        try:
            with open(status) as file:
                name, _, rest = file.read().partition(") ")
            pid, _, name = name.partition(" (")
            fields = rest.split()
            if int(fields[1]) not in below:
                continue
            below.add(int(pid))
            if name == "metamer-worker":
                return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        except (OSError, ValueError, IndexError):
            continue  # it has ended
    return 0.0


def render(folder, words):
    """CPU seconds of a whole render; seconds of work that its worker reports; CPU seconds of the worker."""
    before, worker = children_cpu(), 0.0
    with open(os.path.join(folder, "answer"), "w+") as answer:
        process = subprocess.Popen([os.path.join(BIN, "metamer"), "render", *words, "--json"],
                                   stdout=answer, stderr=subprocess.DEVNULL)
        while process.poll() is None:
            worker = max(worker, worker_cpu(process.pid))
            time.sleep(0.005)
        answer.seek(0)
        reported = json.load(answer)["timing"]["total"]
    return children_cpu() - before, reported, worker


def show(what, seconds, base, name, unit="CPU s"):
    print(f"{what}: {seconds:.3f} {unit}, {name} {base:.3f}: {seconds - base:.3f} beyond, ratio {seconds / base:.2f}")


def deflating(pictures):
    """CPU seconds of nothing but deflating the rows of these PNGs again, by zlib at level 1."""
    rows = []
    for picture in pictures:
        with open(picture, "rb") as file:
            data, at, deflated = file.read(), 8, b""
        while at < len(data):
            size = int.from_bytes(data[at:at + 4], "big")
            if data[at + 4:at + 8] == b"IDAT":
                deflated += data[at + 8:at + 8 + size]
            at += size + 12
        rows.append(zlib.decompress(deflated))
    before = time.process_time()
    for one in rows:
        zlib.compress(one, 1)
    return time.process_time() - before


def show_relit(starts, ones, manys, pictures):
    for i, unit in enumerate(["CPU s", "s by the clock"]):
        single, twelve, start = (statistics.median(turn[i] for turn in turns) for turns in (ones, manys, starts))
        show("relight, 1 light", single, start, "metamer --version", unit)
        show("relight, 12 lights in one run", twelve, single, "1 light", unit)
        each = (twelve - single) / (len(LIGHTS) - 1)
        show("relight, 1 light", single, each, "one more light in the same run", unit)
    print(f"deflating the rows of the 12 PNGs by zlib at level 1, and nothing else: {deflating(pictures):.3f} CPU s")


def main():
    with tempfile.TemporaryDirectory() as folder:
        picture, factors = os.path.join(folder, "booth.png"), os.path.join(folder, "booth.factors")
        scene = [BOOTH, "-o", picture, "--size", "640x480", "--threads", "1"]
        run(["render", *scene, "--spp", "4", "--keep-factors", factors])
        one = ["relight", factors, "--light", f"*={LIGHTS[0]}", "-o", os.path.join(folder, "one.png")]
        many = ["relight", factors, "-o", os.path.join(folder, "{light}.png")]
        for light in LIGHTS:
            many += ["--light", f"*={light}"]
        wholes, quick, ones, manys, starts = [], [], [], [], []
        for _ in range(TURNS):
            wholes.append(render(folder, scene))
            quick.append(render(folder, [*scene, "--spp", "1"]))
            starts.append(run(["--version"]))
            ones.append(run(one))
            manys.append(run(many))

        for name, turns in [("render, 16 samples", wholes), ("render, 1 sample", quick)]:
            # Seconds by the clock hold what others had of the core, so a busy machine lowers this.
            cpu, work, _ = max(turns, key=lambda turn: turn[0] - turn[1])
            show(name, cpu, work, "its worker reports")
            cpu, work = (statistics.median(turn[i] for turn in turns) for i in (0, 2))
            show(name, cpu, work, "its worker has had")
        show_relit(starts, ones, manys, [os.path.join(folder, f"{light}.png") for light in LIGHTS])


if __name__ == "__main__":
    main()
