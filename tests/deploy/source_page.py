#!/usr/bin/env python3
"""source_page.py TREE: holds the page of deploy/source against what it is to have. Prints what is wrong; exit code 1 then."""
import importlib.util
import pathlib
import re
import sys

TABLES = ["4.2-1", "4.2-2", "4.3-1", "4.4-1", "4.4-2", "4.4-3", "4.5-1", "4.5-2"]
# 2-7, 3-1 and 3-2 are drawings.
FIGURES = [f"2-{i}" for i in (2, 3, 4, 5, 6, 8, 9, 10, 11)] + ["3-3", "3-4", "4-3"] + [f"E-{i}" for i in range(1, 15)]
MOST_BYTES = 3_000_000  # all of the folder
PNG = b"\x89PNG\r\n\x1a\n"
COMMAND = re.compile(r"^    (metamer|deploy/report|numpy\.)\S* ", re.MULTILINE)


def sections(page):
    """What stands below each heading of the third level, by the heading's first words: "Table 4.2-1", "Fig. E-1"."""
    parts = re.split(r"^#{2,3} ", page, flags=re.MULTILINE)[1:]
    return {" ".join(re.split(r"[ :\n]", part)[:2]): part for part in parts}


def numbers_of(values):
    """Those of printed.py's nested tables and tuples."""
    for value in values.values() if isinstance(values, dict) else values if isinstance(values, tuple) else ():
        yield from numbers_of(value) if isinstance(value, tuple) else () if value is None else (value,)


def shown(value):
    """As the page writes it: 0.00035 s as 0.35 ms, 4 s as 4 s."""
    return {f"{value:g}", f"{1000 * value:.3g} ms"}


def wrong_tables(parts, printed):
    for number in TABLES:
        part = parts.get(f"Table {number}", "")
        cells = {cell.strip().removesuffix(" s").removesuffix("*") for cell in part.split("|")}
        if not COMMAND.search(part):
            yield f"Table {number} has no command"
        for value in numbers_of(getattr(printed, f"TABLE_{re.sub(r'[.-]', '_', number)}")):
            if not shown(value) & cells:
                yield f"Table {number} lacks the source's {value:g}"


def wrong_figures(parts, folder):
    for number in FIGURES:
        part = parts.get(f"Fig. {number}", "")
        if not COMMAND.search(part + " "):
            yield f"Fig. {number} has no command"
        if not re.search(r"!\[.+\]\(pictures/", part):
            yield f"Fig. {number} has no picture with words"
    named = set(re.findall(r"\(pictures/([^)]+)\)", "".join(parts.values())))
    there = {file.name for file in (folder / "pictures").iterdir() if file.read_bytes().startswith(PNG)}
    for name in sorted(named ^ there):
        yield f"pictures/{name} is named and not there" if name in named else f"pictures/{name} is not named"


def main(root):
    folder = pathlib.Path(root, "deploy/source")
    spec = importlib.util.spec_from_file_location("printed", folder / "make/printed.py")
    printed = importlib.util.module_from_spec(spec)
    sys.dont_write_bytecode = True
    spec.loader.exec_module(printed)
    parts = sections((folder / "README.md").read_text())
    wrong = [*wrong_tables(parts, printed), *wrong_figures(parts, folder)]
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file() and "__pycache__" not in file.parts)
    if size > MOST_BYTES:
        wrong.append(f"deploy/source has {size} bytes, more than {MOST_BYTES}")
    print("\n".join(wrong) or f"{len(TABLES)} tables, {len(FIGURES)} figures, {size} bytes")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
