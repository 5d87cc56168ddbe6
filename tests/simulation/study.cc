#include <graupel/simulation/study.h>

#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  LevelResult
  level(const double scale, const double value)
  {
    LevelResult result;
    result.scale        = scale;
    result.measurements = {{"pressure drop", value}};
    return result;
  }
} // namespace

TEST(Study, RepeatedLevelsGiveMeanAndStandardError)
{
  const auto mean = mean_of({level(2., 10.), level(2., 12.), level(2., 14.)});
  EXPECT_DOUBLE_EQ(mean.measurements[0].value, 12.);
  EXPECT_DOUBLE_EQ(mean.measurements[0].standard_error, 2. / std::sqrt(3.));
  EXPECT_DOUBLE_EQ(mean_of({level(2., 10.)}).measurements[0].standard_error, 0.);
}

TEST(Study, LadderEndsAtScaleOne)
{
  const auto value = [](const double s) { return 500. - 60. * s - 3. * s * s; };
  const auto rows =
    evaluate_ladder({level(4., value(4.)), level(3., value(3.)), level(2., value(2.))});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_FALSE(rows[1].extrapolated);
  ASSERT_TRUE(rows[2].extrapolated && rows[2].index);
  EXPECT_NEAR(*rows[2].extrapolated, value(1.), 1e-10);
  // The line through the two smallest scales misses it by 3 (1 - 2) (1 - 3).
  EXPECT_NEAR(*rows[2].index, 1.25 * 6. / value(1.), 1e-12);
}
