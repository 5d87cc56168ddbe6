// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_fluid_flow_solver_h
#define graupel_fluid_flow_solver_h

#include <graupel/base/cost_sheet.h>
#include <graupel/fluid/cell_scatter.h>
#include <graupel/fluid/flow_boundaries.h>
#include <graupel/fluid/flow_history.h>
#include <graupel/fluid/flow_parameters.h>
#include <graupel/fluid/pressure_matrix.h>
#include <graupel/fluid/residual_minimizer.h>
#include <graupel/fluid/time_scheme.h>

#include <functional>
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

  /** Derivatives of the interstitial velocity u at the nodes, ghosts up to date. */
  struct FlowDerivatives
  {
    /** (u grad) u [m/s^2]. */
    NodalVectorField acceleration;
    /** rot u [1/s]. */
    NodalVectorField vorticity;
    /** div tau, tau = mu (grad u + grad u^T - 2/3 div u), as the momentum equation weighs
     * it; where the flux is prescribed, and this has none, that of the nodes next to it
     * [N/m^3]. */
    NodalVectorField viscous_force;

    /** All zero. */
    explicit FlowDerivatives(const NodalSpace &nodes);
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
   * Pressures are prescribed weakly: on the boundary the fluid has the static pressure
   * that is given, also where it enters and brings its momentum along, at a right angle.
   * What comes back through a boundary that more leaves than enters, as a vortex does,
   * enters without momentum. With q the flux, n the outward normal, and Q+ and Q- the
   * volumes that leave and enter through the whole boundary, the momentum equation has
   *
   *   -w p n = -w p_prescribed n - rho max(0, -q n) (u - (1 - r) n n u),
   *   r = min(1, Q+ / Q-),
   *
   * there. With r = 1 it is the backflow stabilisation of Esmaily Moghadam et al. (2011),
   * doi:10.1007/s00466-011-0599-0, which a uniform inflow pays rho u^2 for.
   *
   * Summed over all test functions the continuity equation says inflow = outflow +
   * stored, to the tolerance of the linear solver. In a vessel without a prescribed
   * pressure the mean of the pressure over the vessel is 0.
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
      /** The flow that imbalances are relative to, see flow_scale() [m^3/s]. */
      double flow_scale = 0.;
      /** |inflow - outflow - stored| / flow scale [-]. */
      double mass_imbalance = 0.;
      /** Largest residual of the discrete continuity equation at one node, over
       * the flow scale [-]. */
      double worst_node_imbalance = 0.;
      /** Largest |integral of div q + d(alpha)/dt| of one cell over the flow scale: a
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

    /** Whether the equation has div tau, of which Medium::drag_source takes the solids'
     * share, from now on; else, and at first, it has div(alpha tau). */
    void share_viscous_stress(const bool shared);

    bool
    shares_viscous_stress() const
    {
      return whole_stress;
    }

    /** Traction at the outlets beside the prescribed pressure, 0 without [Pa];
     * ghosts up to date. */
    void set_outlet_traction(const NodalVectorField &traction);

    /**
     * Solves for the time @p step [s] after the last one, through @p medium.
     * The rate of the void fraction is that of its solids or, without these, taken from
     * this and the last media by the same formula as the acceleration. With the step
     * FlowSolver::steady all rates are 0: one linear solve towards the steady state. Of a
     * flow that is to be solved for again @p rough of the residual may be left, whatever
     * the mass balance [-]. Where @p look_again says so on all ranks, after a solution
     * that flux() and pressure() show, it has changed drag or solids of the medium, and
     * the step is solved once more.
     * Throws SolverFailure where a solve does not converge, and then is as it was before;
     * InputError where a vessel without a prescribed pressure cannot hold what flows in.
     */
    Report step(const Medium                &medium,
                const double                 step,
                const double                 rough      = 0.,
                const std::function<bool()> &look_again = {});

    /**
     * Goes on from @p flux [m/s] and @p pressure [Pa] through @p void_fraction,
     * instead of from still fluid or the last step: where a flow is continued
     * on another mesh or in another run. The next step is of first order.
     */
    void continue_from(const NodalVectorField &flux,
                       const NodalVector      &pressure,
                       const NodalVector      &void_fraction);

    /** All values of the fields that the next step depends on, by cell. */
    VesselMesh::CellBytes cell_bytes() const;

    /** What belongs to these fields. */
    FlowHistory history() const;

    /**
     * Goes on from the cell_bytes() and the @p history() of another solver on the same
     * mesh, as VesselMesh::load() gives them back. On the same ranks with the same cells
     * the next steps are the same bit by bit as if nothing had been in between.
     * Collective.
     */
    void restore(const FlowHistory &history, VesselMesh::CellBytes bytes);

    /** alpha of the last step, 1 before the first [-], ghosts up to date. */
    const NodalVector &
    void_fraction() const
    {
      return alpha_old;
    }

    /** q [m/s], ghosts up to date. */
    const NodalVectorField &
    flux() const
    {
      return flux_now;
    }

    /** p without its hydrostatic part, on the level of the prescribed pressures [Pa],
     * ghosts up to date. */
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

    /** Of the latest flux. Collective. */
    FlowDerivatives derivatives() const;

    /** Mean pressure over a boundary: of the prescribed one where there is one, since it
     * acts there; the solution's differs by the error of the mesh [Pa]. */
    double mean_pressure(const dealii::types::boundary_id boundary) const;

    /** Integral of the pressure gradient that the fluid and the solids share out among
     * them, from the fields and the boundary conditions alone [N]. */
    dealii::Tensor<1, 3> pressure_force() const;

    /** Pressure and viscous force of the fluid on a boundary; on one that slips there is
     * no viscous force [N]. */
    dealii::Tensor<1, 3> force_on(const dealii::types::boundary_id boundary) const;

    /** Area of a boundary [m^2]. */
    double boundary_area(const dealii::types::boundary_id boundary) const;

    /** Volume that leaves through a boundary, as the continuity equation has it: what an
     * inlet prescribes, what the solution has where a pressure is prescribed, else 0
     * [m^3/s]. */
    double flow_through(const dealii::types::boundary_id boundary) const;

    /** Volume that enters through all boundaries below the height @p z [m], and so passes
     * this height upwards where nothing is stored below [m^3/s]. */
    double flow_below(const double z) const;

    /** Volume that leaves through the outlets, where a pressure is prescribed [m^3/s]. */
    double outflow() const;

    /** Volume that enters through the inlets, where a flux is prescribed [m^3/s]. */
    double inflow() const;

    /** Whether no boundary has a prescribed pressure. */
    bool
    is_closed() const
    {
      return boundaries.outlets().empty();
    }

    /** Largest |u| / h of a cell: the Courant number over the step [1/s]. */
    double courant_rate() const;

  private:
    // What a matrix is made of, beside the mesh and what does not change in a run.
    struct Recipe
    {
      double           rate = 0., subscale_rate = 0., speed = 0.;
      NodalVector      void_fraction, drag;
      NodalVectorField carrier;
      /** Whether solids move, and of these what the matrix has: by_velocity, by_gradient
       * and pressure_share of MovingSolids. */
      bool             has_solids = false;
      NodalVectorField solids;
    };

    void             prepare_rates(const Medium &medium, const double step);
    CellState        gather(const unsigned int cell, const Medium &medium) const;
    FlowCoefficients coefficients() const;
    double           fastest_speed(const NodalVector &void_fraction) const;
    EightVectors     subscale_history(const unsigned int cell) const;
    void             update_unresolved(const Medium &medium);
    void             assemble(const Medium &medium);
    void             assemble_system(const Medium &medium);
    void             assemble_inlets();
    void             assemble_outlets(const Medium &medium);
    // Of what enters through an outlet, the part that comes back: Q+ / Q-, at most 1.
    double       returning_share(const dealii::types::boundary_id outlet) const;
    void         assemble_outlet_point(const FlowBoundaries::Outlet &outlet,
                                       const FlowSpace::FacePoint   &point,
                                       const double                  returning,
                                       const Medium                 &medium);
    void         add_nodal_drag(const Medium &medium);
    void         assemble_schur(const Medium &medium);
    unsigned int solve(const Medium &medium, const double rough);
    // invalid_unsigned_int where a fresh preconditioner does not help either.
    unsigned int solve_to(const double  tolerance,
                          const double  part,
                          const Medium &medium);
    void         balance_closed_vessel();
    void         level_pressure();
    bool         is_stale() const;
    // For the last assemble_system(), which was of this medium.
    void refresh_preconditioner(const Medium &medium);
    void rebuild_preconditioner(const bool shares_pressure);
    // Collective.
    static std::shared_ptr<const Recipe> share(const Recipe &recipe);
    // Volume that enters minus what leaves and is stored, by the latest flux [m^3/s].
    double surplus() const;
    double
    mass_error() const
    {
      return std::abs(surplus());
    }
    [[noreturn]] void fail_mass_balance();
    // 0 where nothing flows.
    double
    relative_to_flow(const double flow) const
    {
      return scale > 0. ? flow / scale : 0.;
    }
    /**
     * The flow of a step: the largest of what crosses the inlets, what crosses the
     * outlets, either way, what is stored, and the largest flux times the mean section;
     * at least so much that "mass tolerance" of it is above round-off [m^3/s].
     */
    double flow_scale() const;
    double round_off() const;
    void   find_worst_cell(const Medium &medium, Report &report) const;
    // On a boundary, minus the reference_pressure().
    const NodalVector &boundary_pressure(const dealii::types::boundary_id boundary) const;
    // Integral of psi_k n times the prescribed pressure over the outlets [N].
    NodalVectorField     outlet_forces() const;
    dealii::Tensor<1, 3> viscous_traction(const FlowSpace::FacePoint &point) const;
    dealii::Tensor<2, 3> viscous_stress(const dealii::Tensor<2, 3> &gradient) const;
    bool                 is_prescribed(const unsigned int node) const;
    void                 continue_to_prescribed(NodalVectorField &field) const;
    void   solve_nonlinear(const Medium &medium, const double rough, Report &report);
    double take_carrier();
    void   restore_solution();
    void   level_published_pressure();
    void   publish();
    void   keep_history(const Medium           &medium,
                        const double            step,
                        const NodalVectorField &flux_before);
    template <typename Solver, typename RecipeType>
    static auto fields_of_history(Solver &solver, RecipeType &recipe);
    void        append_unresolved(VesselMesh::CellBytes &bytes) const;
    void        take_unresolved(VesselMesh::CellBytes &bytes);

    const FlowParameters parameters;
    const double         density;
    const double         viscosity;
    const NodalSpace    &nodes;
    CostSheet           &costs;
    const FlowSpace      space;
    FlowBoundaries       boundaries;

    bool             whole_stress         = false;
    double           superficial_velocity = 0.;
    double           last_velocity        = 0.; // of the last step
    double           volume               = 0.; // of the vessel [m^3]
    double           scale                = 0.; // flow_scale() of the step [m^3/s]
    double           now                  = 0.; // time of the flux [s]
    double           fastest              = 0.; // largest speed [m/s]
    NodalVectorField outlet_traction;

    FlowMatrix                             matrix;
    CellScatter                            scatter;
    NodeBlockMatrix                        node_matrix; // of matrix
    PressureMatrix                         schur;
    NodalVector                            of_grad_div; // over the nodes' volumes
    BlockPreconditioner                    preconditioner;
    ResidualMinimizer                      minimizer;
    unsigned int                           fresh_iterations = 0;
    unsigned int                           last_iterations  = 0;
    unsigned int                           iteration_growth = 0;
    // Of the preconditioner that is to be used, and of the one that there is: they differ
    // after a restart or a step that failed.
    std::shared_ptr<const Recipe> recipe, built;
    Recipe                        assembled; // the matrix
    BlockVector                   solution, rhs;
    CellSystem                    cell_system;
    double                        worst_node = 0.; // [m^3/s]

    TimeScheme       scheme;
    double           last_step   = 0.;
    unsigned int     known_media = 0;
    NodalVectorField flux_now, flux_old, flux_history;
    NodalVectorField carrier; // the flux that convection is linearised about
    NodalVectorField latest;  // that of the linear system solved last
    NodalVector      pressure_now;
    NodalVector      relative_pressure; // minus the boundaries' reference_pressure()
    NodalVector      alpha_old, alpha_older;
    NodalVector      alpha_rate; // with the source of volume

    // The flux that the mesh does not resolve, at the quadrature points; 0 before the
    // first step.
    TimeScheme                subscale_scheme;
    unsigned int              known_unresolved = 0;
    std::vector<EightVectors> unresolved_now, unresolved_old;
  };
} // namespace graupel

#endif
