// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_observers_bin_averages_h
#define graupel_simulation_observers_bin_averages_h

#include <graupel/base/block_sums.h>
#include <graupel/base/moments.h>
#include <graupel/simulation/observers/quantity.h>
#include <graupel/simulation/parameters/bin_grid.h>
#include <graupel/simulation/state/simulation_state.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>

namespace graupel
{
  /** Sums over the looks at one bin; trivially copyable, for checkpoints. A time [s] is
   * the weight of a look, and a particle is in the bin where its center is. */
  struct BinSums
  {
    /** Looks, and those with a particle in the bin. */
    std::uint64_t samples = 0, seen = 0;
    /** Time of all looks [s]. */
    double time = 0.;
    /** Number of particles over time [s]. */
    double particles = 0.;
    /** Their velocities [m], and the squares of these [m^2/s], over time. */
    std::array<double, 3> velocity{}, squares{};
    /** Their volumes times velocities, over time [m^4]. */
    std::array<double, 3> transport{};
    /** Squared distance of their velocities from their mean at the same moment, over time
     * [m^2/s]; and particles less one, over time, where there are two [s]. */
    double agitation = 0., freedom = 0.;
    /** Their velocities over time, and their number over time. */
    std::array<BlockSums, 3> velocity_blocks;
    /** Of spheres cut by the bin's faces, over the bin's volume [-]. */
    Moments   solid_fraction;
    BlockSums solid_fraction_blocks;
    /** Of the fluid, mean over the bin; no weight outside of the mesh. */
    Moments                void_fraction, pressure;
    std::array<Moments, 3> flux;
  };

  /** A bin as its columns see it. */
  struct BinView
  {
    const BinGrid &grid;
    unsigned int   bin;
    double         volume; // of the bin as far as it lies in the vessel [m^3]
    const BinSums &sums;
  };

  /** The columns of averages-lines-NN.csv and averages-planes-NN.csv behind `name`. A new
   * one is one function and one line of this table. */
  const std::vector<Quantity<BinView>> &bin_quantities();

  /**
   * Means over time of what particles and fluid do in the bins of a grid. Spheres are cut
   * exactly, all sums over particles are exact: their means are the same on any number of
   * ranks, and on every rank.
   */
  class BinAverages
  {
  public:
    explicit BinAverages(const BinGrid &grid);

    /** Looks at the particles and, if there is one, at the fluid, as of the last
     * @p duration [s]. Collective. */
    void record(const SimulationState &state, const double duration);

    /** Rows of the table, each with the end of its line. */
    std::string rows() const;

    const std::vector<BinSums> &
    sums() const
    {
      return bins;
    }

    /** From the sums of an earlier run. */
    void
    continue_from(const std::vector<BinSums> &earlier)
    {
      bins = earlier;
    }

  private:
    void find_places(const SimulationState &state);
    void look_at_centers(const Dem &dem, const double duration);
    void look_at_solid(const Dem &dem, const double duration);
    void look_at_fluid(const CoupledFlow &flow, const double duration);

    const BinGrid        grid;
    std::vector<BinSums> bins;

    // Found at the first look.
    std::vector<double>                              volumes; // in the vessel [m^3]
    std::vector<unsigned int>                        bin_of_point;
    dealii::Utilities::MPI::RemotePointEvaluation<3> points;
  };
} // namespace graupel

#endif
