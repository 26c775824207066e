# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Reads the pages, Markdown and reStructuredText: their links, images, headings and code blocks.

A code block has a language: ```lammps in Markdown, `.. code-block:: LAMMPS` in reStructuredText. Tests run
it, unless the second word behind ``` is `form`, in reStructuredText `:class: form`: what another machine needs, which FORMS of
test_pages.py names with its reason. A program with the second word `run` prints the lines of the first ```text block after it. In
reStructuredText a parsed-literal and a block under the heading Syntax are syntax, and no code. A comment before a block gives
lines that a test puts before it: `<!-- before: variable e equal 0.9 -->`, `.. before: variable e equal 0.9`.
"""
import os
import pathlib
import re
import textwrap

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
GLOBS = ("*.md", ".github/*.md", "doc/*.md", "doc/*.rst", "doc/notes/*.md", "doc/data/*.md", "examples/**/*.md", "potentials/*.md")


class Block:
    def __init__(self, page, line, language, text, form=False, before=(), run=False, syntax=False):
        self.page, self.line, self.language, self.form = page, line, language.lower(), form
        self.text, self.before, self.run, self.syntax = textwrap.dedent(text), list(before), run, syntax

    def __str__(self):
        return f"{self.page.path}:{self.line}"


def slug(title):
    """The anchor of a heading in Markdown."""
    title = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", title.strip())
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


class Page:
    def __init__(self, path):
        self.path = path
        self.text = (ROOT / path).read_text(encoding="utf-8")
        self.links, self.images, self.anchors, self.blocks = [], [], set(), []    # links: (line, target)
        self.indented = []    # lines of code without a language
        (self.read_rst if path.endswith(".rst") else self.read_md)()

    def heading(self, name):
        anchor, n = name, 0
        while anchor in self.anchors:
            n += 1
            anchor = f"{name}-{n}"
        self.anchors.add(anchor)

    def read_md(self):
        lines = self.text.split("\n")
        prose, before, at, after_list = [], [], 0, False
        while at < len(lines):
            line = lines[at]
            fence = re.match(r"( *)```+ *(.*)$", line)
            if fence:
                end = at + 1
                while end < len(lines) and not re.match(r" *```+ *$", lines[end]):
                    end += 1
                words = fence[2].split() or [""]
                self.blocks.append(Block(self, at + 1, words[0], "\n".join(lines[at + 1:end]) + "\n", "form" in words[1:],
                                         before, "run" in words[1:]))
                prose += [""] * (end - at + 1)
                at, before = end + 1, []
                continue
            comment = re.match(r"<!-- before: (.*) -->$", line)
            if comment:
                before.append(comment[1])
            elif re.match(r"    +\S", line) and not after_list and (not lines[at - 1].strip() or at in self.indented):
                self.indented.append(at + 1)
            elif re.match(r"\s*([-*]|\d+\.) ", line):
                after_list = True
            elif re.match(r"\S", line):
                after_list = after_list and bool(lines[at - 1].strip())
            title = re.match(r"#{1,6} +(.*)", line)
            if title:
                self.heading(slug(title[1]))
            prose.append(re.sub(r"`[^`]*`", "", line))
            at += 1
        self.find_links(prose, r"(!?)\[[^]]*\]\(([^) ]+)\)")
        for number, line in enumerate(prose, 1):    # an image in a link, and HTML
            for target in re.findall(r"src=\"([^\"]+)\"", line):
                self.images.append((number, target))

    def find_links(self, prose, pattern):
        text = "\n".join(prose)
        for match in re.finditer(pattern, text):
            number = text.count("\n", 0, match.start()) + 1
            (self.images if match[1] == "!" else self.links).append((number, match[2]))

    def read_rst(self):
        lines = self.text.split("\n")
        section, before = "", []
        for at, line in enumerate(lines):
            if at and line and re.fullmatch(r"([=\-\"'~^])\1{2,}", line) and re.match(r"\S", lines[at - 1]):
                section = lines[at - 1]
                # As docutils makes the name of an id.
                self.heading(re.sub(r"[^a-z0-9]+", "-", section.lower()).strip("-"))
            comment = re.match(r" *\.\. before: (.*)", line)
            if comment:
                before.append(comment[1])
            image = re.match(r" *\.\. (?:image|figure):: (\S+)", line)
            if image:
                self.images.append((at + 1, image[1]))
            target = re.match(r"\.\. _([\w-]+):$", line)
            if target:
                self.anchors.add(target[1])
            block = re.match(r"( *)\.\. (code-block|parsed-literal)::(.*)", line)
            literal = not block and not re.match(r" *\.\. ", line) and re.match(r"( *)\S.*::$", line)
            if block or literal:
                self.blocks.append(self.rst_block(lines, at, block or literal, section, before, bool(literal)))
                before = []
        self.find_links(lines, r"()`[^`<]*<([^`>]+)>`__?")
        for number, line in enumerate(lines, 1):
            for role in re.findall(r":(?:doc|ref):`[^`]*`", line):    # no link where the repository is shown
                self.links.append((number, role))
            for target in re.findall(r"^\.\. _[^:]+: (\S+)$", line):
                self.links.append((number, target))

    def rst_block(self, lines, at, match, section, before, literal):
        end = at + 1
        while end < len(lines) and (not lines[end].strip() or
                                    len(lines[end]) - len(lines[end].lstrip()) > len(match[1])):
            end += 1
        body = lines[at + 1:end]
        syntax = section == "Syntax" or not literal and match[2] == "parsed-literal"
        form = False
        while body and (not body[0].strip() or re.match(r" *:\w+:", body[0])):
            form = form or body[0].strip() == ":class: form"
            body = body[1:]
        language = "" if literal or match[2] == "parsed-literal" else match[3].strip()
        if literal:
            self.indented.append(at + 1)
        return Block(self, at + 1, language, "\n".join(body).rstrip() + "\n", form or syntax, before, syntax=syntax)


def all_pages():
    paths = {os.path.relpath(path, ROOT) for pattern in GLOBS for path in ROOT.glob(pattern)}
    return {path: Page(path) for path in sorted(paths)}


def target_of(page, target):
    """Path from the top and anchor of a relative link; None for others."""
    if re.match(r"[a-z]+:", target):
        return None
    path, _, anchor = target.partition("#")
    path = os.path.normpath(os.path.join(os.path.dirname(page.path), path)) if path else page.path
    return path, anchor
