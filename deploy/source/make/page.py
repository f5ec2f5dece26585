#!/usr/bin/env python3
"""Renders, measures and writes ../README.md: the source's tables and figures beside ours. Called by deploy/report --source;
--again writes the page of the tables that were measured last."""

import json
import sys
import time

sys.dont_write_bytecode = True

import captions  # noqa: E402
import diagrams  # noqa: E402
import pictures  # noqa: E402
import tables  # noqa: E402
import variants  # noqa: E402
from run import OUT, PICTURES, ROOT, render, server  # noqa: E402

PAGE = PICTURES.parent / "README.md"
MEASURED = OUT / "tables.json"

HEAD = """# The source's tables and figures

Written by `deploy/report --source`, which renders and measures all of it anew; nothing here is written by hand. "The source" is what
[REFERENCES.md](../../REFERENCES.md) calls so, a work of 2004. Its tables stand beside ours, with the command that each of our numbers is
from and what makes the difference. Its figures are drawn again, with a still life of our own ([scene.txtpb](scene.txtpb)): their captions and
its text are known here, the pictures themselves are not. What commands name in build/source is there once it has run; a figure's command
makes one of its pictures, the others differ in the option that their words name; scenes there with another model
or other mirrors are by `make/variants.py`. A figure whose command is `deploy/report --source` has none of its own. All run in the repository's root.

The source measured a program in C# and shaders for a graphics card of its year, on a machine and scenes that it does not describe: its seconds and
ours can't be compared, its ratios can. """

FILES = """## Files

| file | is |
|---|---|
| `scene.txtpb`, `meshes/`, `spectra/` | the still life, which `make/still_life.py` wrote |
| `make/page.py` | writes this page; `run` calls `metamer`, `printed` has the source's numbers, `tables`, `diagrams` and `pictures` make ours, \
`variants` the scenes that differ in one thing, `quantised` Fig. E-2, `sheet` lays pictures out, `captions` says what they show |
| `pictures/` | what it drew |

To change a caption: edit `make/captions.py` and run `make/page.py --again`, which measures and draws nothing.
"""


def measure():
    with server():
        variants.prepare()
        record = render(variants.STILL_LIFE, OUT / "timed.png")["record"]
        made = {"record": record, "tables": tables.all_tables()}
        pictures.all_pictures()
    diagrams.all_diagrams()
    MEASURED.write_text(json.dumps(made, indent=1))


def text_of_table(one):
    rows = [one["columns"], ["---"] + ["---:"] * (len(one["columns"]) - 1), *one["rows"]]
    return (f"### Table {one['number']}: {one['title']}\n\n" + "\n".join("| " + " | ".join(row) + " |" for row in rows)
            + f"\n\n{one['why']}\n\n    {one['command']}\n")


def text_of_figure(figure, name, words, command, difference):
    title = f"Fig. {figure}" if figure[0] in "234E" else f"Shadings {figure}"
    return f"### {title}\n\n![{words}](pictures/{name}.png)\n\n{words} {difference}\n\n    {command}\n"


def how_measured(made):
    record = made["record"]
    machine = record["machine"][0]
    return (f"Measured with {machine['threads']} threads on a processor that calls itself {machine['cpu']}, by the build {record['build']}, OpenGL "
            "by Mesa's software. Times of ours are CPU seconds of the worker's threads in that phase of the job, so that other work of the machine "
            f"is not in them: the least of {tables.ROUNDS} rounds, {tables.QUICK} of what takes milliseconds, in which the cases take "
            "turns. Ratios that differ by less than a tenth do not differ.\n")


def page(made):
    return "\n".join([
        HEAD + how_measured(made), "## Tables\n", *map(text_of_table, made["tables"]), "## Diagrams\n",
        *(text_of_figure(*figure) for figure in captions.DIAGRAMS), captions.LEFT_OUT + "\n", "## Pictures\n",
        *(text_of_figure(*figure) for figure in captions.PICTURES), FILES])


def main():
    again = sys.argv[1:] == ["--again"]
    if sys.argv[1:] and not again:
        raise SystemExit("usage: page.py [--again]")
    started = time.monotonic()
    PICTURES.mkdir(exist_ok=True)
    if not again:
        measure()
    PAGE.write_text(page(json.loads(MEASURED.read_text())))
    print(f"The page:  {PAGE.relative_to(ROOT)}, after {time.monotonic() - started:.0f} s")


if __name__ == "__main__":
    main()
