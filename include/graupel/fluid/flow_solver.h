#ifndef graupel_fluid_flow_solver_h
#define graupel_fluid_flow_solver_h

#include <graupel/base/cost_sheet.h>
#include <graupel/fluid/block_preconditioner.h>
#include <graupel/fluid/flow_parameters.h>
#include <graupel/fluid/flow_space.h>
#include <graupel/fluid/time_scheme.h>

namespace graupel
{
  /** What the fluid flows through; every vector with ghosts up to date. */
  struct Medium
  {
    /** alpha, the void fraction [-]. */
    NodalVector void_fraction;
    /** B, the drag coefficient a volume [kg/m^3/s]. */
    NodalVector drag;
    /** C = B v for particles that move with v [N/m^3]. */
    NodalVectorField drag_source;

    /** Clear fluid: alpha = 1, no drag. */
    explicit Medium(const NodalSpace &nodes);
  };

  /**
   * The volume-averaged Navier-Stokes solver: equal-order trilinear elements
   * for the flux q = alpha u and the pressure p, stabilised (PSPG, SUPG,
   * grad-div), one coupled linear system a step with drag, pressure, viscosity
   * and convection implicit; drag and convection are linearised about the last
   * step's flux.
   *
   * Boundary conditions: superficial velocity at the bottom (plug flow),
   * pressure 0 at the top (weak, with backflow stabilisation), slip or no-slip at
   * the wall. Summed over all test functions the continuity equation says
   * inflow = outflow + stored, to the tolerance of the linear solver.
   */
  class FlowSolver
  {
  public:
    /** What happened in a step. */
    struct Report
    {
      unsigned int iterations = 0;
      /** |inflow - outflow - stored| / inflow [-]. */
      double mass_imbalance = 0.;
    };

    /** @p density [kg/m^3], @p viscosity [Pa s]; @p nodes and @p costs must outlive this
     * object. */
    FlowSolver(const FlowParameters &parameters,
               const double          density,
               const double          viscosity,
               const NodalSpace     &nodes,
               CostSheet            &costs);

    /** The plug flow that enters at the bottom from now on [m/s]. */
    void set_superficial_velocity(const double velocity);

    /**
     * Solves for the time @p step [s] after the last one, through @p medium.
     * The rate of the void fraction is taken from this and the last media by
     * the same formula as the acceleration. Throws std::runtime_error where the
     * linear solver does not converge.
     */
    Report step(const Medium &medium, const double step);

    /**
     * Goes on from @p flux [m/s] and @p pressure [Pa] through @p void_fraction,
     * instead of from still fluid or the last step: where a flow is continued
     * on another mesh or in another run. The next step is of first order.
     */
    void continue_from(const NodalVectorField &flux,
                       const NodalVector      &pressure,
                       const NodalVector      &void_fraction);

    /** q [m/s], ghosts up to date. */
    const NodalVectorField &
    flux() const
    {
      return flux_now;
    }

    /** p without its hydrostatic part, relative to the outlet [Pa], ghosts up to date. */
    const NodalVector &
    pressure() const
    {
      return pressure_now;
    }

    /**
     * g_k, the pressure gradient at the nodes as the momentum equation weighs it:
     * alpha_k m_k g_k is the force on the fluid [Pa/m], ghosts up to date.
     */
    NodalVectorField pressure_gradient() const;

    /** Mean pressure over the bottom or the top [Pa]. */
    double mean_pressure(const VesselMesh::Boundary boundary) const;

    /** Volume that leaves through the top [m^3/s]. */
    double outflow() const;

  private:
    void         make_constraints();
    void         prepare_matrices();
    CellState    gather(const unsigned int cell, const Medium &medium) const;
    void         assemble(const Medium &medium);
    void         add_nodal_drag(const Medium &medium);
    void         assemble_schur(const Medium &medium);
    unsigned int solve(const double inflow);
    unsigned int solve_to(const double tolerance);
    // Iterations, or invalid_unsigned_int after @p maximum of them.
    unsigned int iterate(const double tolerance, const unsigned int maximum);
    void         refresh_preconditioner();
    double       mass_error() const;
    void         publish();

    const FlowParameters parameters;
    const double         density;
    const double         viscosity;
    const NodalSpace    &nodes;
    CostSheet           &costs;
    const FlowSpace      space;

    double                            superficial_velocity = 0.;
    dealii::AffineConstraints<double> constraints;

    dealii::TrilinosWrappers::BlockSparseMatrix matrix;
    dealii::TrilinosWrappers::SparseMatrix      schur;
    BlockPreconditioner                         preconditioner;
    unsigned int                                fresh_iterations    = 0;
    unsigned int                                last_iterations     = 0;
    double                                      preconditioned_rate = 0.;
    BlockVector                                 solution;
    BlockVector                                 rhs;

    TimeScheme       scheme;
    double           last_step   = 0.;
    unsigned int     known_media = 0;
    NodalVectorField flux_now, flux_old, history;
    NodalVector      pressure_now;
    NodalVector      alpha_old, alpha_older, alpha_rate;
  };
} // namespace graupel

#endif
