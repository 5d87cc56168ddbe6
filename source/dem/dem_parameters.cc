#include <graupel/base/parameters.h>
#include <graupel/dem/dem_parameters.h>
#include <graupel/dem/particle_arrays.h>

#include <sstream>

namespace graupel
{
  using dealii::Patterns::Selection;

  namespace
  {
    void
    check_friction(const double friction, const double rolling, const std::string &which)
    {
      require(friction >= 0. && friction <= 10.,
              "Contact/" + which + " friction",
              "a coefficient of friction lies between 0 and about 1");
      require(rolling >= 0. && rolling <= 1.,
              "Contact/" + which + " rolling resistance",
              "a coefficient of rolling resistance lies between 0 and 1; 0.1 is usual");
    }

    void
    check_surface(const Surface &surface, const std::string &which)
    {
      require(surface.restitution >= 0.01 && surface.restitution <= 1.,
              "Contact/" + which + " restitution",
              "a collision returns between 0.01 and 1 of the approach speed");
      check_friction(surface.friction, surface.rolling_resistance, which);
    }

    void
    check_elasticity(const Elasticity &elasticity, const std::string &which)
    {
      require(elasticity.young_modulus > 0.,
              "Contact/" + which + " Young's modulus",
              "a solid needs a positive modulus, in pascal");
      require(elasticity.poisson_ratio >= 0. && elasticity.poisson_ratio <= 0.5,
              "Contact/" + which + " Poisson's ratio",
              "an isotropic solid has a ratio between 0 and 0.5");
    }

    std::string
    number(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }
  } // namespace

  double
  ParticleParameters::simulated_mass() const
  {
    return density * sphere_volume(simulated_radius());
  }

  void
  ParticleParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Particles");
    prm.add_parameter("diameter",
                      diameter,
                      "Diameter of the original particles, those of the real bed [m].");
    prm.add_parameter(
      "scale",
      scale,
      "Diameter of a simulated particle over that of an original one; each "
      "simulated particle stands for scale^3 original ones [-].");
    prm.add_parameter("density", density, "Density of the solid [kg/m^3].");
    prm.add_parameter(
      "gravity", gravity, "Acceleration of gravity, downwards along the axis [m/s^2].");
    prm.leave_subsection();
  }

  void
  ParticleParameters::check(const Cylinder &cylinder) const
  {
    require(diameter > 0.,
            "Particles/diameter",
            "a sphere needs a positive diameter, in metres");
    require(scale >= 1.,
            "Particles/scale",
            "scaled particles are larger than the original ones: choose 1 or more");
    require(
      density > 0., "Particles/density", "a solid needs a positive density, in kg/m^3");
    require(gravity >= 0.,
            "Particles/gravity",
            "gravity points downwards already; its size cannot be negative");
    require(
      2. * scale * diameter < cylinder.diameter && scale * diameter < cylinder.height,
      "Particles/diameter",
      "the simulated diameter " + number(scale * diameter) +
        " m does not go twice into the cylinder's diameter " + number(cylinder.diameter) +
        " m and once into its height " + number(cylinder.height) +
        " m: no bed fits. Lengths are in metres; is Particles/scale too large?");
  }

  void
  ContactParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Contact");
    declare_laws(prm);
    declare_surfaces(prm);
    declare_steps(prm);
    prm.leave_subsection();
  }

  void
  ContactParameters::declare_laws(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "model",
      model,
      "Law of the normal and tangential force: hertz-mindlin (elastic spheres) "
      "or linear-spring.",
      Selection("hertz-mindlin|linear-spring"));
    prm.add_parameter(
      "rolling model",
      rolling_model,
      "Law of the resistance to rolling: spring-dashpot (an elastic-plastic "
      "rolling spring, no viscous part), constant-torque, or none.",
      Selection("spring-dashpot|constant-torque|none"));
    prm.add_parameter(
      "particle Young's modulus",
      particle_elasticity.young_modulus,
      "Young's modulus of the particles, usually reduced far below that of the "
      "real solid so that substeps are longer [Pa].");
    prm.add_parameter("particle Poisson's ratio",
                      particle_elasticity.poisson_ratio,
                      "Poisson's ratio of the particles [-].");
    prm.add_parameter("wall Young's modulus",
                      wall_elasticity.young_modulus,
                      "Young's modulus of the walls [Pa].");
    prm.add_parameter("wall Poisson's ratio",
                      wall_elasticity.poisson_ratio,
                      "Poisson's ratio of the walls [-].");
    prm.add_parameter("normal stiffness",
                      normal_stiffness,
                      "Normal stiffness of the linear-spring model [N/m].");
    prm.add_parameter("stiffness ratio",
                      stiffness_ratio,
                      "Tangential over normal stiffness of the linear-spring model [-].");
  }

  void
  ContactParameters::declare_surfaces(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("particle restitution",
                      particle_surface.restitution,
                      "Coefficient of restitution between particles [-].");
    prm.add_parameter("particle friction",
                      particle_surface.friction,
                      "Coefficient of friction between particles while fluid flows [-].");
    prm.add_parameter(
      "particle rolling resistance",
      particle_surface.rolling_resistance,
      "Coefficient of rolling resistance between particles while fluid flows [-].");
    prm.add_parameter("wall restitution",
                      wall_surface.restitution,
                      "Coefficient of restitution between particle and wall [-].");
    prm.add_parameter(
      "wall friction",
      wall_surface.friction,
      "Coefficient of friction between particle and wall while fluid flows [-].");
    prm.add_parameter(
      "wall rolling resistance",
      wall_surface.rolling_resistance,
      "Coefficient of rolling resistance between particle and wall while fluid "
      "flows [-].");
    prm.add_parameter(
      "packing particle friction",
      packing_particle_friction,
      "Coefficient of friction between particles while the bed is filled and "
      "settles; it decides how dense the bed becomes [-].");
    prm.add_parameter(
      "packing particle rolling resistance",
      packing_particle_rolling,
      "Coefficient of rolling resistance between particles while the bed is "
      "filled and settles [-].");
    prm.add_parameter(
      "packing wall friction",
      packing_wall_friction,
      "Coefficient of friction between particle and wall while the bed is filled "
      "and settles [-].");
    prm.add_parameter(
      "packing wall rolling resistance",
      packing_wall_rolling,
      "Coefficient of rolling resistance between particle and wall while the bed "
      "is filled and settles [-].");
  }

  void
  ContactParameters::declare_steps(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "time fraction",
      time_fraction,
      "Substep as a fraction of the Rayleigh time, or of sqrt(m/k)/4 for the "
      "linear-spring model, whose impacts last 9 of these [-].");
    prm.add_parameter(
      "substep",
      substep,
      "Substep of the particles; zero takes it from the time fraction [s].");
    prm.add_parameter(
      "skin",
      skin,
      "Distance beyond touching up to which neighbours are listed, in particle "
      "diameters; a wider skin needs fewer, longer lists [-].");
  }

  void
  ContactParameters::check() const
  {
    check_elasticity(particle_elasticity, "particle");
    check_elasticity(wall_elasticity, "wall");
    check_surface(particle_surface, "particle");
    check_surface(wall_surface, "wall");
    check_friction(
      packing_particle_friction, packing_particle_rolling, "packing particle");
    check_friction(packing_wall_friction, packing_wall_rolling, "packing wall");
    require(normal_stiffness > 0.,
            "Contact/normal stiffness",
            "a spring needs a positive stiffness, in N/m");
    require(
      stiffness_ratio > 0. && stiffness_ratio <= 1.,
      "Contact/stiffness ratio",
      "the tangential spring is the softer one: choose between 0 and 1, 2/7 is usual");
    require(time_fraction > 0. && time_fraction <= DemParameters::largest_time_fraction,
            "Contact/time fraction",
            "contacts are integrated stably and accurately up to a fraction of " +
              number(DemParameters::largest_time_fraction) + "; 0.2 is usual");
    require(
      substep >= 0., "Contact/substep", "a step forward in time is positive, in seconds");
    require(skin > 0. && skin <= 2.,
            "Contact/skin",
            "without a skin the neighbour list is old at once, with a wide one it holds "
            "the whole "
            "bed; choose 0.2 to 0.3");
  }

  void
  DemParameters::declare(dealii::ParameterHandler &prm)
  {
    particles.declare(prm);
    contact.declare(prm);
    walls.declare(prm);
  }

  void
  DemParameters::check(const Cylinder &cylinder) const
  {
    particles.check(cylinder);
    contact.check();
    walls.check();
    require(!walls.is_periodic() || cylinder.height > 6. * largest_radius(),
            "Walls/top",
            "a periodic vessel must be higher than three particles, or one would touch "
            "its own image");
    const double longest = largest_time_fraction * characteristic_time();
    require(contact.substep <= longest,
            "Contact/substep",
            "the contacts are unstable or inaccurate above " + number(longest) + " s, " +
              number(largest_time_fraction) + " of the characteristic time " +
              number(characteristic_time()) +
              " s; choose a shorter substep (zero for the default) or a softer material");
  }

  double
  DemParameters::characteristic_time() const
  {
    if (contact.model == "linear-spring")
      return 0.25 * std::sqrt(particles.simulated_mass() / contact.normal_stiffness);
    return rayleigh_time(
      particles.simulated_radius(), particles.density, contact.particle_elasticity);
  }

  double
  DemParameters::substep() const
  {
    return contact.substep > 0. ? contact.substep
                                : contact.time_fraction * characteristic_time();
  }

  double
  DemParameters::reference_force() const
  {
    const double r       = particles.simulated_radius();
    const double overlap = 0.1 * r;
    if (contact.model == "linear-spring")
      return contact.normal_stiffness * overlap;
    return 4. / 3. * materials(false, 0).between(0, 0).young *
           std::sqrt(0.5 * r * overlap) * overlap;
  }

  double
  DemParameters::overlap_under(const double force) const
  {
    if (contact.model == "linear-spring")
      return force / contact.normal_stiffness;
    return hertz_overlap(
      force, materials(false, 0).between(0, 0).young, 0.5 * particles.simulated_radius());
  }

  NormalLaws
  DemParameters::normal_law() const
  {
    if (contact.model == "linear-spring")
      return LinearSpring{};
    return HertzMindlin{};
  }

  RollingLaws
  DemParameters::rolling_law() const
  {
    if (contact.rolling_model == "none")
      return FreeRolling{};
    if (contact.rolling_model == "constant-torque")
      return ConstantRollingTorque{};
    return SpringRolling{};
  }

  Materials
  DemParameters::materials(const bool packing, const unsigned int n_walls) const
  {
    Surface between = contact.particle_surface, with_wall = contact.wall_surface;
    if (packing)
      {
        between.friction             = contact.packing_particle_friction;
        between.rolling_resistance   = contact.packing_particle_rolling;
        with_wall.friction           = contact.packing_wall_friction;
        with_wall.rolling_resistance = contact.packing_wall_rolling;
      }
    const PairMaterial particle_pair(contact.particle_elasticity,
                                     contact.particle_elasticity,
                                     between,
                                     contact.normal_stiffness,
                                     contact.stiffness_ratio);
    const PairMaterial wall_pair(contact.particle_elasticity,
                                 contact.wall_elasticity,
                                 with_wall,
                                 contact.normal_stiffness,
                                 contact.stiffness_ratio);
    return {{particles.density},
            {particle_pair},
            std::vector<PairMaterial>(n_walls, wall_pair)};
  }
} // namespace graupel
