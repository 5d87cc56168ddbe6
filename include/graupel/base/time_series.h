// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_time_series_h
#define graupel_base_time_series_h

#include <optional>
#include <vector>

namespace graupel
{
  /**
   * Values at the ascending @p times, brought to @p n evenly spaced moments from the
   * first to the last, linear between them; as they are if they are that already. Both at
   * least two.
   */
  std::vector<double> evenly_spaced(const std::vector<double> &times,
                                    const std::vector<double> &values,
                                    const unsigned int         n);

  /** Standard error of the mean of evenly spaced @p values that hang together over some
   * time: BlockSums::error_of_mean(). */
  std::optional<double> error_of_mean(const std::vector<double> &values);

  /** Power of a quantity by frequency. */
  struct Spectrum
  {
    /** Ascending, evenly spaced, without 0 [Hz]. */
    std::vector<double> frequency;
    /** One-sided power spectral density: its integral is the mean squared distance from
     * the mean [square of the quantity's unit / Hz]. */
    std::vector<double> density;
  };

  /**
   * The spectrum of evenly spaced @p values, @p interval [s] apart, a power of two of
   * them, at least 64: mean over seven segments of a quarter of the time that overlap by
   * half, each under Hann's window.
   *
   * Source: Welch (1967), doi:10.1109/TAU.1967.1161901.
   */
  Spectrum power_spectrum(const std::vector<double> &values, const double interval);

  /** The same of values at any ascending times; empty for fewer than 64 values. */
  Spectrum power_spectrum(const std::vector<double> &times,
                          const std::vector<double> &values);

  /**
   * Where a spectrum is highest, by a parabola through the logarithms of three densities
   * [Hz]. Nothing if that is slower than two periods in a segment (a drift), and without
   * a density.
   */
  std::optional<double> dominant_frequency(const Spectrum &spectrum);
} // namespace graupel

#endif
