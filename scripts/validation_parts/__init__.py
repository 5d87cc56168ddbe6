# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""What scripts/validate is made of: cases, their runs, and the page of figures."""

import common  # noqa: F401, so that the module graupel is found
