# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What scripts/mutate is made of: the mutants of a text, and a tree in which they are tried."""
