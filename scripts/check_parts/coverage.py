#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Prints which lines and branches of each room were executed, as a table.

    scripts/check_parts/coverage.py BUILD

Reads by gcov what the tests have left in a build directory of the preset coverage. A branch is one
way that a condition can go; ways by which only exceptions leave are not counted. A line of a
template counts as executed if it is for some arguments, its branches count for each.
"""

import collections
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# How many files gcov is given at a time.
PORTION = 20


def room_of(file):
    """The room of a file of source/ or include/graupel/; None of others."""
    parts = Path(file).resolve().parts[len(ROOT.parts) :]
    if not Path(file).resolve().is_relative_to(ROOT):
        return None
    if parts[:1] == ("source",):
        return parts[1]
    if parts[:2] == ("include", "graupel"):
        return parts[2]
    return None


def add(units, lines, branches):
    """Adds the counts of gcov's report on some units."""
    for file in units["files"]:
        room = room_of(file["file"])
        if room is None:
            continue
        for line in file["lines"]:
            place = (room, file["file"], line["line_number"])
            lines[place] += line["count"]
            for k, branch in enumerate(line["branches"]):
                if not branch["throw"]:
                    branches[*place, line.get("function_name"), k] += branch["count"]


def read(build):
    """How often each line and branch was executed: by room, file, line and so on."""
    lines, branches = collections.Counter(), collections.Counter()
    data = [file for file in sorted(build.rglob("*.gcda")) if "source" in file.parts]
    for begin in range(0, len(data), PORTION):
        report = subprocess.run(
            ["gcov", "--json-format", "--branch-probabilities", "--stdout",
             *map(str, data[begin : begin + PORTION])],
            cwd=build, capture_output=True, text=True, check=True,
        ).stdout  # fmt: skip
        for unit in report.splitlines():
            add(json.loads(unit), lines, branches)
    return lines, branches


def part(counts):
    """How many are not 0, and of how many."""
    executed = sum(count > 0 for count in counts)
    return f"{100.0 * executed / max(len(counts), 1):.1f} % of {len(counts):,}"


def main():
    """Returns the exit status."""
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    lines, branches = read(Path(sys.argv[1]).resolve())
    if not lines:
        print("coverage: there is nothing that tests have left", file=sys.stderr)
        return 1
    print("| room | lines | branches |\n| --- | --- | --- |")
    for room in sorted({place[0] for place in lines}):
        of_room = [[n for place, n in table.items() if place[0] == room]
                   for table in (lines, branches)]  # fmt: skip
        print(f"| {room} | {part(of_room[0])} | {part(of_room[1])} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
