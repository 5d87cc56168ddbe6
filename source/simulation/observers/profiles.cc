// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/observers/profiles.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/numerics/vector_tools_evaluate.h>

#include <limits>

namespace graupel
{
  namespace
  {
    // Sums the fields over regions; @p region_of gives the region of a point, or
    // one that is out of range for points that belong to none.
    template <typename RegionOf>
    std::vector<RegionMean>
    means_by_region(const FlowFields  &fields,
                    const unsigned int n_regions,
                    const RegionOf    &region_of)
    {
      constexpr unsigned int n_sums = 6;
      std::vector<double>    sums(n_regions * n_sums, 0.);
      const NodalSpace      &nodes = fields.nodes;
      dealii::FEValues<3>    values(nodes.mesh.mapping(),
                                 nodes.fe,
                                 nodes.quadrature,
                                 dealii::update_values | dealii::update_JxW_values |
                                   dealii::update_quadrature_points);
      std::vector<double>    alpha(nodes.quadrature.size()), flux(alpha), pressure(alpha);
      for (const auto &cell : nodes.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            values.reinit(cell);
            values.get_function_values(fields.void_fraction, alpha);
            values.get_function_values(fields.flux, flux);
            values.get_function_values(fields.pressure, pressure);
            for (const unsigned int q : values.quadrature_point_indices())
              {
                const dealii::Point<3> &x      = values.quadrature_point(q);
                const double            radius = std::hypot(x[0], x[1]);
                const unsigned int      region = region_of(radius, x[2]);
                if (region >= n_regions)
                  continue;
                const std::array<double, n_sums> terms{
                  {1., x[2], radius, alpha[q], flux[q], pressure[q]}};
                for (unsigned int i = 0; i < n_sums; ++i)
                  sums[region * n_sums + i] += values.JxW(q) * terms[i];
              }
          }
      dealii::Utilities::MPI::sum(sums, nodes.mesh.communicator(), sums);

      std::vector<RegionMean> means;
      for (unsigned int region = 0; region < n_regions; ++region)
        if (const double *sum = &sums[region * n_sums]; sum[0] > 0.)
          means.push_back({sum[0],
                           sum[1] / sum[0],
                           sum[2] / sum[0],
                           sum[3] / sum[0],
                           sum[4] / sum[0],
                           sum[5] / sum[0]});
      return means;
    }
  } // namespace

  std::vector<RegionMean>
  axial_profile(const FlowFields &fields, const unsigned int n_slabs)
  {
    const double height = fields.nodes.mesh.cylinder().height;
    return means_by_region(fields, n_slabs, [&](const double, const double z) {
      return static_cast<unsigned int>(z / height * n_slabs);
    });
  }

  std::vector<RegionMean>
  radial_profile(const FlowFields  &fields,
                 const unsigned int n_annuli,
                 const double       from,
                 const double       to)
  {
    if (!fields.nodes.mesh.fills_cylinder())
      return {};
    const double radius = fields.nodes.mesh.cylinder().diameter / 2.;
    return means_by_region(fields, n_annuli, [&](const double r, const double z) {
      return z < from || z > to ? n_annuli
                                : static_cast<unsigned int>(r / radius * n_annuli);
    });
  }

  double
  pressure_at(const std::vector<RegionMean> &axial, const double z)
  {
    unsigned int upper = 1;
    while (upper + 1 < axial.size() && axial[upper].height < z)
      ++upper;
    const RegionMean &below = axial[upper - 1], &above = axial[upper];
    const double      share = (z - below.height) / (above.height - below.height);
    return (1. - share) * below.pressure + share * above.pressure;
  }

  MidPlane::MidPlane(const VesselMesh &mesh, const unsigned int n_across)
    : mesh(mesh)
    , places(1e-6)
  {
    // A hair inside: the mapped boundary is not exactly the circle.
    const double half = mesh.cylinder().diameter / 2. * (1. - 1e-3);
    // And a hair beside the plane, where faces of cells lie: for a point on one deal.II
    // looks at all cells of the mesh. A vessel may have one side only.
    const double       beside = 1e-5 * half;
    const double       height = mesh.cylinder().height * (1. - 1e-6);
    const unsigned int n_along =
      std::max(2l, std::lround(height / (2. * half) * n_across));
    if (dealii::Utilities::MPI::this_mpi_process(mesh.communicator()) == 0)
      for (unsigned int i = 0; i < n_across; ++i)
        for (unsigned int k = 0; k < n_along; ++k)
          for (const double y : {beside, -beside})
            points.emplace_back(-half + 2. * half * i / (n_across - 1),
                                y,
                                height * (1e-6 + (1. - 1e-6) * k / (n_along - 1)));
  }

  std::vector<PlanePoint>
  MidPlane::values(const FlowFields &fields)
  {
    if (!places.is_ready())
      places.reinit(points, mesh.triangulation(), mesh.mapping());
    const auto evaluate = [&](const NodalVector &field) {
      return dealii::VectorTools::point_values<1>(
        places, fields.nodes.dof_handler, field);
    };
    const auto alpha = evaluate(fields.void_fraction), flux = evaluate(fields.flux),
               pressure = evaluate(fields.pressure);

    std::vector<PlanePoint> plane;
    for (unsigned int side = 0; side < points.size(); side += 2)
      for (const unsigned int n : {side, side + 1})
        if (places.point_found(n))
          {
            plane.push_back({points[n][0], points[n][2], alpha[n], flux[n], pressure[n]});
            break;
          }
    return plane;
  }

  double
  wall_channelling_deviation(const std::vector<RegionMean> &radial,
                             const FluidProperties         &fluid,
                             const double                   diameter,
                             const double                   superficial_velocity,
                             const double                   mean_void_fraction)
  {
    if (radial.empty())
      return std::numeric_limits<double>::quiet_NaN();
    std::vector<Channel> channels;
    for (const RegionMean &annulus : radial)
      channels.push_back({annulus.volume, annulus.void_fraction});
    return parallel_channels_pressure_gradient(
             fluid, diameter, channels, superficial_velocity) /
             ergun_pressure_gradient(
               fluid, diameter, mean_void_fraction, superficial_velocity) -
           1.;
  }
} // namespace graupel
