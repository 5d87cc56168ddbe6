#ifndef graupel_mesh_cell_order_h
#define graupel_mesh_cell_order_h

#include <algorithm>
#include <vector>

namespace graupel
{
  /**
   * The active cells of @p mesh, a triangulation or a DoFHandler, that this rank owns, in
   * the order of their CellIds: by coarse cell and its children, however the mesh came to
   * be what it is. The library's own order is another after a mesh was read or divided
   * anew, and with it the rounding of every sum over cells.
   */
  template <class Mesh>
  std::vector<typename Mesh::active_cell_iterator>
  owned_cells(const Mesh &mesh)
  {
    std::vector<typename Mesh::active_cell_iterator> cells;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        cells.push_back(cell);
    std::sort(cells.begin(), cells.end(), [](const auto &a, const auto &b) {
      return a->id() < b->id();
    });
    return cells;
  }
} // namespace graupel

#endif
