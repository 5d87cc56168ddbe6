#include <graupel/fluid/flux_factors.h>

namespace graupel
{
  namespace
  {
    constexpr unsigned int nowhere = dealii::numbers::invalid_unsigned_int;

    using Block = std::array<NodeUnknowns, 3>;

    Block
    product(const Block &a, const Block &b)
    {
      Block result;
      for (unsigned int j = 0; j < 3; ++j)
        result[j] = a[0] * b[j][0] + a[1] * b[j][1] + a[2] * b[j][2];
      return result;
    }

    Block
    inverse(const Block &a)
    {
      dealii::Tensor<2, 3> entries;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          entries[i][j] = a[j][i];
      entries = invert(entries);
      Block result;
      for (unsigned int j = 0; j < 3; ++j)
        result[j] = NodeUnknowns([&](const auto i) {
          return i < 3 ? static_cast<float>(entries[i % 3][j]) : 0.f;
        });
      return result;
    }
  } // namespace

  FluxFactors::Block
  FluxFactors::block(const unsigned int number) const
  {
    const float *const begin = &values[12 * number];
    return {unknowns_of(begin, 0), unknowns_of(begin, 1), unknowns_of(begin, 2)};
  }

  void
  FluxFactors::put(const unsigned int number, const Block &block)
  {
    for (unsigned int j = 0; j < 3; ++j)
      block[j].copy_to(&values[12 * number + 4 * j], std::experimental::element_aligned);
  }

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
              Block block;
              for (unsigned int j = 0; j < 3; ++j)
                {
                  block[j]    = system.flux_column(k, j);
                  block[j][3] = 0.f;
                }
              columns.push_back(system.columns()[k]);
              values.resize(12 * columns.size());
              put(columns.size() - 1, block);
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
        const Row  &above  = rows[columns[k]];
        const Block factor = product(block(k), block(above.diagonal));
        put(k, factor);
        for (unsigned int j = above.diagonal + 1; j < above.end; ++j)
          if (const unsigned int here = place[columns[j]]; here != nowhere)
            {
              const Block change = product(factor, block(j));
              Block       value  = block(here);
              for (unsigned int i = 0; i < 3; ++i)
                value[i] -= change[i];
              put(here, value);
            }
      }
    for (unsigned int k = row.begin; k < row.end; ++k)
      place[columns[k]] = nowhere;
    put(row.diagonal, inverse(block(row.diagonal)));
  }

  void
  FluxFactors::solve(NodeBlockVector &x) const
  {
    float *const solution = x.begin();
    // By columns in sums of their own, as the processor begins the next before the last
    // ends.
    const auto subtract =
      [&](NodeUnknowns &sum, const unsigned int begin, const unsigned int end) {
        Block        part{0.f, 0.f, 0.f};
        const float *value = &values[12 * begin];
        for (unsigned int k = begin; k < end; ++k, value += 12)
          for (unsigned int j = 0; j < 3; ++j)
            part[j] += unknowns_of(value, j) * solution[4 * columns[k] + j];
        sum -= part[0] + part[1] + part[2];
      };
    for (unsigned int row = 0; row < rows.size(); ++row)
      {
        NodeUnknowns sum = unknowns_of(solution, row);
        subtract(sum, rows[row].begin, rows[row].diagonal);
        sum.copy_to(solution + 4 * row, std::experimental::element_aligned);
      }
    for (unsigned int row = rows.size(); row-- > 0;)
      {
        NodeUnknowns sum = unknowns_of(solution, row);
        subtract(sum, rows[row].diagonal + 1, rows[row].end);
        const Block  inverse  = block(rows[row].diagonal);
        NodeUnknowns flux     = inverse[0] * sum[0] + inverse[1] * sum[1] + inverse[2] * sum[2];
        flux[3]               = sum[3];
        flux.copy_to(solution + 4 * row, std::experimental::element_aligned);
      }
  }
} // namespace graupel
