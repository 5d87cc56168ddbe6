// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/bed_profiles.h>
#include <graupel/simulation/files/particle_output.h>

namespace graupel
{
  namespace
  {
    // A third of the trace of the stress in each own particle, 1/V sum of force times
    // arm over its contacts; only the normal force is along the arm [Pa].
    std::vector<float>
    mean_normal_stresses(const ParticleArrays            &particles,
                         const std::vector<ContactState> &contacts)
    {
      std::vector<float> stresses(particles.n_owned);
      const auto         rows = rows_by_id(particles);
      for (const ContactState &contact : contacts)
        for (const auto id : {contact.first, contact.second})
          if (const auto found = rows.find(id); found != rows.end())
            {
              const double radius = particles.body[found->second].radius;
              const double arm =
                radius - (contact.second < 0 ? 1. : 0.5) * contact.overlap;
              stresses[found->second] -=
                contact.force * contact.normal * arm / (3. * sphere_volume(radius));
            }
      return stresses;
    }
  } // namespace

  VtuPiece
  particle_output(const Dem &dem)
  {
    const ParticleArrays &particles = dem.particles();
    const unsigned int    n         = particles.n_owned;
    const auto            contacts  = dem.contact_states(true);
    const ContactCounts   counts    = count_contacts(particles, contacts);

    std::vector<dealii::Point<3>>     positions(n);
    std::vector<double>               diameters(n);
    std::vector<dealii::Tensor<1, 3>> velocities(n), spins(n), contact_forces(n),
      fluid_forces(n);
    for (unsigned int row = 0; row < n; ++row)
      {
        const Body &body    = particles.body[row];
        positions[row]      = body.position;
        diameters[row]      = 2. * body.radius;
        velocities[row]     = body.velocity;
        spins[row]          = body.spin;
        contact_forces[row] = dem.contact_force(row);
        fluid_forces[row]   = particles.external_force[row];
      }
    const auto own = [&](const auto &values) {
      return std::vector<std::int32_t>(values.begin(), values.begin() + n);
    };

    VtuPiece piece(VtuPiece::vertex, positions);
    piece.add("id",
              std::vector<std::int64_t>(particles.id.begin(), particles.id.begin() + n));
    auto types = own(particles.type);
    for (auto &type : types)
      ++type; // as parameter files and lists of particles count
    piece.add("type", types);
    piece.add("coordination_number", own(counts.particles));
    piece.add("wall_contacts", own(counts.walls));
    piece.add("diameter", diameters);
    piece.add_vectors<double>("velocity", velocities);
    piece.add_vectors<double>("spin", spins);
    piece.add("mean_normal_stress", mean_normal_stresses(particles, contacts));
    piece.add_vectors<float>("contact_force", contact_forces);
    piece.add_vectors<float>("fluid_force", fluid_forces);
    return piece;
  }
} // namespace graupel
