// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flux_factors.h>

namespace graupel
{
  namespace
  {
    constexpr unsigned int nowhere = dealii::numbers::invalid_unsigned_int;

    void
    put(std::vector<float> &values, const unsigned int block, const NodeUnknowns &value)
    {
      value.copy_to(&values[4 * block], std::experimental::element_aligned);
    }
  } // namespace

  void
  FluxFactors::refresh(const NodeBlockMatrix &system)
  {
    rows.clear();
    columns.clear();
    values.clear();
    std::vector<unsigned int> place(system.n_rows(), nowhere);
    for (unsigned int row = 0; row < system.n_rows(); ++row)
      {
        Row entry;
        entry.begin = columns.size();
        for (unsigned int k = system.rows()[row]; k < system.rows()[row + 1]; ++k)
          if (system.columns()[k] < system.n_rows())
            {
              if (system.columns()[k] == row)
                entry.diagonal = columns.size();
              columns.push_back(system.columns()[k]);
              values.resize(4 * columns.size());
              put(values, columns.size() - 1, system.flux_diagonal(k));
            }
        entry.end = columns.size();
        rows.push_back(entry);
        eliminate(entry, place);
      }
  }

  void
  FluxFactors::eliminate(const Row &row, std::vector<unsigned int> &place)
  {
    for (unsigned int k = row.begin; k < row.end; ++k)
      place[columns[k]] = k;
    for (unsigned int k = row.begin; k < row.diagonal; ++k)
      {
        const Row         &above = rows[columns[k]];
        const NodeUnknowns factor =
          unknowns_of(values.data(), k) * unknowns_of(values.data(), above.diagonal);
        put(values, k, factor);
        for (unsigned int j = above.diagonal + 1; j < above.end; ++j)
          if (const unsigned int here = place[columns[j]]; here != nowhere)
            put(values,
                here,
                unknowns_of(values.data(), here) -
                  factor * unknowns_of(values.data(), j));
      }
    for (unsigned int k = row.begin; k < row.end; ++k)
      place[columns[k]] = nowhere;
    for (unsigned int i = 0; i < 3; ++i)
      values[4 * row.diagonal + i] = 1.f / values[4 * row.diagonal + i];
    values[4 * row.diagonal + 3] = 1.f;
  }

  void
  FluxFactors::solve(NodeBlockVector       &x,
                     const NodeBlockVector &b,
                     const NodeBlockVector &known) const
  {
    float *const solution = x.begin();
    // Four sums side by side, as the processor can begin the next before the last ends.
    const auto subtract =
      [&](NodeUnknowns &sum, const unsigned int begin, const unsigned int end) {
        NodeUnknowns       part[4]{0.f, 0.f, 0.f, 0.f};
        const unsigned int whole = begin + (end - begin) / 4 * 4;
        for (unsigned int k = begin; k < whole; k += 4)
          for (unsigned int i = 0; i < 4; ++i)
            part[i] +=
              unknowns_of(values.data(), k + i) * unknowns_of(solution, columns[k + i]);
        for (unsigned int k = whole; k < end; ++k)
          part[k - whole] +=
            unknowns_of(values.data(), k) * unknowns_of(solution, columns[k]);
        sum -= (part[0] + part[1]) + (part[2] + part[3]);
      };
    for (unsigned int row = 0; row < rows.size(); ++row)
      {
        NodeUnknowns sum = unknowns_of(b.begin(), row) - unknowns_of(known.begin(), row);
        sum[3]           = solution[4 * row + 3];
        subtract(sum, rows[row].begin, rows[row].diagonal);
        sum.copy_to(solution + 4 * row, std::experimental::element_aligned);
      }
    for (unsigned int row = rows.size(); row-- > 0;)
      {
        NodeUnknowns sum = unknowns_of(solution, row);
        subtract(sum, rows[row].diagonal + 1, rows[row].end);
        sum *= unknowns_of(values.data(), rows[row].diagonal);
        sum.copy_to(solution + 4 * row, std::experimental::element_aligned);
      }
  }
} // namespace graupel
