// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_dem_validation_vessel_h
#define graupel_tests_dem_validation_vessel_h

#include <graupel/dem/dem.h>

#include <gtest/gtest.h>

#include <functional>
#include <iomanip>
#include <sstream>

namespace graupel
{
  /** A vessel of few large cells around a DEM, for particles of any size. */
  struct ValidationVessel
  {
    /** @p diameter and @p height of the vessel [m]. */
    ValidationVessel(const DemParameters &parameters,
                     const double         diameter,
                     const double         height)
      : mesh({diameter, height}, {0.4 * diameter}, MPI_COMM_WORLD)
      , dem(parameters, mesh, costs)
    {
    }

    /** Place and motion of one particle, on all ranks; collective. */
    Body
    body(const std::int64_t id) const
    {
      std::vector<double> numbers(10, 0.);
      const auto         &p = dem.particles();
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (p.id[i] == id)
          {
            const Body &b = p.body[i];
            for (unsigned int d = 0; d < 3; ++d)
              {
                numbers[d]     = b.position[d];
                numbers[3 + d] = b.velocity[d];
                numbers[6 + d] = b.spin[d];
              }
            numbers[9] = b.radius;
          }
      dealii::Utilities::MPI::sum(numbers, dem.communicator(), numbers);
      Body body;
      for (unsigned int d = 0; d < 3; ++d)
        {
          body.position[d] = numbers[d];
          body.velocity[d] = numbers[3 + d];
          body.spin[d]     = numbers[6 + d];
        }
      body.radius = numbers[9];
      return body;
    }

    /** Sets the force from outside on one particle [N]. */
    void
    push(const std::int64_t id, const dealii::Tensor<1, 3> &force)
    {
      auto &p = dem.particles();
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (p.id[i] == id)
          p.external_force[i] = force;
    }

    VesselMesh mesh;
    CostSheet  costs;
    Dem        dem;
  };

  /** Prints a line, once. */
  inline void
  title(const std::string &what)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << what << std::endl;
  }

  /** Prints a measured number, the expected one and the limit on their distance. */
  inline void
  report(const std::string &what,
         const double       measured,
         const double       expected,
         const double       limit)
  {
    std::ostringstream line;
    line << "  " << what << ": measured " << std::setprecision(8) << measured
         << ", expected " << expected << ", limit " << std::setprecision(2) << limit;
    title(line.str());
  }

  /** Reports, and expects @p measured within @p limit of @p expected. */
  inline void
  expect_near(const std::string &what,
              const double       measured,
              const double       expected,
              const double       limit)
  {
    report(what, measured, expected, limit);
    EXPECT_NEAR(measured, expected, limit) << what;
  }
} // namespace graupel

#endif
