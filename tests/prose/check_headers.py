#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
#
# check_headers.py ROOT
#
# The first sentence of a header of the library or the command is a line of its own: "// Name: noun phrase." or "// Noun phrase.", at
# most twelve words after the name, in the terms of docs/glossary.md. A list of first lines then is a table of contents.
import pathlib
import re
import sys

LAYERS = ("kernel", "brep", "bsp", "apps", "c/sources", "python")
MOST_WORDS = 12

# What data do not do, words of docs/glossary.md that stand for something else there, and questions.
BANNED = re.compile(
    r"\b(ask(s|ed|ing)?|tell(s|ing)?|told|know(s|n|ing)?|speak(s|ing)?|nobody|somebody|anybody|who|whoever|whatever"
    r"|walls?|covers?|sheets?|peel(s|ed|ing)?|across|stretch(es)?|part(ed|ing)|doubtful|way|ways)\b|\?",
    re.IGNORECASE,
)
NO_NOUN = re.compile(r"(what|where|which|when|whether|how|why|do|does|is|are|may|can|from)\b", re.IGNORECASE)


def first_line(path):
    """The first comment line after that of the licence."""
    for line in path.read_text(encoding="utf-8").splitlines()[1:]:
        if line.startswith("//") and line.strip("/ "):
            return line.strip("/ ")
        if line and not line.startswith("//"):
            return ""
    return ""


def phrase_of(line):
    """The line without the names of what the header declares."""
    return re.sub(r"^[\w<>, ]{1,60}: ", "", line)


def problem_of(line):
    if not line:
        return "has no first comment"
    phrase = phrase_of(line)
    if not line.endswith("."):
        return "has a first sentence that does not end with its line"
    if len(phrase.split()) > MOST_WORDS:
        return f"begins with {len(phrase.split())} words"
    banned = BANNED.search(phrase)
    if banned:
        return f"begins with a line with '{banned.group(0)}'"
    noun = NO_NOUN.match(phrase)
    if noun:
        return f"begins with '{noun.group(0)}', not with a noun"
    return ""


def problems_of(root):
    for layer in LAYERS:
        for path in sorted((root / layer).rglob("*.h")):
            line = first_line(path)
            problem = problem_of(line)
            if problem:
                yield f"{path.relative_to(root)} {problem}: {line}"


def main():
    problems = list(problems_of(pathlib.Path(sys.argv[1])))
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
