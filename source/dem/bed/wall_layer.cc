// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/wall_layer.h>

#include <algorithm>
#include <stdexcept>

namespace graupel
{
  namespace
  {
    // Diameters at each end of a bed in which the floor and the surface order it.
    constexpr double end_of_bed = 2.;
    // Of a diameter; where the layer ends hardly matters.
    constexpr double shell_width = 0.025;

    // Area over pi [m^2].
    double
    area_of(const RadialShell &shell, const double tube)
    {
      return (shell.to - shell.from) * (2. * tube - shell.from - shell.to);
    }

    // Volumes are per height and over pi.
    double
    solid_of(const std::vector<RadialShell> &shells, const double tube)
    {
      double solid = 0.;
      for (const RadialShell &shell : shells)
        solid += (1. - shell.void_fraction) * area_of(shell, tube);
      return solid;
    }
  } // namespace

  double
  WallLayer::mean_solid_fraction(const double times) const
  {
    const double within = 1. - thickness / (times * tube);
    return core_solid_fraction +
           (solid_fraction - core_solid_fraction) * (1. - within * within);
  }

  WallLayer
  find_wall_layer(const std::vector<RadialShell> &shells)
  {
    if (shells.empty())
      throw std::invalid_argument("A wall layer needs the void fraction in shells.");
    WallLayer    layer;
    double       in_layer = 0.;
    const double tube = shells.back().to, all = solid_of(shells, tube);
    layer.tube                = tube;
    layer.core_solid_fraction = all / (tube * tube);
    for (const RadialShell &shell : shells)
      {
        const double solid = 1. - shell.void_fraction;
        if (solid >= layer.core_solid_fraction)
          break;
        in_layer += solid * area_of(shell, tube);
        layer.thickness           = shell.to;
        const double core         = tube - shell.to;
        layer.core_solid_fraction = (all - in_layer) / (core * core);
      }
    if (layer.thickness > 0.)
      layer.solid_fraction = in_layer / (layer.thickness * (2. * tube - layer.thickness));
    return layer;
  }

  std::optional<OriginalPacking>
  packing_of_smaller(const Dem                 &dem,
                     const BedObservables::Bed &bed,
                     const double               diameter,
                     const double               times)
  {
    const Vessel &vessel = dem.vessel_shape();
    if (!bed.exists || !vessel.is_tube() ||
        vessel.cylinder().diameter < narrowest_tube * diameter)
      return {};
    const double    end   = std::min(end_of_bed * diameter, 0.25 * bed.height);
    const WallLayer layer = find_wall_layer(shell_void_fractions(dem.particles(),
                                                                 vessel.cylinder(),
                                                                 shell_width * diameter,
                                                                 bed.bottom + end,
                                                                 bed.top - end,
                                                                 dem.communicator()));
    const double    here  = layer.mean_solid_fraction();
    const double    there = layer.mean_solid_fraction(times);
    const double    ends  = 1. - (1. - bed.mean_void_fraction) / here;
    return OriginalPacking{there / here, 1. - there * (1. - ends / times)};
  }
} // namespace graupel
