// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/ledger.h>

#include <gtest/gtest.h>

#include <limits>

using namespace graupel;

TEST(Ledger, KeepsTheWorstOfEither)
{
  Ledger ledger;
  ledger.record(1e-9, -3e-9, 0.);
  ledger.record(-2e-9, 1e-9, 4e-9);
  ledger.record(0., 0., 0.);
  EXPECT_EQ(ledger.max_mass_imbalance, 2e-9);
  EXPECT_EQ(ledger.max_momentum_imbalance, 3e-9);
  EXPECT_EQ(ledger.max_solid_volume_error, 4e-9);
}

TEST(Ledger, NaNIsLoudAndStays)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Ledger       ledger;
  ledger.record(1e-9, 1e-9, 1e-9);
  EXPECT_THROW(ledger.record(2e-9, nan, 2e-9), std::runtime_error);
  ledger.record(1e-9, 5e-9, 1e-9);
  EXPECT_EQ(ledger.max_mass_imbalance, 2e-9);
  EXPECT_TRUE(std::isnan(ledger.max_momentum_imbalance));
  EXPECT_EQ(ledger.max_solid_volume_error, 2e-9);

  EXPECT_THROW(ledger.record(0., 0., std::numeric_limits<double>::infinity()),
               std::runtime_error);
}

TEST(Ledger, NamesTheQuantity)
{
  Ledger ledger;
  try
    {
      ledger.record(0., 0., std::numeric_limits<double>::quiet_NaN());
      ADD_FAILURE() << "a NaN passed";
    }
  catch (const std::runtime_error &error)
    {
      EXPECT_NE(std::string(error.what()).find("solid volume error = nan"),
                std::string::npos)
        << error.what();
    }
}
