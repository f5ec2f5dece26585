#!/usr/bin/env python3
"""directions.py TREE: holds the #include lines of a source tree against directions.txt, which lies beside
this file. Prints each rule that is broken, with the chain of files that breaks it; exit code 1 then."""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def read_rules(path):
    """Blocks of `key: words`, apart by empty lines."""
    rules = []
    for block in re.sub(r"^#.*\n", "", path.read_text(), flags=re.MULTILINE).split("\n\n"):
        lines = dict(line.split(": ", 1) for line in block.strip().splitlines())
        if lines:
            rules.append((lines["rule"], lines["from"].split(), lines["never"].split()))
    return rules


def read_tree(top):
    """What each of our files includes, by its path from the top."""
    tree = {}
    for folder in ("common", "server", "client"):
        for path in sorted((top / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                tree[path.relative_to(top).as_posix()] = INCLUDE.findall(path.read_text())
    return tree


def begins(path, prefixes):
    return any(path.startswith(prefix) for prefix in prefixes)


def first_chain(tree, start, never):
    """The shortest way from a file to something that it never should reach, or nothing."""
    ways, seen = [[start]], {start}
    for way in ways:
        for include in tree.get(way[-1], ()):
            if begins(include, never):
                return way + [include]
            if include in tree and include not in seen:
                seen.add(include)
                ways.append(way + [include])
    return None


def main():
    rules = read_rules(pathlib.Path(__file__).with_name("directions.txt"))
    tree = read_tree(pathlib.Path(sys.argv[1]))
    if len(tree) < 100:
        sys.exit(f"{sys.argv[1]} is no source tree")
    broken = 0
    for rule, sources, never in rules:
        left_out = [source[1:] for source in sources if source.startswith("-")]
        for path in tree:
            if not begins(path, sources) or begins(path, left_out):
                continue
            chain = first_chain(tree, path, never)
            if chain:
                broken += 1
                print(f"{rule}:\n  " + "\n  includes ".join(chain))
    sys.exit(1 if broken else 0)


main()
