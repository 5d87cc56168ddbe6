// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_validation_dem_beds_h
#define graupel_tests_validation_dem_beds_h

#include "../../dem/validation_vessel.h"

#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/settling.h>

namespace graupel
{
  /** The cylinder of the main job, of some height [m]. */
  inline Cylinder
  tube(const double height)
  {
    Cylinder cylinder;
    cylinder.diameter = 0.025;
    cylinder.height   = height;
    return cylinder;
  }

  /** A bed that rains in and settles. */
  struct RainedBed
  {
    RainedBed(const DemParameters &parameters,
              const Cylinder      &cylinder,
              const unsigned int   count)
      : mesh(cylinder, MeshParameters(), MPI_COMM_WORLD)
      , dem(parameters, mesh, costs)
    {
      FillingParameters filling_parameters;
      filling_parameters.count      = count;
      filling_parameters.bed_height = 0.;
      Filling filling(filling_parameters, dem);
      while (filling.step())
        ;
      Settling settling(SettlingParameters(), dem);
      while (settling.step())
        ;
    }

    /** Centers and radii of all particles, on all ranks. */
    std::vector<std::pair<dealii::Point<3>, double>>
    spheres() const
    {
      std::vector<std::pair<dealii::Point<3>, double>> mine, all;
      const auto                                      &p = dem.particles();
      for (unsigned int i = 0; i < p.n_owned; ++i)
        mine.emplace_back(p.body[i].position, p.body[i].radius);
      for (const auto &of_rank :
           dealii::Utilities::MPI::all_gather(dem.communicator(), mine))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      return all;
    }

    VesselMesh mesh;
    CostSheet  costs;
    Dem        dem;
  };
} // namespace graupel

#endif
