# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Reads study.csv, the table of a refinement study."""

import csv

from .run import as_number

TEXTS = ("quantity", "status")


def read_study(path):
    """The rows of study.csv in the order of the file, each a dictionary of its columns:
    numbers, or None where there is none, and texts. Sizes are in metres and seconds, each
    value in the unit that its quantity names."""
    with open(path, newline="", encoding="utf-8") as file:
        return [
            {key: value if key in TEXTS else as_number(value) for key, value in row.items()}
            for row in csv.DictReader(file)
        ]
