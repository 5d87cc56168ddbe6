// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/time_scheme.h>

namespace graupel
{
  TimeScheme
  bdf1(const double step)
  {
    return {1. / step, -1. / step, 0.};
  }

  TimeScheme
  bdf2(const double step, const double last_step)
  {
    const double ratio = step / last_step;
    return {(1. + 2. * ratio) / (1. + ratio) / step,
            -(1. + ratio) / step,
            ratio * ratio / (1. + ratio) / step};
  }
} // namespace graupel
