"""The command line of metamer-bench."""
import argparse
import contextlib
import json
import os
import statistics
import sys
import time

from metamer import blocking
from metamer.bench.cases import make_cases
from metamer.bench.machine import describe
from metamer.bench.measure import MEASURES, Times, measure
from metamer.bench.significance import LEVEL, TOLERANCE, holm, mann_whitney, ratio, signed_rank
from metamer.errors import InputError, MetamerError
from metamer.v1.plan_pb2 import RunRecord

FORMAT = 1  # of the record


def parse(words: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="metamer-bench", description="Measures a metamerd; prints medians of all rounds.",
                                     epilog="Exit codes: 0 done, 1 a case got slower, 2 bad input, 3 anything else.")
    parser.add_argument("scene", nargs="+", help="a .txtpb file")
    parser.add_argument("--method", action="append", default=[], help='"exact", "point { fitted: 8 }"; repeated; the scene\'s')
    parser.add_argument("--samples", type=_numbers, default=[], help="of each pixel: 1,4,16; the scene's")
    parser.add_argument("--backend", action="append", default=[], choices=["cpu", "gl"], help="repeated; the scene's")
    parser.add_argument("--size", type=_size, help="WIDTHxHEIGHT; the scene's")
    parser.add_argument("--rounds", type=int, default=20, help="how often each case is measured (20)")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--server", help="one that runs; METAMER_SERVER; else a private one is started")
    where.add_argument("--program", help="the metamerd to start; the one in PATH")
    parser.add_argument("--against", metavar="PROGRAM", help="another metamerd, measured in the same rounds")
    parser.add_argument("--baseline", metavar="FILE", help="a record of before")
    parser.add_argument("--measure", choices=MEASURES, default="seconds", help="what is compared: rendering by the server's "
                        "clock, its workers' CPU, or all as seen from here (seconds)")
    parser.add_argument("--tolerance", type=float, default=TOLERANCE, help="what is no slower yet, as a share (0.01)")
    parser.add_argument("--seed", type=int, help="of the order within rounds")
    parser.add_argument("-o", "--output", metavar="FILE", help="the record, JSON")
    return parser.parse_args(words)


def _numbers(text: str) -> list[int]:
    return [int(word) for word in text.split(",")]


def _size(text: str) -> tuple[int, int]:
    width, height = text.split("x")
    return int(width), int(height)


def say(line: str) -> None:
    print(line, file=sys.stderr, flush=True)


def main(words: list[str] | None = None) -> int:
    """The exit code."""
    options = parse(words)
    try:
        return run(options)
    except InputError as error:
        say(f"metamer-bench: {error}")
        return 2
    except (MetamerError, OSError) as error:
        say(f"metamer-bench: {error}")
        return 3


def run(options: argparse.Namespace) -> int:
    before = read_record(options.baseline) if options.baseline else None
    cases = list(make_cases(options.scene, options.method, options.samples, options.backend, options.size))
    with contextlib.ExitStack() as stack:
        server = None if options.program else options.server or os.environ.get("METAMER_SERVER")
        ours = blocking.connect(server) if server else blocking.local(options.program)
        servers = {"now": stack.enter_context(ours)}
        if options.against:
            servers["against"] = stack.enter_context(blocking.local(options.against))
        records: dict[str, RunRecord | None] = {}
        times = measure(servers, cases, options.rounds, say, options.seed, records.__setitem__)
        record = {"format": FORMAT, "time": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
                  "machine": describe(servers["now"].info(), records.get("now")), "rounds": options.rounds, "times": times["now"]}
        if options.against:
            record["against"] = {"machine": describe(servers["against"].info(), records.get("against")), "times": times["against"]}
    print_medians(times["now"])
    if options.output:
        with open(options.output, "w", encoding="utf-8") as file:
            json.dump(record, file, indent=1)
    slower = []
    if options.against:
        slower += compare("the other program", times["now"], times["against"], options, signed_rank)
    if before:
        say_differences(record["machine"], before["machine"])
        slower += compare(options.baseline, times["now"], before["times"], options, mann_whitney)
    return 1 if slower else 0


def read_record(file: str) -> dict:
    """InputError: it can't be read, or is none."""
    try:
        with open(file, encoding="utf-8") as stream:
            record = json.load(stream)
        if record["format"] != FORMAT or not all(isinstance(record[key], dict) for key in ("times", "machine")):
            raise InputError(f"{file} is a record of another format")
        return record
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"{file} is no record of metamer-bench: {error}") from error


def print_medians(times: dict[str, Times]) -> None:
    print(f"{'render s':>9} {'CPU s':>9} {'wall s':>9}  case")
    for name, known in times.items():
        medians = (f"{statistics.median(known[kind]):9.4f}" if kind in known else f"{'-':>9}" for kind in MEASURES)
        print(*medians, f" {name}")


def say_differences(now: dict, before: dict) -> None:
    for key in ("cpu", "isa", "cores", "gpu", "threads", "system"):
        if now.get(key) != before.get(key):
            say(f"note: the baseline is of another machine: {key} was {before.get(key)}, is {now.get(key)}")


def compare(what: str, now: dict[str, Times], before: dict[str, Times], options: argparse.Namespace, test) -> list[str]:
    """Prints what got slower than `what`, and gives its names."""
    kind = options.measure
    both = [name for name in now if now[name].get(kind) and before.get(name, {}).get(kind)]
    chances = [test(now[name][kind], before[name][kind], options.tolerance) for name in both]
    slower = []
    for name, chance, stands in zip(both, chances, holm(chances)):
        if stands:
            slower.append(name)
            print(f"slower than {what}: {ratio(now[name][kind], before[name][kind]):.3f} times, p {chance:.2g}: {name}")
    if not slower:
        print(f"nothing is slower than {what}: {len(both)} of {len(now)} cases compared, level {LEVEL}")
    return slower
