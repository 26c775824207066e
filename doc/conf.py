# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""How Sphinx makes HTML of the pages: `./run doc`. Its source folder is the top of the repository.

Pages are plain Markdown and reStructuredText with relative links, which work where the repository is shown,
too. Here a link to a page becomes one to its HTML, a link to a folder one to the folder's README, and any
other file is copied. The links of doc/index.md, section by section, are the contents at the side.
"""
import os
import pathlib
import re

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from pygments import token
from pygments.lexer import RegexLexer, bygroups
from sphinx import addnodes
from sphinx.transforms import SphinxTransform
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util import logging

ROOT = pathlib.Path(__file__).resolve().parent.parent

project = "LSDCD"
copyright = "2026 LSDCD contributors"
release = version = re.search(r"project\(lsdcd VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]

extensions = ["myst_parser"]
myst_enable_extensions = ["html_image"]
root_doc = "doc/index"
include_patterns = ["*.md", ".github/*.md", "doc/**.md", "doc/**.rst", "examples/**.md", "potentials/**.md"]
exclude_patterns = [".git", ".ci", "build*", "demo", "src", "tests", "bench", "kokkos"]
myst_heading_anchors = 4    # with the names that the web view gives them
html_math_renderer = "mathml"
html_theme = "sphinx_rtd_theme"
html_theme_options = {"navigation_depth": 2, "collapse_navigation": False}
html_static_path = ["html"]
html_css_files = ["pages.css"]
html_show_sphinx = False
html_copy_source = False


class Lammps(RegexLexer):
    """Input scripts of LAMMPS: comments, commands, variables, numbers."""
    name = "LAMMPS"
    aliases = ["LAMMPS", "lammps"]
    tokens = {"root": [
        (r"#.*", token.Comment),
        (r"^(\s*)(\w+)", bygroups(token.Whitespace, token.Keyword)),
        (r"\$\{\w+\}|\$\w|\b[vcfF]_\w+", token.Name.Variable),
        (r'"[^"\n]*"', token.String),
        (r"(?<![\w.])[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?(?![\w.])", token.Number),
        (r"\s+", token.Whitespace),
        (r"[^\s$#\"]+|.", token.Text)]}


def path_of(node, docname):
    """Of a relative link: the path from the top of the repository, and the anchor."""
    if node.get("refdomain") == "doc":    # MyST of 2023 or later has looked for the page
        page = node["reftarget"]
        return f"{page}{'.md' if (ROOT / f'{page}.md').is_file() else '.rst'}", node["reftargetid"] or ""
    path, _, anchor = node["reftarget"].partition("#")
    if not path:
        return None, anchor
    path = os.path.normpath(os.path.join(os.path.dirname(docname), path))
    if (ROOT / path).is_dir() and (ROOT / path / "README.md").is_file():
        path += "/README.md"
    return path, anchor


class FindLinks(SphinxTransform):
    """When a page is read: relative links of reStructuredText become those that Markdown's are, and the links
    of index pages the contents."""
    default_priority = 700    # where the targets of reStructuredText are known

    def apply(self, **kwargs):
        docname = self.env.docname
        for node in list(self.document.findall(nodes.reference)):
            uri = node.get("refuri", "")
            if not uri or re.match(r"\w+:|#", uri):
                continue
            path = os.path.normpath(os.path.join(os.path.dirname(docname), uri.partition("#")[0]))
            kind = addnodes.pending_xref
            if (ROOT / path).is_file() and path not in map(self.env.doc2path, self.env.found_docs) \
                    and not path.endswith((".md", ".rst")):
                kind = addnodes.download_reference
            node.replace_self(kind("", *node.children, refdoc=docname, reftarget=uri, reftype="myst",
                                   refdomain=None, refexplicit=True, refwarn=True))
        if docname in (root_doc, "examples/README"):
            for section in list(self.document.findall(nodes.section)):
                self.add_contents(section, docname)

    def add_contents(self, section, docname):
        parts = [node for node in section.children if not isinstance(node, nodes.section)]
        pages = {}    # and the words of their links
        for part in parts:
            for node in part.findall(addnodes.pending_xref):
                path, _ = path_of(node, docname)
                page = path and self.env.path2doc(str(ROOT / path))
                is_example = page and page.startswith("examples/")
                # Examples are below their own page.
                if page in self.env.found_docs and page != docname and \
                        (page == "examples/README" or not is_example if docname == root_doc else is_example):
                    text = node.astext()
                    pages.setdefault(page, text if "/" in text else text[:1].upper() + text[1:])
        if pages:
            is_top = docname != root_doc or isinstance(section.parent, nodes.document)
            caption = None if is_top else section[0].astext()
            section.insert(len(parts), addnodes.toctree(
                "", entries=[(text, page) for page, text in pages.items()], includefiles=list(pages), parent=docname,
                maxdepth=1, caption=caption, rawcaption=caption, glob=False, hidden=True, numbered=0, titlesonly=True,
                includehidden=False, rawentries=[]))


class ResolveLinks(SphinxPostTransform):
    """When all pages are read: links to pages. What is not found is left to MyST, which warns."""
    default_priority = 5

    def run(self, **kwargs):
        docname = self.env.docname
        self.mend_tables()
        for node in list(self.document.findall(addnodes.pending_xref)):
            if node["reftype"] != "myst":
                continue
            path, anchor = path_of(node, docname)
            page = self.env.path2doc(str(ROOT / path)) if path else docname
            if page not in self.env.found_docs:
                continue
            uri = self.app.builder.get_relative_uri(docname, page) if path else ""
            if anchor:
                uri += "#" + self.place(page, anchor)
            node.replace_self(nodes.reference("", "", *node.children, refuri=uri or "#", internal=True))

    def mend_tables(self):
        """A head without words goes, and no line ends inside a number such as 20 000."""
        for head in list(self.document.findall(nodes.thead)):
            if not head.astext().strip():
                head.parent.remove(head)
        for entry in self.document.findall(nodes.entry):
            for text in list(entry.findall(nodes.Text)):
                text.parent.replace(text, nodes.Text(re.sub(r"(?<=\d) (?=\d{3}\b)", "\u00a0", text.astext())))

    def place(self, page, anchor):
        """The id of a heading, which may differ from its anchor."""
        slugs = self.env.metadata[page].get("myst_slugs", {})    # of MyST of 2023 or later
        if anchor in slugs:
            return slugs[anchor][1]
        file = os.path.relpath(self.env.doc2path(page), ROOT)
        return self.env.get_domain("std").anonlabels.get(f"{file}#{anchor}", (page, anchor))[1]


def write_formula(writer, node):
    """As MathML, which browsers draw by themselves: MathJax, which Sphinx takes, is fetched from the network."""
    formula = tex2mathml(node.astext())
    if isinstance(node, nodes.math_block):
        formula = formula.replace("<math ", '<math display="block" ', 1)
    writer.body.append(formula)
    raise nodes.SkipNode


def first_page(app, error):
    """index.html at the top shows the contents."""
    if not error and app.builder.format == "html":
        (pathlib.Path(app.outdir) / "index.html").write_text(
            '<!doctype html><meta charset="utf-8"><title>LSDCD</title>'
            '<meta http-equiv="refresh" content="0; url=doc/index.html"><a href="doc/index.html">LSDCD</a>\n')


def setup(app):
    app.add_lexer("LAMMPS", Lammps)
    app.add_lexer("lammps", Lammps)
    app.add_transform(FindLinks)
    app.add_post_transform(ResolveLinks)
    app.add_html_math_renderer("mathml", (write_formula, None), (write_formula, None))
    app.connect("build-finished", first_page)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
