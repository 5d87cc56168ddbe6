// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_observers_probes_h
#define graupel_simulation_observers_probes_h

#include <graupel/simulation/parameters/probe_points.h>
#include <graupel/simulation/state/simulation_state.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>

namespace graupel
{
  /** Names and units of what is seen at @p points: NAME_pressure [Pa],
   * NAME_void_fraction [-], NAME_velocity_x, _y, _z [m/s] of each. */
  std::vector<std::pair<std::string, std::string>> probe_columns(
    const std::vector<ProbePoint> &points);

  /**
   * Pressure, void fraction and interstitial velocity of the fluid at points, linear
   * within the cells.
   */
  class Probes
  {
  public:
    explicit Probes(const std::vector<ProbePoint> &points);

    bool
    are_wanted() const
    {
      return !points.empty();
    }

    /** Columns of probes.csv: time, then those of probe_columns(). */
    std::string header() const;

    /**
     * Looks at the fluid of @p state, which there must be. Throws
     * InputError("Output/probes", ...) for a point outside of the mesh. Collective.
     */
    void look(const SimulationState &state);

    /** What the last look() saw, by column; the same on every rank. */
    const std::vector<double> &
    values() const
    {
      return seen;
    }

    /** Their row of probes.csv at @p time [s]. */
    std::string row(const double time) const;

  private:
    void find_points(const VesselMesh &mesh);

    const std::vector<ProbePoint>                    points;
    std::vector<double>                              seen;
    dealii::Utilities::MPI::RemotePointEvaluation<3> places;
  };
} // namespace graupel

#endif
