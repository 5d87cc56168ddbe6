#ifndef graupel_simulation_case_result_h
#define graupel_simulation_case_result_h

#include <graupel/base/cost_sheet.h>
#include <graupel/base/ledger.h>

#include <deque>
#include <string>
#include <vector>

namespace graupel
{
  /** A row of monitors.csv: the state after one step of the fluid. */
  struct MonitorRow
  {
    /** Simulated time since the run began [s]. */
    double      time = 0.;
    std::string phase;
    /** Number of the flow case from 1; 0 before. */
    unsigned int flow_case            = 0;
    double       superficial_velocity = 0.; // [m/s]
    double       pressure_drop        = 0.; // [Pa]
    double       bed_height           = 0.; // [m]
    double       bottom_force         = 0.; // [N]
    double       wall_force           = 0.; // [N]
    double       fluid_force          = 0.; // on the particles, buoyancy included [N]
    double       kinetic_energy       = 0.; // mean per particle [J]
    double       maximum_speed        = 0.; // [m/s]
    double       mass_imbalance       = 0.; // [-]
    double       momentum_imbalance   = 0.; // [-]
    double       solid_volume_error   = 0.; // [-]
    unsigned int linear_iterations    = 0;
    unsigned int cells                = 0;  // of the mesh
    double       worst_node_imbalance = 0.; // of the discrete continuity equation [-]
    double       worst_cell_imbalance = 0.; // of a cell, over the inflow [-]
  };

  /** A flow case: means over the last quarter of its time, unless said otherwise. */
  struct CaseResult
  {
    double superficial_velocity          = 0.; // [m/s]
    double pressure_drop                 = 0.; // [Pa]
    double ergun_pressure_drop           = 0.; // [Pa]
    double deviation_from_ergun          = 0.; // [-]
    double gradient_deviation_from_ergun = 0.; // over the middle half, at the end [-]
    double wall_channelling_deviation    = 0.; // expected from the radial profile [-]
    double bed_height                    = 0.; // at the end [m]
    double bed_rise                      = 0.; // since settling [m]
    double mean_void_fraction            = 0.; // at the end [-]
    double bottom_force                  = 0.; // [N]
    double wall_force                    = 0.; // [N]
    double fluid_force                   = 0.; // [N]
    double weight                        = 0.; // [N]
    bool   fluidized                     = false;
    bool   steady                        = false;
    double simulated_time                = 0.; // [s]
    double wall_seconds                  = 0.; // [s]
    double cpu_seconds                   = 0.; // of all ranks [s]
  };

  /** The bed before the flow. */
  struct BedResult
  {
    unsigned int particle_count           = 0;
    double       particle_diameter        = 0.; // simulated [m]
    double       original_diameter        = 0.; // Sauter mean [m]
    double       scale                    = 1.; // [-]
    double       solid_volume             = 0.; // [m^3]
    double       height                   = 0.; // [m]
    double       mean_void_fraction       = 1.; // [-]
    double       mean_coordination_number = 0.; // [-]
    double       vessel_diameter          = 0.; // [m]
    double       vessel_height            = 0.; // [m]
    /** Solid fraction at which the drag law is evaluated over that of the bed [-]. */
    double original_solid_ratio = 1.;
  };

  /**
   * Watches pressure drop, bottom force and bed height: steady if none changes,
   * over a window of time, by more than a tolerance relative to its scale.
   */
  class SteadyMonitor
  {
  public:
    /** @p window [s]; @p tolerance [-]; @p force_scale: the weight of the bed [N]. */
    SteadyMonitor(const double window, const double tolerance, const double force_scale);

    void record(const MonitorRow &row);

    /** False until a whole window has been recorded. */
    bool is_steady() const;

  private:
    double                 window, tolerance, force_scale;
    std::deque<MonitorRow> rows;
  };

  /** Mean of the rows from the time @p from [s] on, of the columns that CaseResult
   * averages. */
  MonitorRow mean_since(const std::vector<MonitorRow> &rows, const double from);
} // namespace graupel

#endif
