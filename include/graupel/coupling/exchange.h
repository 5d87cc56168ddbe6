// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_coupling_exchange_h
#define graupel_coupling_exchange_h

#include <graupel/base/cost_sheet.h>
#include <graupel/coupling/added_forces.h>
#include <graupel/coupling/drag_of_type.h>
#include <graupel/coupling/filter.h>
#include <graupel/coupling/own_mark.h>
#include <graupel/coupling/particle_response.h>
#include <graupel/coupling/particle_transfer.h>
#include <graupel/fluid/flow_solver.h>

namespace graupel
{
  /** How particles and fluid feel each other, beside the drag law. */
  struct CouplingParameters
  {
    /** "A": the solids carry their share of the pressure gradient; "B": the fluid
     * carries all of it, with a drag larger by 1 / alpha. */
    std::string model = "A";
    /** A length [m], or "auto": the simulated diameter / sqrt(2). */
    std::string filter_length = "auto";
    /** "sharp": the drag law does not see that the filter smears the bed's surface;
     * "smeared": it does. */
    std::string bed_surface = "sharp";
    /** "foscolo-gibilaro", "none", or "auto", the former in liquids: whether loose
     * particles feel the void fraction upstream of themselves (Exchange). */
    std::string void_fraction_gradient = "auto";
    /** "sauter mean" or "own diameter": how a mixture of sizes feels the drag. */
    std::string mixture = "sauter mean";

    /** Declares the section "Coupling". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;

    /** The filter length in use [m], in a gas whose bubbles are to be followed or not. */
    double length(const double simulated_diameter, const bool bubbles) const;

    /** LawVoidFraction::upstream in use, in a fluid of @p density_ratio times the density
     * of the particles [-]. */
    double upstream(const double density_ratio) const;
  };

  /** At which void fraction the drag law is evaluated. */
  struct LawVoidFraction
  {
    /** Whether the filter's smearing of surfaces of the bed is undone. */
    bool sharp_surface = true;
    /** Solid fraction of the bed that is meant over that of the simulated one [-]. */
    double solid_ratio = 1.;
    /** How far upstream of itself a loose particle feels the void fraction, in diameters
     * [-]; 0: where it is. */
    double upstream = 0.;
  };

  /**
   * The traffic between particles and fluid, in both directions by one operator
   * pair: a number of a particle is spread over the nodes by S M^-1 W^T, a field
   * of the nodes is felt by a particle as W S f (see Filter, ParticleTransfer).
   * As S is self-adjoint, what the particles receive is what the fluid loses, to
   * round-off.
   *
   *   alpha = 1 - S M^-1 W^T V,  B = S M^-1 W^T beta,  C = S M^-1 W^T (beta v)
   *   F_p = beta_p ((W S u)_p - v_p) - V_p (W S grad p)_p - V_p rho g
   *
   * The last term is buoyancy, as p is the pressure without its hydrostatic part.
   * That is model A. In model B beta is divided by the void fraction at the particle
   * and the pressure gradient acts on the fluid alone; in a uniform bed both have the
   * same pressure gradient.
   * Source: Gidaspow, Multiphase Flow and Fluidization (1994), ch. 2.
   *
   * Further forces, where they are wanted, are those of AddedForces.
   *
   * The void fraction of the law, alpha', may be another than that of the flow, alpha:
   * undisturbed by the filter where that smears the surface of the bed, or that of
   * another bed which the simulated one stands for (LawVoidFraction). What a particle
   * adds to the pressure drop is the law's at alpha' and the same superficial slip w:
   *
   *   beta_p = beta_law(alpha', w / alpha') / (alpha'^2 W S alpha^-2),
   *   w = |(W S u)_p - v_p| / W S alpha^-1,
   *
   * since a flux q and the drag q S M^-1 W^T beta_p / alpha make the pressure gradient
   * q S M^-1 W^T beta_p / alpha^2, the sum of which over the bed is that of
   * beta_p (W S alpha^-2)_p q. In an even bed this is beta_law(alpha, |u - v|).
   *
   * The surface: chi is 1 where the solid fraction is above half of its mean over the
   * particles, and 0 below; 1 - alpha' = (1 - alpha) max(1, chi / S chi), a normalised
   * convolution. Source of those: Knutsson & Westin, CVPR (1993),
   * doi:10.1109/CVPR.1993.341081. It belongs to beds: where 1 - alpha' would be below
   * 0.15 for the particle and for the mean of all, the factor goes to 1, which it is
   * below 0.05: there chi would tell single particles from each other.
   *
   * In motion: where that is wanted, a loose particle (ParticleResponse::looseness, c)
   * feels the void fraction two thirds of a diameter d upstream, by the gradient of the
   * solid fraction of the others in its cell, along the slip s = (W S u)_p - v_p:
   *
   *   alpha' + c 2/3 d grad (1 - alpha - S(phi_s) phi_0) s / |s|.
   *
   * To a bed that hangs in the flow this is the elastic force of Foscolo & Gibilaro,
   * -2/3 d dF/d(1 - alpha) grad (1 - alpha) with the drag F, which they find for the
   * layers of a suspension: waves of void fraction run on with
   * (3.2 g d (1 - alpha) (1 - rho / rho_p))^1/2, and grow only where the fluid carries
   * them faster. Without it they grow in every bed that moves. d is the simulated
   * diameter, the scale on which they would grow; a bed at rest has none of it. Source:
   * Foscolo & Gibilaro, Chem. Eng. Sci. 39 (1984) 1667 and 42 (1987) 1489.
   *
   * The force acts over a step t from where the particles are on. So the law takes the
   * solid fraction phi = 1 - alpha' of the middle of the step, if it goes on to change as
   * since the last one:
   *
   *   phi + t / (2 t_before) (phi - phi_before),
   *
   * at least half of phi, and no more than 0.64, which spheres packed at random have at
   * most, nor than twice phi. Without it the drag lags behind by half a step, and a bed
   * that loosens rises too far (doc/design.md).
   *
   * What a particle does to the fields that it feels. Its mark in a filtered field is
   * known: the solid fraction phi_0 (OwnMark). Among others it fills the hole that they
   * leave around it, and what is left is the part S(phi_s), by the structure factor of
   * hard spheres in the surroundings of the solid fraction phi_s = 1 - alpha - S phi_0:
   * all of it for a lone sphere, nothing in a packed bed. The law is evaluated at phi_s.
   * A force F slows the fluid that the particle feels down by k F,
   *
   *   k = S(phi_s) screened_mobility(s), s^2 = 4 l^2 + 2/3 sum over k of w_pk |x_k -
   * x_p|^2,
   *
   * so that the undisturbed slip is the felt one over 1 - k beta_p, found by repetition,
   * and so is the coefficient that acts on the felt one. k beta_p is at most 1/2; for a
   * lone sphere in slow flow, with the default filter, it is 0.28. And the fluid goes
   * around a lone mark instead of through it: alpha^-n at it counts 1 + phi_0 / 3 instead
   * of 1 + n phi_0, as the flow through a sphere of another conductivity does. Source of
   * the latter: Maxwell, A Treatise on Electricity and Magnetism (1873), 314.
   */
  class Exchange
  {
  public:
    /** @p filter_length [m]; @p shares_pressure: model A; @p nodes and @p costs must
     * outlive this object. */
    Exchange(const double                   filter_length,
             const bool                     shares_pressure,
             const LawVoidFraction         &law_void_fraction,
             const std::vector<DragOfType> &drags,
             const NodalSpace              &nodes,
             CostSheet                     &costs,
             const AddedForceLaws          &added_forces = {});

    /** Void fraction of the flow and of the drag law, from where the particles are
     * (the store must be current). Throws InputError("Coupling/filter length", ...) on
     * all ranks where less void is left than spheres can leave. */
    void update_bed(const ParticleStore &store, const ParticleArrays &particles);

    /**
     * Drag coefficients in the bed of the last update_bed(), from the slip of its
     * particles against the fluid of the last forces(). Throws std::runtime_error,
     * naming the place, where the void fraction or the drag coefficient cannot be.
     */
    void update_drag(const ParticleArrays &particles);

    /**
     * The same for particles that answer within the fluid's step: their velocities v in
     * drag and continuity are those of its end, so that the step is stable whatever
     * its length and however light they are. With the mobility k of a particle
     * and D = 1 / (1 + beta k),
     *
     *   F_p = D (beta_p ((W S u)_p - v_p) - V_p (W S grad p)_p),
     *   B = S M^-1 W^T D beta,  C = S M^-1 W^T (D beta v),
     *
     * with @p response's velocity v at F = 0, and in place of 1 - alpha the solids carry
     * S M^-1 W^T (D V) of the pressure gradient. Where drag and pressure balance, the
     * force on a particle is -V / (1 - alpha) grad p.
     *
     * A virtual mass M counts as a further beta of M/dt past the velocity that the fluid
     * brings along (AddedForces); what the fluid feels of the latter is taken node by
     * node, as averages over the filter would smooth the flow.
     */
    void update_drag(const ParticleArrays &particles, const ParticleResponse &response);

    /**
     * Takes velocities and pressure gradients for the next update_drag() from @p flow,
     * past the bed of @p void_fraction, instead of the last forces(): where a flow is
     * continued on another mesh or in another run. Collective.
     */
    void follow(const FlowSolver &flow, const NodalVector &void_fraction);

    /** What the updates made. */
    const Medium &
    medium() const
    {
      return result;
    }

    /**
     * Force of the fluid on each own particle [N], after the fluid's step
     * through medium(); buoyancy under @p gravity [m/s^2] in a fluid of
     * @p density [kg/m^3] included. Records the momentum_imbalance().
     */
    std::vector<dealii::Tensor<1, 3>> forces(const ParticleArrays       &particles,
                                             const FlowSolver           &flow,
                                             const double                density,
                                             const dealii::Tensor<1, 3> &gravity);

    /** Torque of the fluid on each own particle over the next @p step [s], after forces()
     * [N m]. */
    std::vector<dealii::Tensor<1, 3>> torques(const ParticleArrays &particles,
                                              const double          step) const;

    /**
     * The longest step [s] that the particles of the last forces() bear: the least
     * graupel::stable_step() of them all, infinite without particles. Collective.
     */
    double stable_step(const ParticleArrays &particles) const;

    /** 1 - alpha' around each own particle as of the last update_bed(), for
     * ParticleArrays::solid_fraction at the end of a step [-]. */
    std::vector<double> solid_fractions() const;

    /** |momentum that the fluid lost - what the particles got| over the former [-]. */
    double
    momentum_imbalance() const
    {
      return momentum_error;
    }

    /** |solid volume on the mesh - sum of the particle volumes| over the latter [-]. */
    double
    solid_volume_error() const
    {
      return volume_error;
    }

    /** Total force of the fluid on all particles without buoyancy [N]. */
    const dealii::Tensor<1, 3> &
    total_force() const
    {
      return fluid_force;
    }

  private:
    void deposit_void_fraction(const ParticleArrays &particles);
    void check_void_fraction(const ParticleArrays &particles) const;
    // Of the law at each own particle.
    std::vector<double> law_void_fractions();
    void                find_marks();
    // alpha' in the middle of the response's step.
    void look_ahead(const ParticleArrays &particles);
    // The solid fraction that a particle finds of itself after one or two filters [-].
    double own_solid(const unsigned int row, const unsigned int filters) const;
    // 1 - alpha at each own particle, without what is left of its own mark.
    std::vector<double> surrounding_solids();
    // chi / S chi, at least 1, at each own particle: above 1 at the surface.
    std::vector<double> surface_factors(const std::vector<double> &solid);
    // Mean over all particles.
    double mean(const std::vector<double> &values) const;
    void   find_solid_gradient();
    // What a particle with this slip feels [-].
    double void_fraction_upstream(const unsigned int          row,
                                  const double                diameter,
                                  const dealii::Tensor<1, 3> &slip_velocity) const;
    void   find_drag_coefficients(const ParticleArrays &particles);
    // Of a particle that feels the slip @p felt [m/s].
    void find_coefficient(const unsigned int row,
                          const DragOfType  &drag,
                          const double       radius,
                          const double       felt);
    // k, velocity of its disturbance where it is over its force [s/kg].
    double own_mobility(const unsigned int row, const FluidProperties &fluid) const;
    void   find_answers();
    void   find_added_forces(const ParticleArrays &particles);
    // M/dt of a row, or 0.
    double inertia(const unsigned int row) const;
    // To what the medium has of drag and pressure.
    void add_forces();
    void add_known_forces();
    void add_virtual_mass();
    // Where the fluid moves with this velocity, over D [N].
    dealii::Tensor<1, 3> added_force(const unsigned int          row,
                                     const dealii::Tensor<1, 3> &velocity) const;
    // Takes what a particle would answer to the fields of the last forces() node by node
    // instead of particle by particle; in a bed at rest nothing is then left of the
    // mobility.
    void put_back_old_fields();
    // beta_p (W S u)_p - V_p (W S grad p)_p of the last forces(), by row [N].
    std::vector<dealii::Tensor<1, 3>> old_forces() const;
    // x = W^T of a function of the own rows, which joins the fields that the filter is to
    // spread together.
    template <typename Function>
    void deposit(NodalVector                &x,
                 const Function             &value,
                 std::vector<NodalVector *> &fields);
    // x = S M^-1 W^T of it.
    template <typename Function>
    void spread(NodalVector &x, const Function &value);
    // A power of the void fraction, smoothed, at each own particle.
    std::vector<double> smooth_power(const int exponent);
    void                keep_ledger(const FlowSolver &flow);

    const double                  filter_length;
    const LawVoidFraction         law;
    const std::vector<DragOfType> drags;
    const NodalSpace             &nodes;
    CostSheet                    &costs;
    const Filter                  filter;
    ParticleTransfer              transfer;
    // Of one filter and of two, by cell with own particles.
    std::array<std::vector<OwnMark>, 2> marks;
    Medium                              result;
    NodalVector                         solid_fraction, scratch, smooth_scratch;

    NodalVectorField    interstitial;    // u [m/s]
    NodalVectorField    smooth_velocity; // S u [m/s]
    NodalVectorField    gradient;        // grad p [Pa/m]
    NodalVectorField    smooth_gradient; // S grad p, in model B 0 [Pa/m]
    std::vector<double> volume, beta;    // by row [m^3], [kg/s]
    std::vector<double> answer;          // D by row
    double              old_part = 0.;   // of put_back_old_fields() [-]
    ParticleResponse    response;        // by row
    std::vector<double> flow_alpha;      // alpha by row
    std::vector<double> law_alpha;       // alpha' by row, where the particle is
    std::vector<double> next_alpha;      // and in the middle of the step
    std::vector<double> felt_alpha;      // and upstream, if it is loose
    std::vector<double> slip;            // of the law, by row [m/s]
    std::vector<double> surroundings;    // phi_s by row
    std::vector<double> isolation;       // S(phi_s) by row
    std::vector<double> own_part;        // k F over the slip, by row
    std::vector<double> of_slip;         // W S alpha^-1 by row
    std::vector<double> of_drag;         // W S alpha^-2, in model B alpha^-1, by row
    std::vector<dealii::Tensor<1, 3>> felt_velocity;  // W S u by row [m/s]
    std::vector<dealii::Tensor<1, 3>> solid_gradient; // of the others, by row [1/m]
    dealii::Tensor<1, 3>              fluid_force;
    double                            momentum_error = 0., volume_error = 0.;

    std::optional<AddedForces> added;
  };

  template <typename Function>
  void
  Exchange::deposit(NodalVector                &x,
                    const Function             &value,
                    std::vector<NodalVector *> &fields)
  {
    std::vector<double> values(beta.size());
    for (unsigned int row = 0; row < values.size(); ++row)
      values[row] = value(row);
    transfer.deposit(x, values);
    fields.push_back(&x);
  }

  template <typename Function>
  void
  Exchange::spread(NodalVector &x, const Function &value)
  {
    std::vector<NodalVector *> fields;
    deposit(x, value, fields);
    filter.spread(fields);
  }
} // namespace graupel

#endif
