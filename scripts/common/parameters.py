"""The parameters of the program, from what graupel --print-parameters prints."""

import re
import subprocess
from dataclasses import dataclass

from .program import environment

UNIT = re.compile(r"\s*\[([^\[\]]*)\]\.$")


@dataclass
class Parameter:
    """One entry: its section ("Particles" or "Particles/Type 2"), name, default, and what the
    program says of it, the unit last in brackets if it has one."""

    section: str
    name: str
    default: str
    meaning: str

    @property
    def path(self):
        """As --set takes it."""
        return f"{self.section}/{self.name}"

    @property
    def unit(self):
        """What is in the brackets at the end, "" without any."""
        found = UNIT.search(self.meaning)
        return found.group(1) if found else ""

    @property
    def sentence(self):
        """The meaning without the unit."""
        return UNIT.sub(".", self.meaning)


def read_parameters(text):
    """All parameters in the text that the program prints, in its order."""
    parameters, sections, comment = [], [], []
    for line in map(str.strip, text.splitlines()):
        if line.startswith("#"):
            comment.append(line[1:].strip())
            continue
        if line.startswith("subsection "):
            sections.append(line[len("subsection ") :])
        elif line == "end":
            sections.pop()
        elif line.startswith("set "):
            name, default = line[len("set ") :].split("=", 1)
            meaning = " ".join(comment)
            parameters.append(
                Parameter("/".join(sections), name.strip(), default.strip(), meaning)
            )
        comment = []
    return parameters


def parameters_of(program):
    """All parameters of a binary."""
    printed = subprocess.run(
        [str(program), "--print-parameters"],
        env=environment(), capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    return read_parameters(printed)
