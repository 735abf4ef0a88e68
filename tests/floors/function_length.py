#!/usr/bin/env python3
"""Lists the functions of the library and of host/ that have more than 60 lines, from the first line of the signature to
the closing brace. Each must stand in long_functions.txt with a reason, and nothing else may: the list only shrinks.

    function_length.py [SOURCE_DIR]
"""

import os
import re
import sys

LIMIT = 60
FOLDERS = ["base", "gpu", "cage", "skinning", "surface", "runtime", "host"]
LIST = "tests/floors/long_functions.txt"

# What is blanked before braces are counted, line ends kept: comments, literals, the preprocessor's lines.
BLANKED = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Fa-f])\'(?:\\.|[^\'\\\n])+\''
    r'|^[ \t]*#(?:\\\n|[^\n])*',
    re.DOTALL | re.MULTILINE)
SCOPE = re.compile(r"\b(namespace|class|struct|union|extern)\b")
NOT_A_FUNCTION = re.compile(r"=\s*$|\benum\b|\bstatic_assert\b")


def blank(match):
    """A literal or comment without its letters, so that nothing in it is read and no line moves."""
    return re.sub(r"[^\n]", " ", match.group(0))


def function_name(header):
    """The name in front of a signature's parameters, or None where there are none."""
    angles = 0
    for i, c in enumerate(header):
        if c == "<":
            angles += 1
        elif c == ">" and header[i - 1] != "-":
            angles -= 1
        elif c == "(" and angles <= 0:
            name = re.search(r"(operator\s*\S+|~?[\w:]+)\s*$", header[:i])
            if name is not None:
                return name.group(1)
    return None


def functions(text):
    """(name, first line, number of lines) of each function of a C++ source that clang-format has laid out."""
    text = BLANKED.sub(blank, text)
    found = []
    stack = []  # for each open brace: what it is, and what stood before it
    start = 0  # of what stands before the next brace
    for match in re.finditer(r"[;{}]|\b(?:public|private|protected):", text):
        at, token = match.start(), match.group(0)
        if token == "{":
            header = text[start:at]
            kind = "block"
            if all(outer == "scope" for outer, _, _ in stack) and not NOT_A_FUNCTION.search(header):
                if header.count("(") > header.count(")"):
                    kind = "argument"
                elif function_name(header) is not None:
                    kind = "function"
                elif SCOPE.search(header):
                    kind = "scope"
            stack.append((kind, start, header))
        elif token == "}":
            kind, before, header = stack.pop()
            after = re.compile(r"\s*([,{]?)").match(text, at + 1).group(1)
            if kind == "argument" or (kind == "function" and after):  # braces within the signature, which goes on
                start = before
                continue
            if kind == "function":
                first = text.count("\n", 0, before + len(header) - len(header.lstrip())) + 1
                found.append((function_name(header), first, text.count("\n", 0, at) + 2 - first))
        start = match.end()
    if stack:
        raise ValueError("braces do not match")
    return found


def long_functions(root):
    """(file and name, first line, number of lines) of every function above the limit."""
    found = []
    for folder in FOLDERS:
        for place, _, files in sorted(os.walk(os.path.join(root, folder))):
            for name in sorted(files):
                if name.endswith((".cpp", ".h", ".hpp")):
                    path = os.path.join(place, name)
                    below = os.path.relpath(path, root).replace(os.sep, "/")
                    with open(path, encoding="utf-8") as text:
                        found += [(f"{below} {function}", first, lines)
                                  for function, first, lines in functions(text.read()) if lines > LIMIT]
    return found


def read_list(path):
    """File and name of each function that may be long; every line has a reason behind two hyphens."""
    allowed = set()
    with open(path, encoding="utf-8") as text:
        for number, line in enumerate(text, 1):
            if line.strip() and not line.startswith("#"):
                function, hyphens, reason = line.partition(" -- ")
                if not hyphens or not reason.strip():
                    raise ValueError(f"{path}:{number}: no reason")
                allowed.add(function.strip())
    return allowed


def offences(root, allowed):
    """One line for each function that is too long, and for each exception that is not needed."""
    found = long_functions(root)
    lines = [f"{function.split()[0]}:{first}: {function.split()[1]} has {count} lines, more than {LIMIT}"
             for function, first, count in found if function not in allowed]
    known = {function for function, _, _ in found}
    return lines + [f"{LIST}: {function} is not too long any more" for function in sorted(allowed - known)]


def main():
    root = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "..", ".."))
    allowed = read_list(os.path.join(root, LIST))
    lines = offences(root, allowed)
    print("\n".join(lines) if lines else f"no function has more than {LIMIT} lines but {len(allowed)} with a reason")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main())
