#ifndef graupel_simulation_observers_probes_h
#define graupel_simulation_observers_probes_h

#include <graupel/simulation/parameters/probe_points.h>
#include <graupel/simulation/state/simulation_state.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>

namespace graupel
{
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

    /** Columns of probes.csv: time, then NAME_pressure [Pa], NAME_void_fraction [-],
     * NAME_velocity_x, _y, _z [m/s] of each point. */
    std::string header() const;

    /**
     * The row of @p state, on rank 0. Throws InputError("Output/probes", ...) for a point
     * outside of the mesh. Collective.
     */
    std::string row(const SimulationState &state);

  private:
    void find_points(const VesselMesh &mesh);

    const std::vector<ProbePoint>                    points;
    dealii::Utilities::MPI::RemotePointEvaluation<3> places;
  };
} // namespace graupel

#endif
