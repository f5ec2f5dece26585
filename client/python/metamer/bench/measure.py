"""Rounds: each has each case on each server once, in an order drawn anew."""
import random
import time
from collections.abc import Callable, Mapping, Sequence

from metamer.bench.cases import Case
from metamer.bench.machine import cpu_seconds
from metamer.blocking import Server
from metamer.errors import JobFailed
from metamer.v1.plan_pb2 import RunRecord

Times = dict[str, list[float]]  # "seconds", "cpu" and "wall", a value each round
MEASURES = ("seconds", "cpu", "wall")


def render_once(server: Server, case: Case, record: Callable[[RunRecord | None], None] = lambda _: None) -> dict[str, float]:
    """`seconds`: of rendering, by the server's clock. `wall`: from the request to the last pixel here. `cpu`: of its
    workers, in steps of 0.01 s; none where they are on another machine. `record` gets the job's. JobFailed."""
    before = cpu_seconds(server.info())
    start = time.perf_counter()
    picture = server.render(case.scene)
    wall = time.perf_counter() - start
    after = cpu_seconds(server.info())
    record(picture.record)
    measured = {"seconds": picture.timing.render, "wall": wall}
    if after:
        measured["cpu"] = sum(used - before.get(pid, 0.0) for pid, used in after.items())
    return measured


def measure(servers: Mapping[str, Server], cases: Sequence[Case], rounds: int, say: Callable[[str], None],
            seed: int | None = None,
            record: Callable[[str, RunRecord | None], None] = lambda *_: None) -> dict[str, dict[str, Times]]:
    """Times by server and case. A case that fails is said and left out; each is rendered once before it counts, and what
    comes of that is also given to `record`, by server."""
    times: dict[str, dict[str, Times]] = {name: {} for name in servers}
    left = []
    for case in cases:
        try:
            for name, server in servers.items():
                render_once(server, case, lambda job, name=name: record(name, job))
            left.append(case)
        except JobFailed as failed:
            say(f"{case.name}: left out: {failed.reason}")
    draw = random.Random(seed)
    for number in range(rounds):
        turns = [(name, case) for name in servers for case in left]
        draw.shuffle(turns)
        for name, case in turns:
            known = times[name].setdefault(case.name, {})
            for kind, value in render_once(servers[name], case).items():
                known.setdefault(kind, []).append(value)
        say(f"round {number + 1} of {rounds}")
    return times
