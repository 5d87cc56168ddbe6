// The headers that the tests need and that cost most to compile.
#include "../source/precompiled.h"

#include <gtest/gtest.h>
