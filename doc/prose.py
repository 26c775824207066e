#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""How the pages read, as numbers: a mirror, not a quota.

    prose.py [--of COMMIT] [PAGE ...]    each page (default: README and doc/), and all of them together

For each page: words, words a sentence, the share of sentences of six words or fewer, and for 1000 words how often the
reader is addressed (you, your) and how often there is an example (for example, such as). Code, tables, headings and the
targets of links are left out, since they have no sentences; an item of a list ends a sentence.
"""
import argparse
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent


def git(*words):
    return subprocess.run(["git", *words], cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout


def paragraphs_of_markdown(text):
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^(```|~~~).*?^\1", "", text, flags=re.S | re.M)
    text = re.sub(r"^\s*(\||#|!\[).*$", "", text, flags=re.M)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.split(r"\n\s*\n|\n\s*(?:[-*]|\d+\.) ", text)


def paragraphs_of_rst(text):
    text = re.sub(r"^\.\. .*\n(?:[ \t]+.*\n|\n)*", "", text, flags=re.M)      # directives, with what is indented below
    text = re.sub(r"::[ \t]*\n(?:\n|[ \t]+.*\n)+", ".\n\n", text)             # blocks of code
    text = re.sub(r"^.*\n[-=\"^~\"]{4,}$", "", text, flags=re.M)              # headings
    text = re.sub(r"^ *[|+].*$|^ *={3,}[ =]*$", "", text, flags=re.M)         # tables
    text = re.sub(r"`([^`<]*) <[^`]*>`_", r"\1", text)
    return re.split(r"\n\s*\n|\n\s*[*-] ", text)


def numbers_of(name, text):
    """(words, sentences, short sentences, you, examples)."""
    made = paragraphs_of_rst(text) if name.endswith(".rst") else paragraphs_of_markdown(text)
    counts = [0] * 5
    for paragraph in made:
        flat = re.sub(r"`[^`]*`|\*\*|\*", "code", re.sub(r"``([^`]*)``", "code", paragraph))
        for sentence in re.split(r"(?<=[.!?])[\"')]*\s+", " ".join(flat.split())):
            words = re.findall(r"[A-Za-z0-9][\w'./-]*", sentence)
            if not words:
                continue
            low = sentence.lower()
            for k, n in enumerate((len(words), 1, len(words) <= 6, len(re.findall(r"\b(?:you|your|yours)\b", low)),
                                   len(re.findall(r"\bfor example\b|\bsuch as\b", low)))):
                counts[k] += n
    return counts


def row(name, counts):
    words, sentences, short, you, examples = counts
    if not words:
        return
    print(f"{name:36} {words:6} {words / sentences:6.1f} {100 * short / sentences:5.0f} % "
          f"{1000 * you / words:6.1f} {1000 * examples / words:6.1f}")


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("--of", metavar="COMMIT", help="the pages of a commit (default: those of the working tree)")
    p.add_argument("pages", nargs="*", metavar="PAGE")
    a = p.parse_args()
    names = a.pages or [n for n in git("ls-tree", "-r", "--name-only", a.of or "HEAD", "README.md", "doc/").split()
                        if n.endswith((".md", ".rst")) and "/notes/" not in n]
    print(f"{'page':36} {'words':>6} {'a sentence':>6} {'short':>5} {'you':>7} {'examples':>6}")
    total = [0] * 5
    for name in names:
        counts = numbers_of(name, git("show", f"{a.of}:{name}") if a.of else (ROOT / name).read_text())
        total = [x + y for x, y in zip(total, counts)]
        row(name, counts)
    row("all", total)


if __name__ == "__main__":
    main()
