// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/block_sums.h>
#include <graupel/base/moments.h>
#include <graupel/base/time_series.h>

#include <gtest/gtest.h>

#include <random>

using namespace graupel;

namespace
{
  constexpr double pi = 3.14159265358979323846;

  // A chain whose neighbours correlate by @p memory, of variance 1.
  std::vector<double>
  chain(const double memory, const unsigned int n)
  {
    std::mt19937                     random(7);
    std::normal_distribution<double> normal;
    std::vector<double>              values{normal(random)};
    while (values.size() < n)
      values.push_back(memory * values.back() +
                       std::sqrt(1. - memory * memory) * normal(random));
    return values;
  }

  double
  variance(const std::vector<double> &values)
  {
    Moments moments;
    for (const double value : values)
      moments.add(value, 1.);
    return moments.rms() * moments.rms();
  }
} // namespace

// Law: weighted mean and rms of 1 and 4 with the weights 2 and 1. Rounding, also with a
// large number in front that sums of squares would lose all digits to.
TEST(Moments, AreTheWeightedOnesWhateverIsInFront)
{
  for (const double level : {0., 1e8})
    {
      Moments moments;
      moments.add(level + 1., 2.);
      moments.add(level + 4., 1.);
      EXPECT_NEAR(moments.mean - level, 2., 1e-15 * (level + 1.));
      EXPECT_NEAR(moments.rms(), std::sqrt(2.), 1e-7);
      EXPECT_EQ(moments.weight, 3.);
    }
  EXPECT_EQ(Moments().rms(), 0.);
}

// Law: steps of any length give a straight line back.
TEST(EvenlySpaced, KeepsALineAndWhatIsEven)
{
  const std::vector<double> times{0., 0.1, 0.5, 0.6, 2.}, values{1., 1.2, 2., 2.2, 5.};
  const auto                even = evenly_spaced(times, values, 9);
  ASSERT_EQ(even.size(), 9u);
  for (unsigned int k = 0; k < 9; ++k)
    EXPECT_NEAR(even[k], 1. + 2. * k * 0.25, 1e-14);
  const std::vector<double> same{3., 1., 4., 1.};
  EXPECT_EQ(evenly_spaced({0., 1., 2., 3.}, same, 4), same);
}

// Law: n values of variance 1 that correlate by phi^k over k places have means of the
// variance (1 + phi)/(1 - phi)/n. Limit: three times what an estimate from the some n/100
// blocks that are left scatters by, 1/sqrt(2 n/100).
TEST(ErrorOfMean, OfCorrelatedValues)
{
  constexpr unsigned int n = 1u << 15;
  for (const double memory : {0., 0.9})
    {
      const double right = std::sqrt((1. + memory) / (1. - memory) / n);
      const auto   error = error_of_mean(chain(memory, n));
      ASSERT_TRUE(error);
      std::cout << "memory " << memory << ": " << *error << ", " << right
                << " expected\n";
      EXPECT_NEAR(*error, right, 3. / std::sqrt(2. * n / 100.) * right);
    }
}

// Law: the mean of n values of a process has the variance S(0)/n with the spectral density
// S, which is that of e over |1 - a - b|^2 for x_k = a x_{k-1} + b x_{k-2} + e. This one
// swings with a period of 20 and forgets within 20. Limit: as above; half of a period is
// where blocks scatter most, four times as much.
TEST(ErrorOfMean, OfWhatSwings)
{
  constexpr unsigned int n = 1u << 15;
  const double           a = 2. * 0.95 * std::cos(2. * pi / 20.), b = -0.95 * 0.95;
  auto                   x = chain(0., n);
  for (unsigned int k = 2; k < n; ++k)
    x[k] += a * x[k - 1] + b * x[k - 2];
  const double right = 1. / (1. - a - b) / std::sqrt(n);
  const auto   error = error_of_mean(x);
  ASSERT_TRUE(error);
  std::cout << *error << ", " << right << " expected\n";
  EXPECT_NEAR(*error, right, 3. / std::sqrt(2. * n / 100.) * right);
}

TEST(ErrorOfMean, HasNoValueWhereAllHangsTogether)
{
  std::vector<double> drift;
  for (unsigned int k = 0; k < 256; ++k)
    drift.push_back(k);
  EXPECT_FALSE(error_of_mean(drift));
  EXPECT_FALSE(error_of_mean({1., 2., 3.}));
  EXPECT_EQ(*error_of_mean(std::vector<double>(16, 3.)), 0.);
}

// Law: the mean of sums of v over a number w of particles, whose velocities scatter with
// the deviation 1 about 1000, has the variance sum w / (sum w)^2. Limit: as above.
TEST(BlockSums, OfUnequalWeights)
{
  constexpr unsigned int n = 1u << 15;
  const auto             v = chain(0., n);
  BlockSums              blocks;
  double                 particles = 0.;
  for (unsigned int k = 0; k < n; ++k)
    {
      const double w = k % 3; // none at every third look
      blocks.add(w * 1000. + std::sqrt(w) * v[k], w);
      particles += w;
    }
  const double right = 1. / std::sqrt(particles);
  ASSERT_TRUE(blocks.error_of_mean());
  EXPECT_NEAR(*blocks.error_of_mean(), right, 3. / std::sqrt(2. * n / 100.) * right);
  // Means do not scatter that are the same at each look, however many there are.
  BlockSums same;
  for (unsigned int k = 0; k < 64; ++k)
    same.add(0.3 * (k % 5), k % 5);
  EXPECT_NEAR(*same.error_of_mean(), 0., 1e-15);
}

// Laws: the integral over a spectrum is the variance, a^2/2 of a sine; white noise has
// the same density everywhere, twice its variance over the sampling rate. Limits: Hann's
// window is exact for the sine but for what it sees of its phase, per cents; noise
// scatters by 1/sqrt(7 segments x 500 frequencies), 2 %, three times.
TEST(PowerSpectrum, OfASineAndOfNoise)
{
  constexpr unsigned int n        = 4096;
  const double           interval = 1e-3;
  std::vector<double>    sine;
  for (unsigned int k = 0; k < n; ++k)
    sine.push_back(5. + 3. * std::sin(2. * pi * 37.3 * k * interval));
  for (const auto &[values, right] :
       {std::make_pair(sine, 4.5), std::make_pair(chain(0., n), 1.)})
    {
      const Spectrum spectrum = power_spectrum(values, interval);
      double         power    = 0.;
      for (const double density : spectrum.density)
        power += density * spectrum.frequency[0];
      std::cout << "power " << power << ", variance " << variance(values) << '\n';
      EXPECT_NEAR(power, right, 0.06 * right);
    }
  const Spectrum noise = power_spectrum(chain(0., n), interval);
  double         half  = 0.;
  for (std::size_t k = 0; k < noise.density.size() / 2; ++k)
    half += noise.density[k] / (noise.density.size() / 2);
  EXPECT_NEAR(half, 2. * interval, 0.06 * 2. * interval);
  EXPECT_NEAR(noise.frequency.back(), 0.5 / interval, 1e-9);
}

// Law: the frequency of a sine, to a twentieth of the spectrum's step, wherever it lies
// between two of its frequencies, also where the steps are uneven or not a power of two.
TEST(DominantFrequency, OfASine)
{
  const double interval = 2e-3, end = 2.;
  for (double frequency = 7.; frequency < 9.; frequency += 0.23)
    {
      std::vector<double> times, values;
      for (double t = 0.; t < end; t += interval * (times.size() % 3 == 0 ? 0.5 : 1.))
        {
          times.push_back(t);
          values.push_back(100. + std::sin(2. * pi * frequency * t));
        }
      const Spectrum spectrum = power_spectrum(times, values);
      const auto     found    = dominant_frequency(spectrum);
      ASSERT_TRUE(found);
      EXPECT_NEAR(*found, frequency, 0.05 * spectrum.frequency[0]);
    }
}

TEST(DominantFrequency, IsNoneOfADriftNorOfWhatRests)
{
  std::vector<double> times, drift, rest;
  for (unsigned int k = 0; k < 200; ++k)
    {
      times.push_back(k);
      drift.push_back(k);
      rest.push_back(2.);
    }
  EXPECT_FALSE(dominant_frequency(power_spectrum(times, drift)));
  EXPECT_FALSE(dominant_frequency(power_spectrum(times, rest)));
  EXPECT_FALSE(dominant_frequency(power_spectrum({0., 1.}, {0., 1.})));
}
