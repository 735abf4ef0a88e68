#!/usr/bin/env python3
"""Checks that files which the installed headers and shaders cite are installed, and that links in documents lead somewhere.

cited_files.py PREFIX SOURCE
PREFIX has an installation, SOURCE the sources that it was made of.
"""
import pathlib
import re
import sys

# Where the installation has what the sources have in a folder.
INSTALLED = {"docs": "share/doc/supple", "shaders": "share/supple/shaders"}
CITED = re.compile(r"(?<![\w/.-])(docs|shaders|tests|samples|tools|host|runtime|cmake)/([\w./-]*\w\.\w+)")
LINK = re.compile(r"\]\(([^)#:\s]+)(?:#[^)\s]*)?\)")


def faults_of_citations(prefix):
    """Of headers and shaders: their readers have nothing but the installation."""
    found = 0
    for file in sorted([*prefix.glob("include/supple/*"), *prefix.glob("share/supple/shaders/*")]):
        # A path that is broken at the end of a comment's line is not cited in one piece; none is.
        for folder, path in CITED.findall(file.read_text()):
            found += 1
            installed = INSTALLED.get(folder)
            if installed is None or not (prefix / installed / path).is_file():
                yield f"{file.relative_to(prefix)} cites {folder}/{path}, which is not installed"
    if found == 0:
        yield "no header or shader cites a file: the search is broken"


def faults_of_links(prefix, source):
    """Of documents: links to documents are installed, and other links lead to files of the sources."""
    documents = sorted((prefix / INSTALLED["docs"]).glob("*.md"))
    if not documents:
        yield "no documents are installed"
    for file in documents:
        for target in LINK.findall(file.read_text()):
            inside = not target.startswith("../")
            base = file.parent if inside else source / "docs"
            if not (base / target).exists():
                yield f"{file.name} links to {target}, which is not {'installed' if inside else 'in the sources'}"


def main():
    prefix, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    faults = [*faults_of_citations(prefix), *faults_of_links(prefix, source)]
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
