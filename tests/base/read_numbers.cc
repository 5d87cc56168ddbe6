// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>

#include <gtest/gtest.h>

using namespace graupel;

TEST(NumberIn, TakesTheWholeText)
{
  EXPECT_EQ(number_in("1e-3"), 1e-3);
  EXPECT_EQ(number_in(" -2.5\t"), -2.5);
  EXPECT_EQ(number_in("+4"), 4.);
  EXPECT_EQ(number_in(".5"), 0.5);
  EXPECT_EQ(number_in("7."), 7.);
  EXPECT_EQ(number_in("1E+3"), 1000.);
  for (const char *text : {"",
                           "  ",
                           "abc",
                           "1e-3m",
                           "1 2",
                           "0,5",
                           "1e",
                           "--1",
                           "+-1",
                           "++1",
                           "+ 1",
                           "0x10",
                           "nan",
                           "inf",
                           "-inf",
                           "1e400"})
    EXPECT_FALSE(number_in(text).has_value()) << text;
}

TEST(ReadNumber, NamesTheParameter)
{
  EXPECT_EQ(read_number("Particles/size list", " 0.4"), 0.4);
  try
    {
      read_number("Particles/size list", "abc");
      ADD_FAILURE() << "a word passed as a number";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(error.parameter, "Particles/size list");
      EXPECT_STREQ(error.what(), "Particles/size list: \"abc\" is not a number");
    }
}

TEST(ReadNumbers, WithBlanksBetween)
{
  EXPECT_EQ(read_numbers("Walls/planes", " 0 0  1e-2\t-1 "),
            (std::vector<double>{0., 0., 1e-2, -1.}));
  EXPECT_EQ(read_numbers("Walls/planes", " "), std::vector<double>());
  EXPECT_THROW(read_numbers("Walls/planes", "0 0 1e-2x"), InputError);
  EXPECT_THROW(read_numbers("Walls/planes", "0 nan 1"), InputError);
}

TEST(TextOf, ReadsBackToTheSameNumber)
{
  EXPECT_EQ(text_of(1. / 3.), "0.333333");
  for (const double value : {1. / 3., 6.4e-3, -2e300})
    EXPECT_EQ(number_in(text_of(value, 17)), value);
}
