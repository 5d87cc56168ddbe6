#include <graupel/coupling/particle_transfer.h>

namespace graupel
{
  ParticleTransfer::ParticleTransfer(const NodalSpace &nodes)
    : nodes(nodes)
  {
  }

  void
  ParticleTransfer::update(const ParticleStore &store)
  {
    cells.clear();
    weights.clear();
    variance.clear();
    const auto &partitioner = *nodes.measure().get_partitioner();
    store.visit_cells([&](const auto                          &cell,
                          const unsigned int                   first_row,
                          const std::vector<dealii::Point<3>> &locations) {
      Cell entry;
      entry.first_row = first_row;
      entry.end_row   = first_row + locations.size();
      entry.nodes.resize(n_nodes);
      const typename dealii::DoFHandler<3>::active_cell_iterator dof_cell(
        &nodes.dof_handler.get_triangulation(),
        cell->level(),
        cell->index(),
        &nodes.dof_handler);
      dof_cell->get_dof_indices(entry.nodes);
      for (unsigned int a = 0; a < n_nodes; ++a)
        entry.local_nodes[a] = partitioner.global_to_local(entry.nodes[a]);
      cells.push_back(entry);

      weights.resize(std::max<std::size_t>(weights.size(), entry.end_row));
      variance.resize(weights.size());
      for (unsigned int p = 0; p < locations.size(); ++p)
        {
          dealii::Tensor<1, 3> mean;
          double               square = 0.;
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              const double weight = nodes.fe.shape_value(a, locations[p]);
              const auto   offset = dof_cell->vertex(a) - dof_cell->vertex(0);
              mean += weight * offset;
              square += weight * offset.norm_square();
              weights[first_row + p][a] = weight;
            }
          variance[first_row + p] = square - mean.norm_square();
        }
    });
  }

  void
  ParticleTransfer::deposit(NodalVector &sums, const std::vector<double> &values) const
  {
    AssertDimension(values.size(), weights.size());
    sums = 0.;
    sums.zero_out_ghost_values();
    dealii::Vector<double> local(n_nodes);
    for (const Cell &cell : cells)
      {
        local = 0.;
        for (unsigned int row = cell.first_row; row < cell.end_row; ++row)
          for (unsigned int a = 0; a < n_nodes; ++a)
            local[a] += weights[row][a] * values[row];
        nodes.hanging_nodes.distribute_local_to_global(local, cell.nodes, sums);
      }
    sums.compress(dealii::VectorOperation::add);
  }

  void
  ParticleTransfer::sample(std::vector<double> &values, const NodalVector &field) const
  {
    values.assign(weights.size(), 0.);
    for (const Cell &cell : cells)
      for (unsigned int row = cell.first_row; row < cell.end_row; ++row)
        for (unsigned int a = 0; a < n_nodes; ++a)
          values[row] += weights[row][a] * field.local_element(cell.local_nodes[a]);
  }
} // namespace graupel
