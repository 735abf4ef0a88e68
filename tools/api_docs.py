#!/usr/bin/env python3
"""A page of the public API from the comments of the headers, by doxygen.

  api_docs.py [PAGE]     writes the page, without a name to build/api.md
  api_docs.py --check    does doxygen warn, is anything new without a comment, does the page have every public function?
  api_docs.py --accept   writes tests/api_docs/undocumented.txt anew: what needs no comment
  api_docs.py --filter FILE    for doxygen: plain comments of the header as comments of doxygen's
"""
import argparse
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADERS = (
    "supple.h", "supple_view.h", "supple_playback.h", "supple_prepare.h", "supple_character.h", "supple_recording.h",
    "supple_points.h", "supple_queries.h", "supple_rays.h", "supple_direct.h", "supple_cpu.h",
    "supple.hpp", "supple_tinygltf.hpp", "supple_tracy.h",
)
INCLUDE = ROOT / "runtime/include/supple"
PAGE = ROOT / "build/api.md"
UNDOCUMENTED = ROOT / "tests/api_docs/undocumented.txt"
BANNER = re.compile(r"/\* -{8,} (.*?) \*/")


def filtered(text, name):
    """Comments that count: those that begin a line are of what follows, those behind something of that. `/**` and `/**<`
    stay as they are, banners go, the first comment is the file's, and structSize explains itself everywhere."""
    lines = []
    first = True
    for line in text.split("\n"):
        start = line.lstrip()
        if BANNER.match(start):
            line = ""
        elif re.match(r"/\*(\s|\*?$)", start) or (first and start.startswith("/**")):
            line = re.sub(r"/\*+", f"/** @file {name}\n *" if first else "/**", line, count=1)
            first = False
        elif start.startswith("//") and first:
            line = f"/// @file {name}\n///" + start.lstrip("/")
            first = False
            lines.append(line)
            continue
        elif not start.startswith("*") and re.search(r"\S.*/\*\s", line) and "//" not in line.split("/*")[0]:
            line = re.sub(r"/\*\s", "/**< ", line, count=1)
        elif re.match(r"uint32_t structSize;$", start):
            line += " /**< sizeof the struct */"
        if name.endswith(".hpp") and start.startswith("// ") and lines and lines[-1].startswith("///"):
            line = "/" + line
        lines.append(line)
    return "\n".join(lines)


def run_doxygen(directory):
    """The XML's folder, and doxygen's warnings."""
    settings = (ROOT / "docs/Doxyfile").read_text() + f"\nOUTPUT_DIRECTORY = {directory}\n"
    done = subprocess.run(["doxygen", "-"], input=settings, text=True, capture_output=True, cwd=ROOT)
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    xml = Path(directory) / "xml"
    if not (xml / "index.xml").exists():
        sys.exit("doxygen made no XML:\n" + done.stderr)
    return xml, lines


def split_warnings(lines):
    """Names without a comment, and everything else doxygen had to say."""
    names, others = set(), []
    for line in lines:
        found = re.search(r"(?:Compound (\S+)|Member (.+?) \(.*?\) of \w+ (\S+)) is not documented", line)
        if found is None:
            others.append(line.replace(str(ROOT) + "/", ""))
        elif found[1]:
            names.add(found[1])
        else:
            member = re.split(r"[(\[]", found[2])[0].split()[0]
            names.add(member if found[3].endswith((".h", ".hpp")) else f"{found[3]}::{member}")
    return names - {"SUPPLE_API"}, others


def escaped(text):
    return re.sub(r"([*|])", r"\\\1", text).replace("<", "&lt;")


def text_of(node):
    """A description as one line of Markdown a paragraph."""
    if node is None:
        return []
    paragraphs = []

    def inline(element):
        parts = [escaped(element.text or "")]
        for child in element:
            if child.tag == "computeroutput":
                parts.append("`" + "".join(child.itertext()) + "`")
            elif child.tag in ("itemizedlist", "orderedlist"):
                for item in child:
                    parts.append("\n* " + " ".join("".join(item.itertext()).split()).replace("*", "\\*"))
                parts.append("\n")
            elif child.tag == "simplesect":
                parts.append("".join(inline(para) for para in child))
            else:
                parts.append(inline(child))
            parts.append(escaped(child.tail or ""))
        return "".join(parts)

    for para in node:
        if para.tag != "para":
            continue
        text = re.sub(r"[ \t]+", " ", inline(para))
        text = "\n".join(line.strip() for line in text.strip().split("\n"))
        if text:
            paragraphs.append(text)
    return paragraphs


def described(node):
    return text_of(node.find("briefdescription")) + text_of(node.find("detaileddescription"))


def plain(node):
    return " ".join("".join(node.itertext()).split()) if node is not None else ""


def cell(node):
    return " ".join(" ".join(described(node)).split("\n"))


def signature(member):
    kind, name = member.get("kind"), plain(member.find("name"))
    if kind == "typedef":
        text = plain(member.find("definition"))
        return (text if "(*" in text else text + plain(member.find("argsstring"))) + ";"
    if kind == "enum":
        return f"enum {name}"
    kept = plain(member.find("type")) + " " if plain(member.find("type")) else ""
    arguments = re.sub(r" \)", ")", re.sub(r"\( ", "(", plain(member.find("argsstring"))))
    return f"{kept}{name}{arguments}".strip()


def declaration(member):
    """A struct's member; a pointer to a function has its name in the middle."""
    kind, rest = plain(member.find("type")), plain(member.find("argsstring"))
    name = plain(member.find("name"))
    return f"{kind}{name}{rest}" if "(*" in kind else f"{kind} {name}{rest}"


def tidied(text):
    """As the headers are written: `const char* text`, `std::span<const float>`."""
    text = re.sub(r" ([*&]+) ?(?=[\w.,)])", r"\1 ", text + " ")
    text = re.sub(r" ([*&]+) ", r"\1 ", text)
    text = re.sub(r" >", ">", re.sub(r"< ", "<", text)).replace("(* ", "(*").replace(") (", ")(")
    return re.sub(r"(\w)\(\*", r"\1 (*", text).strip()


def location(node):
    place = node.find("location")
    return Path(place.get("file")).name, int(place.get("line"))


def members(compound):
    return [m for section in compound.findall("sectiondef") for m in section.findall("memberdef")
            if m.get("prot") == "public"]


def table(rows, *titles):
    if not rows:
        return []
    return ["| " + " | ".join(titles) + " |", "|" + "---|" * len(titles),
            *("| " + " | ".join(row).replace("|  |", "| |") + " |" for row in rows), ""]


def entry(node):
    """One heading with a declaration, its comment, and its parts."""
    if node.tag == "compounddef":
        name = plain(node.find("compoundname"))
        kind = node.get("kind")
        out = [f"### {name}", "", *sum(([p, ""] for p in described(node)), [])]
        if kind == "struct":
            rows = [(f"`{tidied(declaration(m))}`", cell(m))
                    for m in members(node)]
            return out + table(rows, "member", "")
        rows = [(f"`{tidied(signature(m))}`".replace("|", "\\|"), cell(m)) for m in members(node)]
        return out + table(rows, "of the class", "")
    name = plain(node.find("name"))
    out = [f"### {name}", ""]
    if node.get("kind") != "enum":
        out += ["```cpp" if location(node)[0].endswith(".hpp") else "```c",
                tidied(signature(node)).rstrip(";") + ";", "```", ""]
    out += sum(([p, ""] for p in described(node)), [])
    if node.get("kind") == "enum":
        rows = [(f"`{plain(v.find('name'))}`", f"`{plain(v.find('initializer')).lstrip('= ')}`" if
                 v.find("initializer") is not None else "", cell(v)) for v in node.findall("enumvalue")]
        out += table(rows, "value", "", "")
    return out


def page(xml):
    entities = {header: [] for header in HEADERS}
    heads = {}
    for path in sorted(xml.glob("*.xml")):
        if path.name == "index.xml":
            continue
        compound = ElementTree.parse(path).getroot().find("compounddef")
        if compound is None:
            continue
        if compound.get("kind") in ("struct", "class", "union"):
            entities[location(compound)[0]].append((location(compound)[1], compound))
        elif compound.get("kind") in ("file", "namespace"):
            if compound.get("kind") == "file":
                heads[plain(compound.find("compoundname"))] = described(compound)
            for member in members(compound):
                # A struct's typedef and an include guard say nothing of their own.
                of = location(member)[0]
                name = plain(member.find("name"))
                if member.get("kind") == "typedef" and plain(member.find("type")) in (f"struct {name}", f"enum {name}"):
                    continue
                if member.get("kind") == "define" and name in (
                        "SUPPLE_H", "SUPPLE_VIEW_H", "SUPPLE_PLAYBACK_H", "SUPPLE_TRACY_H", "SUPPLE_API"):
                    continue
                if member.get("kind") == "variable" and name in HEADERS:
                    continue
                if of in entities:
                    entities[of].append((location(member)[1], member))
    lines = ["# API", "", "Made from the comments of the public headers by `tools/api_docs.py`; change it there.", ""]
    for header in HEADERS:
        text = (INCLUDE / header).read_text()
        banners = [(number, BANNER.search(line)[1]) for number, line in enumerate(text.split("\n"), 1)
                   if BANNER.search(line)]
        lines += [f"## {header}", "", *sum(([p, ""] for p in heads.get(header, [])), [])]
        seen, constants = set(), []
        for number, node in sorted(entities[header], key=lambda e: e[0]):
            if node.get("id") in seen:
                continue
            seen.add(node.get("id"))
            if node.get("kind") == "define":
                constants.append((f"`{plain(node.find('name'))}`", f"`{plain(node.find('initializer'))}`", cell(node)))
                continue
            lines += table(constants, "constant", "", "")
            constants = []
            while banners and banners[0][0] < number - 1: # the file's comment has grown by a line
                lines += [f"## {header}: {banners.pop(0)[1]}", ""]
            lines += entry(node)
        lines += table(constants, "constant", "", "")
    text = "\n".join(lines)
    return re.sub(r"\n{3,}", "\n\n", text).strip() + "\n"


def functions():
    """Every function of the C headers, read without doxygen."""
    found = re.findall(r"^SUPPLE_API [\w *]+\b(supple\w+)\(", "\n".join(
        (INCLUDE / header).read_text() for header in HEADERS if header.endswith(".h")), re.M)
    if not found:
        sys.exit("api_docs.py no longer finds the functions of the headers")
    return set(found)


def accepted():
    if not UNDOCUMENTED.exists():
        return set()
    return {line for line in UNDOCUMENTED.read_text().splitlines() if line and not line.startswith("#")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", nargs="?", type=Path, default=PAGE)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--accept", action="store_true")
    parser.add_argument("--filter", metavar="FILE")
    arguments = parser.parse_args()
    if arguments.filter:
        path = Path(arguments.filter)
        sys.stdout.write(filtered(path.read_text(), path.name))
        return
    with tempfile.TemporaryDirectory() as directory:
        xml, warnings = run_doxygen(directory)
        text = page(xml)
    undocumented, others = split_warnings(warnings)
    if arguments.accept:
        UNDOCUMENTED.parent.mkdir(parents=True, exist_ok=True)
        UNDOCUMENTED.write_text("# Names whose name says it all. tools/api_docs.py --accept writes this list.\n" +
                                "".join(f"{name}\n" for name in sorted(undocumented)))
        return
    if not arguments.check:
        arguments.page.parent.mkdir(parents=True, exist_ok=True)
        arguments.page.write_text(text)
        print("\n".join(others), end="")
        print(arguments.page)
        return
    failures = [f"doxygen: {line}" for line in others]
    failures += [f"without a comment: {name}" for name in sorted(undocumented - accepted())]
    failures += [f"not on the page: {name}" for name in sorted(functions() - set(re.findall(r"^### (\w+)$", text, re.M)))]
    for failure in failures:
        print(failure)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
