# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The parameters of the program, from what graupel --print-parameters=json prints."""

import json
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


def read_parameters(tree, section=""):
    """All parameters in what the program prints as JSON, in its order."""
    parameters = []
    for name, entry in tree.items():
        if "documentation" in entry:
            meaning = " ".join(entry["documentation"].split())
            parameters.append(Parameter(section, name, entry["value"], meaning))
        else:
            parameters += read_parameters(entry, f"{section}/{name}" if section else name)
    return parameters


def parameters_of(program):
    """All parameters of a binary."""
    printed = subprocess.run(
        [str(program), "--print-parameters=json"],
        env=environment(), capture_output=True, text=True, check=True,
    ).stdout  # fmt: skip
    return read_parameters(json.loads(printed))
