# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Report of a run, and comparison of several: figures, words, tables and the page."""
