// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/observers/case_averages.h>
#include <graupel/simulation/state/bytes.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <cstring>
#include <iomanip>
#include <limits>
#include <set>
#include <sstream>

namespace graupel
{
  namespace
  {
    // Less scatter than this part of the largest value is rounding and the tolerance of
    // solvers.
    constexpr double resting = 1e-6;
    // An interval counts as over when this part of it is left.
    constexpr double rounding = 1e-9;
    // Monitors whose spectra are written, beside all probes.
    const std::set<std::string> with_spectrum{
      "pressure_drop", "expanded_height", "center_of_mass"};

    struct SavedAverages
    {
      double                   last = 0., unlooked = 0.;
      std::vector<double>      times, weights, values;
      std::vector<std::string> bins; // of all grids, as bytes

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &last &unlooked &times &weights &values &bins;
      }
    };

    std::string
    bytes_of(const std::vector<BinSums> &sums)
    {
      static_assert(std::is_trivially_copyable_v<BinSums>);
      return {reinterpret_cast<const char *>(sums.data()), sums.size() * sizeof(BinSums)};
    }

    std::vector<BinSums>
    sums_of(const std::string &bytes)
    {
      std::vector<BinSums> sums(bytes.size() / sizeof(BinSums));
      std::memcpy(sums.data(), bytes.data(), bytes.size());
      return sums;
    }

    std::string
    table_of(const std::deque<BinAverages> &grids)
    {
      if (grids.empty())
        return "";
      std::string text = "name," + header(bin_quantities()) + "\n";
      for (const BinAverages &grid : grids)
        text += grid.rows();
      return text;
    }

    std::vector<const SeriesStatistics *>
    those_with_spectra(const std::vector<SeriesStatistics> &all)
    {
      std::vector<const SeriesStatistics *> chosen;
      for (std::size_t n = 0; n < all.size(); ++n)
        if (!all[n].spectrum.frequency.empty() &&
            (n >= monitors().size() || with_spectrum.count(all[n].name) > 0))
          chosen.push_back(&all[n]);
      return chosen;
    }
  } // namespace

  SeriesStatistics
  statistics_of(const std::vector<double> &times,
                const std::vector<double> &weights,
                const std::vector<double> &values)
  {
    SeriesStatistics    result;
    Moments             moments;
    std::vector<double> known_times, known;
    double              largest = 0.;
    for (std::size_t n = 0; n < values.size(); ++n)
      if (std::isfinite(values[n]))
        {
          moments.add(values[n], weights[n]);
          known_times.push_back(times[n]);
          known.push_back(values[n]);
          largest = std::max(largest, std::abs(values[n]));
        }
    result.samples = known.size();
    if (known.empty())
      return result;
    result.mean = moments.mean;
    result.rms  = moments.rms();
    if (known.size() < 2 || known.size() < values.size())
      return result;
    result.error    = error_of_mean(evenly_spaced(known_times, known, known.size()));
    result.spectrum = power_spectrum(known_times, known);
    if (*result.rms > resting * largest)
      result.frequency = dominant_frequency(result.spectrum);
    return result;
  }

  CaseAverages::CaseAverages(SimulationState &state)
    : state(state)
  {
    for (const BinGrid &grid : state.parameters.averages.line_grids())
      lines.emplace_back(grid);
    for (const BinGrid &grid : state.parameters.averages.plane_grids())
      planes.emplace_back(grid);
  }

  void
  CaseAverages::begin()
  {
    state.averages.clear();
  }

  void
  CaseAverages::record(const MonitorRow &row, const double begin, const Probes &probes)
  {
    const AveragesParameters &window = state.parameters.averages;
    const double              now    = row.time - begin;
    const double              within = window.time_within(last, now);
    last                             = now;
    if (!(within > 0.))
      return;
    times.push_back(now);
    weights.push_back(within);
    for (const double number : row.values.numbers())
      values.push_back(number);
    values.insert(values.end(), probes.values().begin(), probes.values().end());

    unlooked += within;
    if (unlooked >= window.interval * (1. - rounding) || window.has_ended(now))
      {
        look(unlooked);
        unlooked = 0.;
      }
  }

  void
  CaseAverages::look(const double duration)
  {
    if (state.fluid)
      state.averages.record(*state.fluid, duration);
    for (auto *grids : {&lines, &planes})
      for (BinAverages &grid : *grids)
        grid.record(state, duration);
  }

  double
  CaseAverages::averaged_time() const
  {
    double time = 0.;
    for (const double weight : weights)
      time += weight;
    return time;
  }

  std::vector<SeriesStatistics>
  CaseAverages::statistics() const
  {
    std::vector<SeriesStatistics> result;
    if (times.empty())
      return result;
    const std::size_t n_series = values.size() / times.size();
    const auto columns = probe_columns(read_probes(state.parameters.output.probes));
    for (std::size_t n = 0; n < n_series; ++n)
      {
        std::vector<double> series;
        for (std::size_t k = n; k < values.size(); k += n_series)
          series.push_back(values[k]);
        result.push_back(statistics_of(times, weights, series));
        const bool is_monitor = n < monitors().size();
        result.back().name =
          is_monitor ? monitors()[n].name : columns[n - monitors().size()].first;
        result.back().unit =
          is_monitor ? monitors()[n].unit : columns[n - monitors().size()].second;
      }
    return result;
  }

  std::string
  series_table(const std::vector<SeriesStatistics> &statistics)
  {
    std::string text;
    for (const SeriesStatistics &series : statistics)
      {
        text += series.name + "," + series.unit + "," + std::to_string(series.samples);
        for (const Value &value :
             {series.mean, series.rms, series.error, series.frequency})
          text += "," + cell_text(value, "");
        text += "\n";
      }
    return text.empty() ? text
                        : "quantity,unit,samples,mean,rms,error,frequency\n" + text;
  }

  std::string
  spectra_table(const std::vector<SeriesStatistics> &statistics)
  {
    const auto series = those_with_spectra(statistics);
    if (series.empty())
      return "";
    std::string text = "frequency";
    for (const SeriesStatistics *one : series)
      text += "," + one->name;
    text += "\n";
    for (std::size_t k = 0; k < series[0]->spectrum.frequency.size(); ++k)
      {
        text += cell_text(series[0]->spectrum.frequency[k], "Hz");
        for (const SeriesStatistics *one : series)
          text += "," + cell_text(one->spectrum.density[k], "");
        text += "\n";
      }
    return text;
  }

  std::string
  CaseAverages::lines_table() const
  {
    return times.empty() ? "" : table_of(lines);
  }

  std::string
  CaseAverages::planes_table() const
  {
    return times.empty() ? "" : table_of(planes);
  }

  std::string
  CaseAverages::save() const
  {
    SavedAverages saved{last, unlooked, times, weights, values, {}};
    for (const auto *grids : {&lines, &planes})
      for (const BinAverages &grid : *grids)
        saved.bins.push_back(bytes_of(grid.sums()));
    return to_bytes(saved);
  }

  void
  CaseAverages::resume(const std::string &bytes)
  {
    const auto saved = from_bytes<SavedAverages>(bytes);
    last             = saved.last;
    unlooked         = saved.unlooked;
    times            = saved.times;
    weights          = saved.weights;
    values           = saved.values;
    std::size_t n    = 0;
    for (auto *grids : {&lines, &planes})
      for (BinAverages &grid : *grids)
        grid.continue_from(sums_of(saved.bins[n++]));
  }
} // namespace graupel
