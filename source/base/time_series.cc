// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/block_sums.h>
#include <graupel/base/time_series.h>

#include <kissfft/kissfft.hh>

#include <algorithm>
#include <cmath>

namespace graupel
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    // Parts of the time that a segment of the spectrum has.
    constexpr unsigned int segments      = 4;
    constexpr std::size_t  fewest_values = 64;
    // Steps count as even within this part of their length.
    constexpr double even = 1e-6;

    double
    mean_of(const std::vector<double> &values)
    {
      double sum = 0.;
      for (const double value : values)
        sum += value;
      return sum / values.size();
    }

    bool
    is_even(const std::vector<double> &times)
    {
      const double step = (times.back() - times.front()) / (times.size() - 1.);
      for (std::size_t k = 0; k + 1 < times.size(); ++k)
        if (std::abs(times[k + 1] - times[k] - step) > even * step)
          return false;
      return true;
    }
  } // namespace

  std::vector<double>
  evenly_spaced(const std::vector<double> &times,
                const std::vector<double> &values,
                const unsigned int         n)
  {
    if (n == values.size() && is_even(times))
      return values;
    std::vector<double> result;
    std::size_t         right = 1;
    for (unsigned int k = 0; k < n; ++k)
      {
        const double t = times.front() + (times.back() - times.front()) * k / (n - 1.);
        while (right + 1 < times.size() && times[right] < t)
          ++right;
        const double part = (t - times[right - 1]) / (times[right] - times[right - 1]);
        result.push_back(values[right - 1] + part * (values[right] - values[right - 1]));
      }
    return result;
  }

  std::optional<double>
  error_of_mean(const std::vector<double> &values)
  {
    BlockSums blocks;
    for (const double value : values)
      blocks.add(value, 1.);
    return blocks.error_of_mean();
  }

  Spectrum
  power_spectrum(const std::vector<double> &values, const double interval)
  {
    const double      mean = mean_of(values);
    const std::size_t n    = values.size() / segments;
    Spectrum          result;
    double            square = 0.; // of the window
    for (std::size_t k = 1; k <= n / 2; ++k)
      result.frequency.push_back(k / (n * interval));
    result.density.assign(n / 2, 0.);
    std::vector<double> window;
    for (std::size_t k = 0; k < n; ++k)
      {
        window.push_back(0.5 - 0.5 * std::cos(2. * pi * k / n));
        square += window.back() * window.back();
      }
    const kissfft<double>             fourier(n, false);
    std::vector<std::complex<double>> part(n), waves(n);
    const std::size_t                 n_segments = 2 * segments - 1;
    for (std::size_t segment = 0; segment < n_segments; ++segment)
      {
        for (std::size_t k = 0; k < n; ++k)
          part[k] = window[k] * (values[segment * n / 2 + k] - mean);
        fourier.transform(part.data(), waves.data());
        for (std::size_t k = 1; k <= n / 2; ++k)
          // Its negative twin, which the highest frequency does not have, counts too.
          result.density[k - 1] +=
            (k < n / 2 ? 2. : 1.) * std::norm(waves[k]) * interval / square / n_segments;
      }
    return result;
  }

  Spectrum
  power_spectrum(const std::vector<double> &times, const std::vector<double> &values)
  {
    if (values.size() < fewest_values)
      return {};
    std::size_t n = fewest_values;
    while (n < values.size())
      n *= 2;
    return power_spectrum(evenly_spaced(times, values, n),
                          (times.back() - times.front()) / (n - 1.));
  }

  std::optional<double>
  dominant_frequency(const Spectrum &spectrum)
  {
    const auto &density = spectrum.density;
    const auto  k = std::max_element(density.begin(), density.end()) - density.begin();
    const auto  n = static_cast<std::ptrdiff_t>(density.size());
    if (k < 1 || k + 1 >= n || !(density[k - 1] > 0.) || !(density[k + 1] > 0.))
      return {};
    const double left = std::log(density[k - 1]), middle = std::log(density[k]),
                 right = std::log(density[k + 1]);
    const double shift = 0.5 * (left - right) / (left - 2. * middle + right);
    return spectrum.frequency[0] * (k + 1 + shift);
  }
} // namespace graupel
