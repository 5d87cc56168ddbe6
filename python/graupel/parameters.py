# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Reads parameters.prm, in which a run writes down every parameter with its value."""


def read_parameters(path):
    """Texts of the parameters by path, as in {"Flow/time step": "1e-2"}, in the order of the
    file."""
    texts, sections = {}, []
    with open(path, encoding="utf-8") as file:
        for line in file:
            line = line.split("#")[0].strip()
            word, _, rest = line.partition(" ")
            if word == "subsection":
                sections.append(rest.strip())
            elif word == "end" and sections:
                sections.pop()
            elif word == "set":
                name, _, value = rest.partition("=")
                texts["/".join([*sections, name.strip()])] = value.strip()
    return texts
