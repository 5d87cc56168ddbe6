// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

// The headers that the tests need and that cost most to compile.
#include "../source/precompiled.h"

#include <gtest/gtest.h>
