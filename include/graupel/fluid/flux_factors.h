#ifndef graupel_fluid_flux_factors_h
#define graupel_fluid_flux_factors_h

#include <graupel/fluid/node_blocks.h>

namespace graupel
{
  /**
   * Incomplete factors LU of the flux's block A without fill-in, by blocks of 3 x 3 of
   * pairs of this rank's nodes.
   * Source: Saad, Iterative Methods for Sparse Linear Systems (2003), ch. 10.
   */
  class FluxFactors
  {
  public:
    void refresh(const NodeBlockMatrix &system);

    /** The flux of each node in @p values becomes (LU)^-1 of it; pressures stay. */
    void solve(NodeBlockVector &values) const;

  private:
    using Block = std::array<NodeUnknowns, 3>; // by column

    // Where a row's blocks are: of L, whose diagonal is 1, and of U.
    struct Row
    {
      unsigned int begin, diagonal, end;
    };

    void  eliminate(const Row &row, std::vector<unsigned int> &place);
    Block block(const unsigned int number) const;
    void  put(const unsigned int number, const Block &block);

    std::vector<Row>          rows;
    std::vector<unsigned int> columns;
    std::vector<float>        values; // those on the diagonal are inverted
  };
} // namespace graupel

#endif
