// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/closures/bed_correlations.h>
#include <graupel/simulation/files/result_files.h>

namespace graupel
{
  namespace
  {
    // Mean void fraction far from the wall: beyond two diameters, or the inner half
    // of the radius where the vessel is narrower than that.
    double
    core_void_fraction(const BedProfiles &bed)
    {
      const double radius = bed.cylinder.diameter / 2.;
      const double core   = std::max(radius - 2. * bed.diameter, radius / 2.);
      double       area = 0., empty = 0.;
      for (const RadialShell &shell : bed.radial)
        if (shell.middle() > radius - core)
          {
            const double weight =
              (shell.to - shell.from) * (radius - shell.middle()); // / (2 pi)
            area += weight;
            empty += weight * shell.void_fraction;
          }
      return empty / area;
    }

    // The mu K of Janssen's theory that the wall's load as a whole asks for: shear
    // over vertical stress, each integrated over the height of the bed.
    double
    mobilised_friction(const BedProfiles &bed, const double hydraulic_diameter)
    {
      double integral = 0.; // of the load over the height, trapezoidal [N m]
      for (std::size_t k = 0; k + 1 < bed.loads.size(); ++k)
        integral += 0.5 * (bed.loads[k].load + bed.loads[k + 1].load) *
                    (bed.loads[k + 1].height - bed.loads[k].height);
      return integral > 0. ? bed.loads[0].wall_load * hydraulic_diameter / (4. * integral)
                           : 0.;
    }

    // Stresses, and what Janssen's theory says of them, where the section is the same at
    // all heights; empty where it is not.
    void
    write_janssen(const BedProfiles &bed, std::ostream &file)
    {
      file << "z,weight,load,wall_load,stress,janssen_stress,mobilised_friction\n";
      for (const LoadLevel &level : bed.loads)
        {
          file << level.height << ',' << level.weight << ',' << level.load << ','
               << level.wall_load << ',';
          if (bed.section && bed.hydraulic_diameter)
            {
              const double friction = mobilised_friction(bed, *bed.hydraulic_diameter);
              file << level.load / *bed.section << ','
                   << janssen_stress(bed.loads[0].weight / (*bed.section * bed.height),
                                     *bed.hydraulic_diameter,
                                     friction,
                                     std::max(0., bed.bottom + bed.height - level.height))
                   << ',' << friction << '\n';
            }
          else
            file << ",,\n";
        }
    }
  } // namespace

  void
  ResultFiles::write_bed(const BedProfiles &bed)
  {
    if (!(bed.height > 0.))
      return;

    write("bed-axial.csv", [&](std::ostream &file) {
      file << "z,void_fraction\n";
      for (const auto &[z, void_fraction] : bed.axial)
        file << z << ',' << void_fraction << '\n';
    });

    const double bulk = core_void_fraction(bed);
    write("bed-radial.csv", [&](std::ostream &file) {
      file << "wall_distance,void_fraction,de_klerk\n";
      for (const RadialShell &shell : bed.radial)
        file << shell.middle() << ',' << shell.void_fraction << ','
             << de_klerk_void_fraction(shell.middle() / bed.diameter, bulk) << '\n';
    });

    write("bed-janssen.csv", [&](std::ostream &file) { write_janssen(bed, file); });

    write("bed-coordination.csv", [&](std::ostream &file) {
      file << "z,particles,coordination_number,wall_contacts\n";
      for (const CoordinationSlab &slab : bed.coordination)
        file << 0.5 * (slab.from + slab.to) << ',' << slab.n_particles << ','
             << slab.particles << ',' << slab.walls << '\n';
    });

    write("bed-contacts.csv", [&](std::ostream &file) {
      file << "contacts,particles,particles_walls_counted\n";
      for (std::size_t n = 0; n < bed.histogram_with_walls.size(); ++n)
        file << n << ',' << (n < bed.histogram.size() ? bed.histogram[n] : 0) << ','
             << bed.histogram_with_walls[n] << '\n';
    });
  }
} // namespace graupel
