// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/convergence.h>
#include <graupel/simulation/studies/study.h>

#include <algorithm>

namespace graupel
{
  namespace
  {
    // What is measured: by the first level that has succeeded.
    std::vector<Measurement>
    quantities_of(const std::vector<LevelResult> &levels)
    {
      for (const LevelResult &level : levels)
        if (!level.measurements.empty())
          {
            auto quantities = level.measurements;
            for (Measurement &quantity : quantities)
              {
                quantity.value          = {};
                quantity.standard_error = 0.;
              }
            return quantities;
          }
      return {{"", {}}}; // a row a level tells that it has failed
    }

    const Measurement *
    find(const LevelResult &level, const std::string &quantity)
    {
      for (const Measurement &measured : level.measurements)
        if (measured.quantity == quantity)
          return &measured;
      return nullptr;
    }

    // The level's row of that quantity, without a value if it has none.
    StudyRow
    row_of(const Measurement              &quantity,
           const std::vector<LevelResult> &levels,
           const unsigned int              level)
    {
      StudyRow row{level + 1, levels[level], quantity, {}, {}, {}, false};
      if (const Measurement *measured = find(levels[level], quantity.quantity))
        row.measurement = *measured;
      return row;
    }

    std::optional<double>
    relative_change(const double from, const double to)
    {
      if (to == 0.)
        return {};
      return (to - from) / std::abs(to);
    }

    // What the last of some neighbouring computations tells with those before it.
    void
    add_convergence(StudyRow &row, const std::vector<Computation> &computed)
    {
      const unsigned int n        = computed.size();
      const auto         from_end = [&](const unsigned int back) {
        return computed[n - 1 - back];
      };
      if (row.measurement.is_error)
        {
          row.error_or_change = row.measurement.value;
          if (n >= 2)
            row.observed_order = observed_order(from_end(0), from_end(1));
          return;
        }
      if (n >= 2)
        row.error_or_change = relative_change(from_end(1).value, from_end(0).value);
      if (n >= 3 && from_end(0).size < from_end(1).size &&
          from_end(1).size < from_end(2).size)
        {
          const auto convergence =
            grid_convergence(from_end(0), from_end(1), from_end(2));
          row.observed_order = convergence.order;
          row.extrapolated   = convergence.extrapolated;
          row.index          = convergence.index;
          row.oscillates     = convergence.oscillates;
        }
    }
  } // namespace

  std::vector<StudyRow>
  evaluate_study(const std::vector<LevelResult> &levels, const std::vector<double> &sizes)
  {
    std::vector<StudyRow> rows;
    for (const Measurement &quantity : quantities_of(levels))
      {
        std::vector<Computation> computed; // neighbours, up to this level
        for (unsigned int level = 0; level < levels.size(); ++level)
          {
            StudyRow row = row_of(quantity, levels, level);
            if (row.measurement.value)
              {
                computed.push_back({sizes[level], *row.measurement.value});
                add_convergence(row, computed);
              }
            else
              computed.clear();
            rows.push_back(row);
          }
      }
    return rows;
  }

  namespace
  {
    // What the levels up to the last one that are not parted by a hole have of a
    // quantity.
    struct Ladder
    {
      std::vector<Computation> values; // by scale
      std::vector<double>      errors;
    };

    Ladder
    ladder_of(const std::string              &quantity,
              const std::vector<LevelResult> &levels,
              const unsigned int              last)
    {
      Ladder ladder;
      for (unsigned int level = 0; level <= last; ++level)
        {
          const Measurement *measured = find(levels[level], quantity);
          if (!measured || !measured->value)
            {
              ladder = {};
              continue;
            }
          ladder.values.push_back({levels[level].scale, *measured->value});
          ladder.errors.push_back(measured->standard_error);
        }
      return ladder;
    }

    // From three levels on.
    std::optional<Estimate>
    at_scale_one(const Measurement              &quantity,
                 const std::vector<LevelResult> &levels,
                 const unsigned int              last)
    {
      const Ladder ladder = ladder_of(quantity.quantity, levels, last);
      if (ladder.values.size() < 3)
        return {};
      if (quantity.at_scale_one == AtScaleOne::mean)
        return ladder.values.back().size == 1.
                 ? Estimate{ladder.values.back().value, ladder.errors.back()}
                 : mean_at(ladder.values, ladder.errors, 1.);
      if (quantity.at_scale_one == AtScaleOne::polynomial)
        return extrapolate(ladder.values, ladder.errors, 1.);
      Estimate result{1., 0.};
      for (const std::string &name : quantity.factors)
        {
          const Measurement *factor = find(levels[last], name);
          const auto         estimate =
            factor ? at_scale_one(*factor, levels, last) : std::nullopt;
          if (!estimate)
            return {};
          result = product(result, *estimate);
        }
      return result;
    }
  } // namespace

  std::vector<StudyRow>
  evaluate_ladder(const std::vector<LevelResult> &levels)
  {
    std::vector<StudyRow> rows;
    for (const Measurement &quantity : quantities_of(levels))
      for (unsigned int level = 0; level < levels.size(); ++level)
        {
          StudyRow row = row_of(quantity, levels, level);
          if (row.measurement.value)
            {
              const auto values = ladder_of(quantity.quantity, levels, level).values;
              if (values.size() >= 2)
                row.error_or_change =
                  relative_change(values[values.size() - 2].value, values.back().value);
              if (const auto at_one = at_scale_one(row.measurement, levels, level))
                {
                  row.extrapolated = at_one->value;
                  if (at_one->value != 0.)
                    row.index = at_one->error / std::abs(at_one->value);
                }
            }
          rows.push_back(row);
        }
    return rows;
  }

  LevelResult
  mean_of(const std::vector<LevelResult> &repetitions)
  {
    const double n      = repetitions.size();
    LevelResult  result = repetitions.at(0);
    for (unsigned int m = 0; m < result.measurements.size(); ++m)
      {
        const bool all_known =
          std::all_of(repetitions.begin(), repetitions.end(), [m](const auto &one) {
            return one.measurements[m].value.has_value();
          });
        result.measurements[m].value          = {};
        result.measurements[m].standard_error = 0.;
        if (!all_known)
          continue;
        double sum = 0., squares = 0.;
        for (const LevelResult &one : repetitions)
          sum += *one.measurements[m].value;
        for (const LevelResult &one : repetitions)
          squares += std::pow(*one.measurements[m].value - sum / n, 2);
        result.measurements[m].value = sum / n;
        if (n > 1.)
          result.measurements[m].standard_error = std::sqrt(squares / (n - 1.) / n);
      }
    return result;
  }
} // namespace graupel
