# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Mutants: all ways to change one line of C++ so that a test should notice."""

import re
from dataclasses import dataclass

# What is exchanged for what, each way. clang-format puts spaces around operators of two
# operands and nowhere else, so that brackets of templates, pointers and signs stay.
EXCHANGES = (
    (r"(?<= )\+(?=\s)", "-"), (r"(?<= )-(?=\s)", "+"), (r"(?<= )\+=(?=\s)", "-="),
    (r"(?<= )-=(?=\s)", "+="), (r"(?<= )\*(?=\s)", "/"), (r"(?<= )/(?=\s)", "*"),
    (r"(?<= )<(?=\s)", "<="), (r"(?<= )<=(?=\s)", "<"), (r"(?<= )>(?=\s)", ">="),
    (r"(?<= )>=(?=\s)", ">"), (r"(?<= )==(?=\s)", "!="), (r"(?<= )!=(?=\s)", "=="),
    (r"(?<= )&&(?=\s)", "||"), (r"(?<= )\|\|(?=\s)", "&&"), (r"\bmin(?=\([^)])", "max"),
    (r"\bmax(?=\([^)])", "min"), (r"\btrue\b", "false"), (r"\bfalse\b", "true"),
)  # fmt: skip
# A constant, but not one of a template's arguments.
CONSTANT = re.compile(r"(?<![\w.<])(\d+\.?\d*(?:e[-+]?\d+)?)(?![\w.>])")
# Comments, and strings and characters, which hold what is not code.
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.DOTALL)
# Lines of the preprocessor and of text that is written, statements that say what is wrong,
# functions without a body here, and template heads.
NO_MUTANTS = re.compile(
    r"^[ \t]*#[^\n]*|^[^\n]* <<(?: [^\n]*)?$|\b(?:throw|Assert\w*|static_assert)\b[^;]*;"
    r"|\bvirtual\b[^;{]*;|\btemplate <[^\n]*",
    re.MULTILINE,
)
# Statements that do something: assignments and calls, on one line.
STATEMENT = re.compile(
    r"^\s+(?:\+\+|--)?\*?[A-Za-z_][\w:]*(?:(?:\.|->)\w+|\[[^\]]*\]|\([^()]*\))*"
    r"\s*(?:[-+*/|&]?= .*|\(.*\)|)(?<!\bbreak)(?<!\bcontinue)(?<!\breturn);$"
)
RETURN = re.compile(r"^(\s+return )(.+);$")
# The head of a function that returns a truth, up to its body.
TRUTH = re.compile(r"\n *(?:(?:static|inline|constexpr|virtual) )*bool\n[^;{}]*\{")


@dataclass(frozen=True)
class Mutant:
    """One line of one file, changed."""

    file: str
    """Below the root."""
    line: int
    """Counted from 1."""
    before: str
    after: str

    @property
    def words(self):
        """What it does to the code, on one line."""
        return f"{self.before.strip()}  ->  {self.after.strip()}"


def blank(match):
    """Spaces in place of what was found; lines stay lines."""
    return re.sub(r"[^\n]", " ", match[0])


def code_of(text):
    """The text with everything blank that is no code to be changed."""
    quoted = NOT_CODE.sub(lambda match: '"' + blank(match)[2:] + '"' if match[0][0] in "\"'"
                          else blank(match), text)  # fmt: skip
    return NO_MUTANTS.sub(blank, quoted)


def lines_of_truths(code):
    """The numbers of the lines, from 0, in functions that return a truth."""
    lines = set()
    for head in TRUTH.finditer(code):
        depth, at = 1, head.end()
        while depth and at < len(code):
            depth += {"{": 1, "}": -1}.get(code[at], 0)
            at += 1
        lines |= set(range(code.count("\n", 0, head.end()), code.count("\n", 0, at)))
    return lines


def other_constant(text):
    """0 becomes 1, x becomes 2x."""
    value = float(text)
    if "." not in text and "e" not in text:
        return str(int(value) * 2 or 1)
    return repr(value * 2.0 or 1.0)


def begins_statement(code_lines, k):
    """Whether line k is not the rest of the one before."""
    before = next((line.strip() for line in reversed(code_lines[:k]) if line.strip()), "")
    return before.endswith((";", "{", "}", ")", "else", ":"))


def changes(code_lines, k, in_truth):
    """Where line k can be changed and to what: (begin, end, other text)."""
    code = code_lines[k]
    for pattern, other in EXCHANGES:
        for found in re.finditer(pattern, code + " "):
            yield *found.span(), other
    for found in CONSTANT.finditer(code):
        yield *found.span(), other_constant(found[1])
    if in_truth and (found := RETURN.match(code)):
        yield found.start(2), found.end(2), None
    if STATEMENT.match(code) and "const " not in code and begins_statement(code_lines, k):
        yield len(code) - len(code.lstrip()), len(code) - 1, ""


def mutants(file, text):
    """All of one file, in the order of its lines."""
    code = code_of(text)
    truths, code_lines = lines_of_truths(code), code.split("\n")
    found = []
    for k, line in enumerate(text.split("\n")):
        for begin, end, other in changes(code_lines, k, k in truths):
            if other is None:
                other = f"!({line[begin:end]})"
            found.append(Mutant(file, k + 1, line, line[:begin] + other + line[end:]))
    return found


def applied(mutant, text):
    """The text of the file with the mutant in it."""
    lines = text.split("\n")
    assert lines[mutant.line - 1] == mutant.before
    lines[mutant.line - 1] = mutant.after
    return "\n".join(lines)
