// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/sphere_cuts.h>
#include <graupel/simulation/observers/bin_averages.h>

#include <deal.II/numerics/vector_tools_evaluate.h>

namespace graupel
{
  namespace mpi = dealii::Utilities::MPI;

  namespace
  {
    // In cells, within which a point on the vessel's wall is found still.
    constexpr double tolerance = 1e-6;
    // Points along each side of a bin: for its volume in the vessel; for the fluid two a
    // cell, of so many.
    constexpr unsigned int volume_points = 12;
    constexpr unsigned int fewest_points = 3, most_points = 12;

    // Calls @p take(bin, point) for points evenly spread over the bins of @p grid, so
    // many along each side.
    template <typename Take>
    void
    spread_points(const BinGrid                     &grid,
                  const std::array<unsigned int, 3> &n,
                  const Take                        &take)
    {
      for (unsigned int bin = 0; bin < grid.n_bins(); ++bin)
        for (unsigned int k = 0; k < n[2]; ++k)
          for (unsigned int j = 0; j < n[1]; ++j)
            for (unsigned int i = 0; i < n[0]; ++i)
              take(bin,
                   grid.point_of(bin,
                                 {(i + 0.5) / n[0], (j + 0.5) / n[1], (k + 0.5) / n[2]}));
    }

    // Volume of each bin as far as the walls leave it [m^3].
    std::vector<double>
    volumes_in_vessel(const BinGrid &grid, const Dem &dem, const double height)
    {
      const double part =
        std::pow(volume_points, -3.) * grid.width(0) * grid.width(1) * grid.width(2);
      std::vector<double> volumes(grid.n_bins(), 0.);
      spread_points(grid,
                    {volume_points, volume_points, volume_points},
                    [&](const unsigned int bin, const dealii::Point<3> &x) {
                      if (x[2] > 0. && x[2] < height &&
                          first_refusing_wall(dem.vessel(), x, 0.) == nullptr)
                        volumes[bin] += part;
                    });
      return volumes;
    }

    // Sums of a bin over the particles at one moment.
    enum Term : unsigned int
    {
      number,
      velocity,
      squares   = velocity + 3,
      transport = squares + 3,
      n_terms   = transport + 3
    };

    // Sums of zero for all terms of all bins, as particles of up to that @p speed [m/s]
    // and @p volume [m^3] make them.
    std::vector<ExactSum>
    center_sums(const unsigned int n_bins, const double speed, const double volume)
    {
      std::vector<ExactSum> zeros(n_terms, ExactSum(speed));
      zeros[number] = ExactSum(1.);
      for (unsigned int i = 0; i < 3; ++i)
        {
          zeros[squares + i]   = ExactSum(speed * speed);
          zeros[transport + i] = ExactSum(speed * volume);
        }
      std::vector<ExactSum> sums;
      for (unsigned int bin = 0; bin < n_bins; ++bin)
        sums.insert(sums.end(), zeros.begin(), zeros.end());
      return sums;
    }

    void
    add_center(const Body &body, ExactSum *const sums)
    {
      sums[number].add(1.);
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double v = body.velocity[i];
          sums[velocity + i].add(v);
          sums[squares + i].add(v * v);
          sums[transport + i].add(sphere_volume(body.radius) * v);
        }
    }

    // The totals of a bin at one moment.
    void
    add_moment(BinSums &bin, const double *const totals, const double duration)
    {
      const double n = totals[number];
      for (unsigned int i = 0; i < 3; ++i)
        bin.velocity_blocks[i].add(duration * totals[velocity + i], duration * n);
      if (!(n > 0.))
        return;
      ++bin.seen;
      bin.particles += duration * n;
      double scatter = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double v = totals[velocity + i], v2 = totals[squares + i];
          bin.velocity[i] += duration * v;
          bin.squares[i] += duration * v2;
          bin.transport[i] += duration * totals[transport + i];
          scatter += std::max(0., v2 - v * v / n);
        }
      if (n > 1.)
        {
          bin.agitation += duration * scatter;
          bin.freedom += duration * (n - 1.);
        }
    }

    // Calls @p take(bin, volume) for each bin of @p grid that a sphere reaches into.
    template <typename Take>
    void
    cut_sphere(const BinGrid &grid, const Body &sphere, const Take &take)
    {
      const double          r      = sphere.radius;
      const auto            center = grid.in_frame(sphere.position);
      std::array<int, 3>    first, last;
      std::array<double, 3> lower, upper;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const int most = grid.counts[i] - 1;
          first[i]       = std::max<int>(0, std::floor((center[i] - r) / grid.width(i)));
          last[i] = std::min<int>(most, std::floor((center[i] + r) / grid.width(i)));
        }
      for (int k = first[2]; k <= last[2]; ++k)
        for (int j = first[1]; j <= last[1]; ++j)
          for (int i = first[0]; i <= last[0]; ++i)
            {
              const std::array<int, 3> at{{i, j, k}};
              for (unsigned int a = 0; a < 3; ++a)
                {
                  lower[a] = at[a] * grid.width(a) - center[a];
                  upper[a] = (at[a] + 1) * grid.width(a) - center[a];
                }
              take(i + grid.counts[0] * (j + grid.counts[1] * k),
                   sphere_volume_in_box(r, lower, upper));
            }
    }
  } // namespace

  BinAverages::BinAverages(const BinGrid &grid)
    : grid(grid)
    , bins(grid.n_bins())
    , points(tolerance)
  {
  }

  void
  BinAverages::find_places(const SimulationState &state)
  {
    volumes = volumes_in_vessel(grid, state.dem, state.parameters.cylinder.height);
    if (!state.fluid)
      return;
    std::array<unsigned int, 3> n;
    for (unsigned int i = 0; i < 3; ++i)
      n[i] = std::clamp(static_cast<unsigned int>(std::ceil(
                          2. * grid.width(i) / state.parameters.mesh.cell_size)),
                        fewest_points,
                        most_points);
    std::vector<dealii::Point<3>> places;
    spread_points(grid, n, [&](const unsigned int bin, const dealii::Point<3> &x) {
      places.push_back(x);
      bin_of_point.push_back(bin);
    });
    if (mpi::this_mpi_process(state.communicator) > 0)
      places.clear();
    points.reinit(places, state.mesh.triangulation(), state.mesh.mapping());
  }

  void
  BinAverages::record(const SimulationState &state, const double duration)
  {
    if (volumes.empty())
      find_places(state);
    for (BinSums &bin : bins)
      {
        ++bin.samples;
        bin.time += duration;
      }
    look_at_centers(state.dem, duration);
    look_at_solid(state.dem, duration);
    if (state.fluid)
      look_at_fluid(*state.fluid, duration);
  }

  void
  BinAverages::look_at_centers(const Dem &dem, const double duration)
  {
    auto sums = center_sums(
      bins.size(), dem.maximum_speed(), sphere_volume(dem.parameters().largest_radius()));
    const ParticleArrays &particles = dem.particles();
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      if (const auto bin = grid.bin_at(particles.body[row].position))
        add_center(particles.body[row], &sums[*bin * n_terms]);
    const auto totals = ExactSum::totals(sums, dem.communicator());
    for (unsigned int bin = 0; bin < bins.size(); ++bin)
      add_moment(bins[bin], &totals[bin * n_terms], duration);
  }

  void
  BinAverages::look_at_solid(const Dem &dem, const double duration)
  {
    const double          largest = sphere_volume(dem.parameters().largest_radius());
    std::vector<ExactSum> sums(bins.size(), ExactSum(largest));
    const ParticleArrays &particles = dem.particles();
    for (unsigned int row = 0; row < particles.n_owned; ++row)
      cut_sphere(
        grid, particles.body[row], [&](const unsigned int bin, const double volume) {
          sums[bin].add(volume);
        });
    const auto totals = ExactSum::totals(sums, dem.communicator());
    for (unsigned int bin = 0; bin < bins.size(); ++bin)
      if (volumes[bin] > 0.)
        {
          const double solid_fraction = totals[bin] / volumes[bin];
          bins[bin].solid_fraction.add(solid_fraction, duration);
          bins[bin].solid_fraction_blocks.add(duration * solid_fraction, duration);
        }
  }

  void
  BinAverages::look_at_fluid(const CoupledFlow &flow, const double duration)
  {
    // On the first rank.
    using Field                     = FieldAverages;
    constexpr unsigned int n_fields = Field::n_fields;
    const Field::Fields    fields   = Field::of(flow);
    std::vector<double>    means(bins.size() * n_fields, 0.);
    std::vector<double>    found(bins.size(), 0.);
    for (unsigned int field = 0; field < n_fields; ++field)
      {
        const auto values = dealii::VectorTools::point_values<1>(
          points, flow.nodes().dof_handler, *fields[field]);
        for (unsigned int n = 0; n < values.size(); ++n)
          if (points.point_found(n))
            {
              means[bin_of_point[n] * n_fields + field] += values[n];
              found[bin_of_point[n]] += 1. / n_fields;
            }
      }
    const MPI_Comm communicator = flow.nodes().mesh.communicator();
    means                       = mpi::broadcast(communicator, means, 0);
    found                       = mpi::broadcast(communicator, found, 0);
    for (unsigned int bin = 0; bin < bins.size(); ++bin)
      if (found[bin] > 0.)
        {
          const double *const mean = &means[bin * n_fields];
          bins[bin].void_fraction.add(mean[Field::void_fraction] / found[bin], duration);
          bins[bin].pressure.add(mean[Field::pressure] / found[bin], duration);
          for (unsigned int i = 0; i < 3; ++i)
            bins[bin].flux[i].add(mean[Field::flux + i] / found[bin], duration);
        }
  }

  std::string
  BinAverages::rows() const
  {
    std::string text;
    for (unsigned int bin = 0; bin < bins.size(); ++bin)
      {
        const BinView view{grid, bin, volumes.empty() ? 0. : volumes[bin], bins[bin]};
        text += grid.name + "," +
                csv_row(bin_quantities(), Values(bin_quantities(), view)) + "\n";
      }
    return text;
  }
} // namespace graupel
