#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Checks README, the pages of doc/ and those of the examples, from their texts alone.

    check_pages.py                  links, anchors, images, languages of code blocks, number of words, messages
    check_pages.py --html FOLDER    links and anchors of the HTML that `./run doc` makes
"""
import html.parser
import os
import pathlib
import re
import sys
import urllib.parse

from pages import ROOT, all_pages, target_of

# What tests/lammps/test_pages.py, tests/tool/test_page_commands.py and tests/library/test_page_code.py take. A text is
# no code: a table, a drawing, what a program prints.
LANGUAGES = {"lammps", "sh", "bash", "c", "cpp", "python", "text"}
IMAGES = (".png", ".gif", ".svg", ".webp", ".jpg")

failed = 0


def fact(name, wrong):
    global failed
    failed += bool(wrong)
    print(f"{'FAIL' if wrong else 'PASS'} {name}")
    for line in wrong:
        print("    ", line)


def check_links(pages):
    missing, no_anchor = [], []
    for page in pages.values():
        for line, target in page.links:
            found = target_of(page, target)
            if not found:
                continue
            path, anchor = found
            if not (ROOT / path).exists():
                missing.append(f"{page.path}:{line}: {target}")
            elif anchor and (path not in pages or anchor not in pages[path].anchors):
                no_anchor.append(f"{page.path}:{line}: {target}")
    fact("every link has its file", missing)
    fact("every anchor is there", no_anchor)
    index = pages["doc/index.md"]
    named = {target_of(index, target)[0] for _, target in index.links if target_of(index, target)}
    fact("doc/index.md has every page of doc/",
         [path for path in pages if path.startswith("doc/") and not path.startswith("doc/data/") and path != "doc/index.md" and path not in named])


def check_images(pages):
    missing, used = [], set()
    for page in pages.values():
        for line, target in page.images + page.links:
            path = target_of(page, target)
            if not path or not target.endswith(IMAGES):
                continue
            used.add(path[0])
            if not (ROOT / path[0]).is_file():
                missing.append(f"{page.path}:{line}: {target}")
    there = {os.path.relpath(path, ROOT) for path in (ROOT / "doc" / "img").rglob("*") if path.is_file()}
    fact("every image is there", missing)
    fact("every image of doc/img is on a page", sorted(there - used))


def check_languages(pages):
    fact("every code block has a language", [f"{page.path}:{line}" for page in pages.values() for line in page.indented] +
         [f"{block}: '{block.language}'" for page in pages.values() for block in page.blocks
          if block.language not in LANGUAGES and not block.form])


def check_messages(pages):
    """Each message of doc/troubleshooting.md is in the sources."""
    text = ""
    for folder in ("src", "kokkos"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".cpp", ".h", ".cu"):
                text += path.read_text(encoding="utf-8")
    # Literals that a compiler joins.
    text = re.sub(r'"\s*\n\s*"', "", text)
    # A host's names in messages: those of LAMMPS.
    names = dict(re.findall(r'names_\.(\w+) = "([^"]+)"', text))
    text = re.sub(r'"\)?\s*\+\s*host_\.names\(\)\.(\w+)\s*\+\s*"', lambda name: names[name[1]], text)
    rows = re.findall(r"^- `([^`]+)`:", pages["doc/troubleshooting.md"].text, re.M)
    fact("twenty messages and more are explained", [] if len(rows) >= 20 else [len(rows)])
    fact("every message is in the sources", [row for row in rows for part in row.split("...") if part.strip()
                                             and not any(form in text for form in (part.strip(), part.strip(" ;:")))])


def check_words(pages):
    """As `wc -w` counts them, tables, script and citation and all. Other pages are as long as they need."""
    words = len(pages["README.md"].text.split())
    fact("README has at most 1000 words", [] if words <= 1000 else [words])


class Anchors(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("id", "name"):
                self.ids.add(value)
            elif name in ("href", "src") and value and not re.match(r"[a-z]+:|//", value):
                self.links.append(value)


def check_html(folder):
    folder = pathlib.Path(folder)
    files = {path: Anchors(path) for path in folder.rglob("*.html")}
    fact("there is an index", [] if folder / "index.html" in files else [folder / "index.html"])
    missing, no_anchor = [], []
    for path, page in files.items():
        for link in page.links:
            target, _, anchor = urllib.parse.unquote(link).partition("#")
            there = pathlib.Path(os.path.normpath(path.parent / target.split("?")[0])) if target else path
            if not there.is_file():
                missing.append(f"{path.relative_to(folder)}: {link}")
            elif anchor and there.suffix == ".html" and anchor not in files[there].ids:
                no_anchor.append(f"{path.relative_to(folder)}: {link}")
    fact(f"every link of {len(files)} HTML files has its file", sorted(set(missing)))
    fact("every anchor of the HTML is there", sorted(set(no_anchor)))


def main():
    if sys.argv[1:2] == ["--html"]:
        check_html(sys.argv[2])
    else:
        pages = all_pages()
        check_links(pages)
        check_images(pages)
        check_languages(pages)
        check_words(pages)
        check_messages(pages)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
