# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""The mutants that scripts/mutate makes of a text: what is changed, and what is not."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "scripts"))

from mutation_parts.mutants import applied, mutants  # noqa: E402

TEXT = """\
#include <x> // a + b
// a + b < 1
namespace graupel
{
  /** a * b */
  template <class Real, unsigned int n = 0>
  bool
  touches(const Body &i, Real *out)
  {
    const double *p = i.at;
    *out            = -p[0] / std::max(i.radius, 2.5);
    i.sums.clear();
    if (i.distance <= 1e-3 && !i.gone)
      throw Error("it is 1 + 1: \\"a\\" && b" +
                  std::to_string(i.id - 1));
    text << "a + b" << i.id + 3;
    static_cast<void>(std::numeric_limits<double>::max());
    Triple<Lanes, 3> t(
      sum(7));
    return p;
  }
} // namespace graupel
"""
# Line, and what the line has become; in the order of the lines and of the kinds.
WANTED = [
    (11, "*out            = -p[0] * std::max(i.radius, 2.5);"),
    (11, "*out            = -p[0] / std::min(i.radius, 2.5);"),
    (11, "*out            = -p[1] / std::max(i.radius, 2.5);"),
    (11, "*out            = -p[0] / std::max(i.radius, 5.0);"),
    (11, ";"),
    (12, ";"),
    (13, "if (i.distance < 1e-3 && !i.gone)"),
    (13, "if (i.distance <= 1e-3 || !i.gone)"),
    (13, "if (i.distance <= 0.002 && !i.gone)"),
    (19, "sum(14));"),
    (20, "return !(p);"),
]


class Mutants(unittest.TestCase):
    """Found in a text."""

    def test_are_those_of_code_alone(self):
        found = [(m.line, m.after.strip()) for m in mutants("file.cc", TEXT)]
        self.assertEqual(found, WANTED)

    def test_change_one_line(self):
        for mutant in mutants("file.cc", TEXT):
            changed = applied(mutant, TEXT).split("\n")
            others = [k for k, line in enumerate(TEXT.split("\n")) if line != changed[k]]
            self.assertEqual(others, [mutant.line - 1], mutant.words)


if __name__ == "__main__":
    unittest.main()
