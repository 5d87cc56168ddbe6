#ifndef graupel_fluid_flow_solver_h
#define graupel_fluid_flow_solver_h

#include <graupel/base/cost_sheet.h>
#include <graupel/fluid/cell_scatter.h>
#include <graupel/fluid/flow_boundaries.h>
#include <graupel/fluid/flow_parameters.h>
#include <graupel/fluid/time_scheme.h>

#include <optional>

namespace graupel
{
  /**
   * How solids that move answer to the fluid within its step. At the step's end they
   * have the volume flux
   *
   *   q_s = flux + by_velocity u - by_gradient grad p,   div (q + q_s) = s,
   *
   * so that neither the drag nor the pressure can drive them against a fluid that knows
   * only where they were. Every vector with ghosts up to date.
   */
  struct MovingSolids
  {
    /** The part that does not depend on the fluid [m/s]. */
    NodalVectorField flux;
    /** Flux for the fluid's interstitial velocity [-]. */
    NodalVector by_velocity;
    /** Flux for the pressure gradient [m^3 s/kg]. */
    NodalVector by_gradient;
    /** Part of the pressure gradient that acts on them [-]. */
    NodalVector pressure_share;

    /** No solids. */
    explicit MovingSolids(const NodalSpace &nodes);
  };

  /** What the fluid flows through; every vector with ghosts up to date. */
  struct Medium
  {
    /** alpha, the void fraction [-]. */
    NodalVector void_fraction;
    /** B, the drag coefficient a volume [kg/m^3/s]. */
    NodalVector drag;
    /** C = B v for particles that move with v [N/m^3]. */
    NodalVectorField drag_source;
    /** Whether the solids carry their share of the pressure gradient (model A)
     * or the fluid all of it (model B). */
    bool shares_pressure = true;
    /** Solids that move. Without, they carry what shares_pressure says, and d(alpha)/dt
     * is that from one medium to the next. */
    std::optional<MovingSolids> solids;
    /** Any further force on the fluid [N/m^3]. */
    NodalVectorField force;
    /** s, volume that appears per volume and time [1/s]. */
    NodalVector volume_source;

    /** Clear fluid: alpha = 1, no drag. */
    explicit Medium(const NodalSpace &nodes);
  };

  /** A linear or nonlinear solve that did not converge; a smaller step may help. */
  class SolverFailure : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * The volume-averaged Navier-Stokes solver: equal-order trilinear elements
   * for the flux q = alpha u and the pressure p, stabilised (PSPG, SUPG,
   * grad-div), one coupled linear system with drag, pressure, viscosity
   * and convection implicit. Convection is linearised about the flux of the last
   * step (BDF1), about the one extrapolated from the last two (BDF2), or repeated
   * until it no longer changes ("nonlinear iterations").
   *
   * Pressures are prescribed weakly, with backflow stabilisation. Summed over all
   * test functions the continuity equation says inflow = outflow + stored, to the
   * tolerance of the linear solver.
   */
  class FlowSolver
  {
  public:
    /** What happened in a step. */
    struct Report
    {
      /** Of the linear solver, all together [-]. */
      unsigned int iterations = 0;
      /** Linear systems solved [-]. */
      unsigned int nonlinear_iterations = 0;
      /** Last change of the flux, |q - linearised about| / |q| [-]. */
      double change = 0.;
      /** |inflow - outflow - stored| / inflow [-]. */
      double mass_imbalance = 0.;
      /** Largest residual of the discrete continuity equation at one node, over
       * the inflow [-]. */
      double worst_node_imbalance = 0.;
      /** Largest |integral of div q + d(alpha)/dt| of one cell over the inflow: a
       * discretisation error [-]. */
      double worst_cell_imbalance = 0.;
      /** Where that is [m]. */
      dealii::Point<3> worst_cell;
    };

    /** A step of this length seeks the steady state [s]. */
    static constexpr double steady = std::numeric_limits<double>::infinity();

    /** @p density [kg/m^3], @p viscosity [Pa s]; @p nodes and @p costs must outlive this
     * object. */
    FlowSolver(const FlowParameters &parameters,
               const double          density,
               const double          viscosity,
               const NodalSpace     &nodes,
               CostSheet            &costs);

    /** V of the boundary conditions: the mean flux of the inlets from now on [m/s]. */
    void set_superficial_velocity(const double velocity);

    /** The time, for boundary conditions that depend on it [s]. */
    void set_time(const double time);

    /** The time of flux() [s]. */
    double
    time() const
    {
      return now;
    }

    /** Traction at the outlets beside the prescribed pressure, 0 without [Pa];
     * ghosts up to date. */
    void set_outlet_traction(const NodalVectorField &traction);

    /**
     * Solves for the time @p step [s] after the last one, through @p medium.
     * The rate of the void fraction is that of its solids or, without these, taken from
     * this and the last media by the same formula as the acceleration. With the step
     * FlowSolver::steady all rates are 0: one linear solve towards the steady state.
     * Throws SolverFailure where a solve does not converge, and then is as it was before.
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

    /** Mean pressure over a boundary [Pa]. */
    double mean_pressure(const dealii::types::boundary_id boundary) const;

    /** Volume that leaves through the outlets [m^3/s]. */
    double outflow() const;

    /** Volume that enters through the inlets [m^3/s]. */
    double
    inflow() const
    {
      return throughput;
    }

    /** Largest |u| / h of a cell: the Courant number over the step [1/s]. */
    double courant_rate() const;

  private:
    void                 prepare_matrices();
    void                 prepare_rates(const Medium &medium, const double step);
    CellState            gather(const unsigned int cell, const Medium &medium) const;
    FlowCoefficients     coefficients() const;
    double               fastest_speed(const NodalVector &void_fraction) const;
    dealii::Tensor<1, 3> subscale_history(const unsigned int point) const;
    void                 update_unresolved(const Medium &medium);
    void                 assemble(const Medium &medium);
    void                 assemble_inlets();
    void                 assemble_outlets(const Medium &medium);
    void                 add_nodal_drag(const Medium &medium);
    void                 assemble_schur(const Medium &medium);
    unsigned int         solve();
    unsigned int         solve_to(const double tolerance);
    // Iterations, or invalid_unsigned_int after @p maximum of them.
    unsigned int iterate(const double tolerance, const unsigned int maximum);
    void         refresh_preconditioner();
    double       mass_error() const;
    double       node_error();
    void         find_worst_cell(const Medium &medium, Report &report) const;
    double       take_carrier();
    void         restore_solution();
    void         publish();

    const FlowParameters parameters;
    const double         density;
    const double         viscosity;
    const NodalSpace    &nodes;
    CostSheet           &costs;
    const FlowSpace      space;
    FlowBoundaries       boundaries;

    double           superficial_velocity = 0.;
    double           throughput           = 0.; // inflow, never 0 [m^3/s]
    double           now                  = 0.; // time of the flux [s]
    double           fastest              = 0.; // largest speed [m/s]
    NodalVectorField outlet_traction;

    dealii::TrilinosWrappers::BlockSparseMatrix matrix;
    dealii::TrilinosWrappers::SparseMatrix      schur;
    std::unique_ptr<CellScatter>                scatter;
    BlockPreconditioner                         preconditioner;
    unsigned int                                fresh_iterations    = 0;
    unsigned int                                last_iterations     = 0;
    double                                      preconditioned_rate = -1.;
    BlockVector                                 solution, rhs, residual;
    dealii::FullMatrix<double>                  cell_matrix;
    dealii::Vector<double>                      cell_rhs;
    double                                      worst_node = 0.; // [m^3/s]

    TimeScheme       scheme;
    double           last_step   = 0.;
    unsigned int     known_media = 0;
    NodalVectorField flux_now, flux_old, history;
    NodalVectorField carrier; // the flux that convection is linearised about
    NodalVector      pressure_now;
    NodalVector      alpha_old, alpha_older;
    NodalVector      alpha_rate; // with the source of volume

    // The flux that the mesh does not resolve, at the quadrature points. Where it is not
    // known from a step before, its rate is taken as 0.
    TimeScheme                        subscale_scheme;
    unsigned int                      known_unresolved = 0;
    std::vector<dealii::Tensor<1, 3>> unresolved_now, unresolved_old;
  };
} // namespace graupel

#endif
