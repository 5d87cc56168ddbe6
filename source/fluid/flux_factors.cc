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
    std::vector<float>        entries;
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
              entries.resize(4 * columns.size());
              put(entries, columns.size() - 1, system.flux_diagonal(k));
            }
        entry.end = columns.size();
        rows.push_back(entry);
        eliminate(entry, place, entries);
      }
    for (unsigned int i = 0; i < 3; ++i)
      {
        values[i].resize(columns.size());
        for (std::size_t k = 0; k < columns.size(); ++k)
          values[i][k] = entries[4 * k + i];
      }
  }

  void
  FluxFactors::eliminate(const Row                 &row,
                         std::vector<unsigned int> &place,
                         std::vector<float>        &entries) const
  {
    for (unsigned int k = row.begin; k < row.end; ++k)
      place[columns[k]] = k;
    for (unsigned int k = row.begin; k < row.diagonal; ++k)
      {
        const Row         &above = rows[columns[k]];
        const NodeUnknowns factor =
          unknowns_of(entries.data(), k) * unknowns_of(entries.data(), above.diagonal);
        put(entries, k, factor);
        for (unsigned int j = above.diagonal + 1; j < above.end; ++j)
          if (const unsigned int here = place[columns[j]]; here != nowhere)
            put(entries,
                here,
                unknowns_of(entries.data(), here) -
                  factor * unknowns_of(entries.data(), j));
      }
    for (unsigned int k = row.begin; k < row.end; ++k)
      place[columns[k]] = nowhere;
    for (unsigned int i = 0; i < 3; ++i)
      entries[4 * row.diagonal + i] = 1.f / entries[4 * row.diagonal + i];
    entries[4 * row.diagonal + 3] = 1.f;
  }

  void
  FluxFactors::solve(NodeValues            &x,
                     const NodeBlockVector &b,
                     const NodeBlockVector &known,
                     const unsigned int     component) const
  {
    float *const       solution = x.begin();
    const float *const entries  = values[component].data();
    const auto         product  = [&](const unsigned int begin, const unsigned int end) {
      return row_product(entries + begin, &columns[begin], solution, end - begin);
    };
    for (unsigned int row = 0; row < rows.size(); ++row)
      solution[row] = b.local_element(4 * row + component) -
                      known.local_element(4 * row + component) -
                      product(rows[row].begin, rows[row].diagonal);
    for (unsigned int row = rows.size(); row-- > 0;)
      solution[row] = (solution[row] - product(rows[row].diagonal + 1, rows[row].end)) *
                      entries[rows[row].diagonal];
  }
} // namespace graupel
