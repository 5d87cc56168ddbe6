// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_dem_parameters_h
#define graupel_dem_dem_parameters_h

#include <graupel/dem/laws/materials.h>
#include <graupel/dem/particles/particle_types.h>
#include <graupel/dem/walls/walls.h>
#include <graupel/mesh/cylinder.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>
#include <vector>

namespace graupel
{
  /** The spheres. */
  struct ParticleParameters
  {
    /** Diameter of the original particles, which the drag laws see [m]. */
    double diameter = 1.6e-3;
    /** Diameter of a simulated particle over that of an original one [-]. */
    double scale = 1.;
    /** Density of the solid [kg/m^3]. */
    double density = 2700.;
    /** Acceleration of gravity, its size [m/s^2]. */
    double gravity = 9.81;
    /** Unit vector along gravity. */
    dealii::Tensor<1, 3> gravity_direction = dealii::Tensor<1, 3>({0., 0., -1.});
    /** Sizes of the first type, which has diameter, scale and density above. */
    SizeDistribution sizes;
    /** Types 2 to 4. */
    std::array<ParticleType, 3> further_types;

    /** Radius of a simulated particle of the first type, if that has one size [m]. */
    double
    simulated_radius() const
    {
      return 0.5 * scale * diameter;
    }

    /** Mass of a simulated particle [kg]. */
    double simulated_mass() const;

    /** Declares the section "Particles". */
    void declare(dealii::ParameterHandler &prm);
    /** Throws InputError for values that cannot be. */
    void check() const;

    /** Whether gravity, if there is any, points down along the axis of the vessel. */
    bool
    gravity_is_axial() const
    {
      return gravity == 0. || gravity_direction[2] == -1.;
    }

  private:
    // One number, or three.
    void set_gravity(const std::string &text);
  };

  /** The laws of contact and their numbers. */
  struct ContactParameters
  {
    /** "hertz-mindlin", "linear-spring" or "jkr". */
    std::string model = "hertz-mindlin";
    /** "spring-dashpot", "constant-torque" or "none". */
    std::string rolling_model = "spring-dashpot";

    Elasticity particle_elasticity{1e7, 0.33};
    Elasticity wall_elasticity{1e7, 0.33};
    Surface    particle_surface{0.5, 0.5, 0.1};
    Surface    wall_surface{0.5, 0.5, 0.1};
    /** Friction and rolling resistance [-] while the bed is filled and settles. */
    double packing_particle_friction = 0.08;
    double packing_particle_rolling  = 0.;
    double packing_wall_friction     = 0.08;
    double packing_wall_rolling      = 0.;

    /** Pairs that differ, as in "1-2 friction 0.3, 2-wall restitution 0.9". */
    std::string pairs;

    /** Normal stiffness of the linear law, for original particles [N/m]. */
    double normal_stiffness = 1000.;
    /** Tangential over normal stiffness of the linear law [-]. */
    double stiffness_ratio = 2. / 7.;
    /** Substep over the characteristic time [-]. */
    double time_fraction = 0.2;
    /** Substep [s]; zero: by time_fraction. */
    double substep = 0.;
    /** Skin of the neighbour list over the particle diameter [-]. */
    double skin = 0.4;

    /** Declares the section "Contact". */
    void declare(dealii::ParameterHandler &prm);
    void check() const;

  private:
    void declare_laws(dealii::ParameterHandler &prm);
    void declare_surfaces(dealii::ParameterHandler &prm);
    void declare_steps(dealii::ParameterHandler &prm);
  };

  /** All that the solver of the particles needs to be told. */
  struct DemParameters
  {
    ParticleParameters particles;
    ContactParameters  contact;
    WallParameters     walls;

    void declare(dealii::ParameterHandler &prm);
    /** Throws InputError for values that cannot be, alone or together. */
    void check(const Cylinder &cylinder) const;

    /**
     * The time that bounds the substep [s]: the shortest Rayleigh time of a particle,
     * or sqrt(m/k_n)/4 for linear springs, a ninth of an impact.
     */
    double characteristic_time() const;
    /** The longest substep that is used [s]. */
    double substep() const;
    /**
     * Force of a contact between two particles at an overlap of 10 % of their
     * radius [N].
     */
    double reference_force() const;
    /** Overlap that a static force makes between two particles [m]. */
    double overlap_under(const double force) const;

    /** Acceleration of gravity [m/s^2]. */
    dealii::Tensor<1, 3>
    gravity() const
    {
      return particles.gravity * particles.gravity_direction;
    }

    /** The types in use; the first is that of Particles and Contact. */
    std::vector<ParticleType> types() const;
    /** Radius of the largest simulated particle of any type [m]. */
    double largest_radius() const;
    /**
     * Sauter mean diameter of the simulated particles that are filled in, of all types
     * by their sizes and mass fractions [m]; exactly the diameter if they have one.
     */
    double mean_simulated_diameter() const;
    /** The same of the original particles, which the drag laws see [m]. */
    double mean_original_diameter() const;
    /** Normal stiffness of the linear law for simulated particles [N/m]. */
    double normal_stiffness() const;

    NormalLaws  normal_law() const;
    RollingLaws rolling_law() const;
    /**
     * Materials of all types of particles and of these walls, with the friction of
     * packing or that of the flow.
     */
    Materials materials(const bool packing, const std::vector<Wall> &vessel) const;

    /** Substep over the characteristic time above which a run is refused [-]. */
    static constexpr double largest_time_fraction = 0.4;

  private:
    void check_sizes(const Cylinder &cylinder) const;
    void check_pairs() const;
    // What "Contact/pairs" says of this pair, put into @p surface.
    void override_surface(const std::string &pair, Surface &surface) const;
  };
} // namespace graupel

#endif
