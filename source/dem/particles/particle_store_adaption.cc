// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/particles/particle_store.h>

namespace graupel
{
  ParticleStore::Moves
  ParticleStore::adapt(ParticleArrays    &particles,
                       const ContactsOf  &contacts_of,
                       const unsigned int cell_weight,
                       const unsigned int particle_weight)
  {
    std::vector<unsigned int> counts(mesh.triangulation().n_active_cells(), 0);
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        counts[cell->active_cell_index()] = handler.n_particles_in_cell(cell);
    strays.clear();
    for (const auto &particle : handler)
      {
        const auto label = particle.get_properties();
        strays.push_back({particle.get_id(),
                          particle.get_location(),
                          std::vector<double>(label.begin(), label.end())});
      }
    handler.clear_particles();
    cells.clear();

    constexpr unsigned int children = 8;
    mesh.adapt([&](const dealii::Triangulation<3>::cell_iterator &cell,
                   const VesselMesh::CellStatus                   status) {
      unsigned int held = 0;
      if (status == dealii::Triangulation<3>::CELL_COARSEN)
        for (const auto &child : cell->child_iterators())
          held += counts[child->active_cell_index()];
      else
        held = counts[cell->active_cell_index()];
      if (status == dealii::Triangulation<3>::CELL_REFINE)
        held /= children;
      return cell_weight + particle_weight * held;
    });
    // It makes room for the new cells when it is emptied, not when the mesh changes.
    handler.clear_particles();
    subdomains.update();
    bring_home_strays();
    return collect(particles, contacts_of, false);
  }
} // namespace graupel
