// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/simulation/observers/probes.h>

#include <deal.II/numerics/vector_tools_evaluate.h>

#include <sstream>

namespace graupel
{
  namespace
  {
    const char *const parameter = "Output/probes";

    // In cells, within which a point on the vessel's wall is found still.
    constexpr double tolerance = 1e-6;
  } // namespace

  Probes::Probes(const std::vector<ProbePoint> &points)
    : points(points)
    , places(tolerance)
  {
  }

  std::vector<std::pair<std::string, std::string>>
  probe_columns(const std::vector<ProbePoint> &points)
  {
    std::vector<std::pair<std::string, std::string>> columns;
    for (const ProbePoint &point : points)
      {
        columns.emplace_back(point.name + "_pressure", "Pa");
        columns.emplace_back(point.name + "_void_fraction", "-");
        for (const char *direction : {"x", "y", "z"})
          columns.emplace_back(point.name + "_velocity_" + direction, "m/s");
      }
    return columns;
  }

  std::string
  Probes::header() const
  {
    std::string text = "time";
    for (const auto &column : probe_columns(points))
      text += "," + column.first;
    return text;
  }

  void
  Probes::find_points(const VesselMesh &mesh)
  {
    std::vector<dealii::Point<3>> wanted;
    if (dealii::Utilities::MPI::this_mpi_process(mesh.communicator()) == 0)
      for (const ProbePoint &point : points)
        wanted.push_back(point.place);
    places.reinit(wanted, mesh.triangulation(), mesh.mapping());
    std::string outside;
    for (unsigned int n = 0; n < wanted.size(); ++n)
      if (!places.point_found(n))
        outside = points[n].name;
    outside = dealii::Utilities::MPI::broadcast(mesh.communicator(), outside, 0);
    require(
      outside.empty(), parameter, "the probe " + outside + " lies outside the mesh");
  }

  void
  Probes::look(const SimulationState &state)
  {
    if (!places.is_ready())
      find_points(state.mesh);
    const CoupledFlow &fluid = *state.fluid;
    const auto         at    = [&](const NodalVector &field) {
      return dealii::VectorTools::point_values<1>(
        places, fluid.nodes().dof_handler, field);
    };
    const auto pressure = at(fluid.fluid().pressure());
    const auto alpha    = at(fluid.exchange().medium().void_fraction);
    std::array<std::vector<double>, 3> flux;
    for (unsigned int i = 0; i < 3; ++i)
      flux[i] = at(fluid.fluid().flux()[i]);

    // The points are the first rank's.
    seen.clear();
    for (unsigned int n = 0; n < alpha.size(); ++n)
      {
        seen.insert(seen.end(), {pressure[n], alpha[n]});
        for (unsigned int i = 0; i < 3; ++i)
          seen.push_back(flux[i][n] / alpha[n]);
      }
    seen = dealii::Utilities::MPI::broadcast(state.communicator, seen, 0);
  }

  std::string
  Probes::row(const double time) const
  {
    std::ostringstream text;
    text << std::setprecision(10) << time;
    for (const double value : seen)
      text << ',' << value;
    return text.str();
  }
} // namespace graupel
