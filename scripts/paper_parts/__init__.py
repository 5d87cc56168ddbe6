# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What scripts/paper.py makes doc/paper/ of."""
