#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""A step of one sphere does not enter more functions of the core than it did, in no more files: what somebody walks through
who reads how a step works. Accessors of vectors and views are left out; lambdas count with their functions. A change of file
is one from a function to another that lies in another file, by a call or a return. Functions of six lines and more count again
by themselves.

usage: test_trace.py [--keep] [--walk CASE], with LSDCD_TRACE_STEP (the program) and LSDCD_COMPILER set. --walk prints the
functions of a case in the order in which they are entered, with their files.
"""
import os
import pathlib
import re
import subprocess
import sys

import kept_numbers

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LONG = 6    # lines


class Function:
    """What a function is called and where it is defined."""

    def __init__(self, name, place):
        path, _, line = place.rpartition(":")
        at = path.rfind("/src/")
        self.file = path[at + 1:] if at >= 0 else ""
        name, *is_lambda = without_templates(name).split("::{lambda")
        self.name = name.split("(")[0].replace("lsdcd::", "").split(" ")[-1]
        self.lines = 0 if is_lambda or not self.file else lines_of(self.file, int(line.split()[0]))
        self.key = (self.name, self.file)

    def is_of_core(self):
        return self.file != "" and not re.match(r"(std::|__gnu|operator (new|delete))", self.name)


def without_templates(name):
    name = name.replace("(anonymous namespace)::", "").replace("operator()", "operator_call")
    while re.search(r"<[^<>]*>", name):
        name = re.sub(r"<[^<>]*>", "", name)
    return name


SOURCES = {}


def lines_of(file, line):
    """How many lines the definition has that the compiler says begins there, from its name to its last brace."""
    if file not in SOURCES:
        text = (ROOT / file).read_text() if (ROOT / file).exists() else ""
        SOURCES[file] = [re.sub(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])*\'|//.*', "", each) for each in text.split("\n")]
    depth, begun = 0, False
    for at, text in enumerate(SOURCES[file][line - 1:]):
        for c in text:
            depth += (c == "{") - (c == "}")
            begun = begun or c == "{"
            if begun and depth <= 0:
                return at + 1
    return 0


def functions_of(program, addresses):
    done = subprocess.run(["addr2line", "-f", "-C", "-e", program, *("0x" + a for a in addresses)],
                          stdout=subprocess.PIPE, text=True, check=True)
    lines = done.stdout.split("\n")
    return {a: Function(lines[2 * k], lines[2 * k + 1]) for k, a in enumerate(addresses)}


def walk(events, functions):
    """The functions, each with its depth, that are entered, and where the walk is after each event."""
    stack, entered, places = [], [], []
    for address in events:
        if address != "0":
            stack.append(functions[address])
            if stack[-1].is_of_core():
                entered.append((sum(f.is_of_core() for f in stack), stack[-1]))
        else:
            stack.pop()
        places.append([f for f in stack if f.is_of_core()])
    return entered, places


def changes_of_file(places, counts):
    last, n = None, 0
    for stack in places:
        here = next((f.file for f in reversed(stack) if counts(f)), None)
        if here and here != last:
            n, last = n + 1, here
    return n


def numbers_of(case, events, functions):
    entered, places = walk(events, functions)
    found = {}
    for what, counts in (("", lambda f: True), (" of six lines and more", lambda f: f.lines >= LONG)):
        keys = {f.key for _, f in entered if counts(f)}
        found[f"{case}: functions{what}"] = len(keys)
        found[f"{case}: files of functions{what}"] = len({file for _, file in keys})
        found[f"{case}: changes of file between functions{what}"] = changes_of_file(places, counts)
    found[f"{case}: calls"] = len(entered)
    return found


def print_walk(events, functions):
    seen = set()
    for depth, f in walk(events, functions)[0]:
        if f.key not in seen:
            print("  " * depth + f.name, f"[{f.file}{', ' + str(f.lines) + ' lines' if f.lines >= LONG else ''}]")
        seen.add(f.key)


program = os.environ["LSDCD_TRACE_STEP"]
done = subprocess.run([program], env={**os.environ, "OMP_NUM_THREADS": "1"}, stdout=subprocess.PIPE, text=True)
if done.returncode != 0:
    raise SystemExit(f"FAIL the program ended with {done.returncode}: {done.stdout[-200:]}")
cases = {}
for line in done.stdout.splitlines():
    if line.startswith("# "):
        events = cases[line[2:].split(", force")[0]] = []
    else:
        events.append(line)
functions = functions_of(program, sorted({a for events in cases.values() for a in events if a != "0"}))
if "--walk" in sys.argv:
    print_walk(cases[sys.argv[sys.argv.index("--walk") + 1]], functions)
    sys.exit(0)
found = {}
for case, events in cases.items():
    found.update(numbers_of(case, events, functions))
sys.exit(kept_numbers.compare(pathlib.Path(__file__).with_name("step_trace.csv"), os.environ["LSDCD_COMPILER"], found, 0,
                              "in a step") > 0)
