// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/closures/sphere_forces.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace graupel
{
  namespace
  {
    using Vector        = dealii::Tensor<1, 3>;
    constexpr double pi = dealii::numbers::PI;

    // nullptr for "none".
    template <typename Law>
    const Law *
    find(const std::vector<Law> &laws, const std::string &name)
    {
      for (const Law &law : laws)
        if (law.name == name)
          return &law;
      return nullptr;
    }

    template <typename Law>
    std::string
    names(const std::vector<Law> &laws)
    {
      std::string result = "none";
      for (const Law &law : laws)
        result += "|" + law.name;
      return result;
    }

    template <typename Law>
    std::string
    forms(const std::vector<Law> &laws)
    {
      std::string result;
      for (const Law &law : laws)
        result += " " + law.name + ": " + law.form + " (" + law.source + ").";
      return result;
    }
  } // namespace

  double
  constant_virtual_mass(const double)
  {
    return 0.5;
  }

  double
  zuber_virtual_mass(const double alpha)
  {
    return 0.5 * (3. - 2. * alpha) / alpha;
  }

  double
  saffman_lift(const double, const double)
  {
    return 1.615;
  }

  double
  saffman_mei_lift(const double reynolds, const double shear_reynolds)
  {
    const double root = std::sqrt(0.5 * shear_reynolds); // (b Re)^1/2
    if (reynolds > 40.)
      return 1.615 * 0.0524 * root;
    const double rest = reynolds > 0. ? -std::expm1(-reynolds / 10.) : 0.;
    const double fast = rest > 0. ? 0.3314 * root / std::sqrt(reynolds) * rest : 0.;
    return 1.615 * (1. - rest + fast);
  }

  double
  rubinow_keller_lift(const double)
  {
    return 1.;
  }

  double
  lun_liu_lift(const double reynolds)
  {
    return reynolds > 1. ? 0.178 + 0.822 * std::pow(reynolds, -0.522) : 1.;
  }

  double
  rubinow_keller_torque(const double)
  {
    return 1.;
  }

  double
  dennis_torque(const double spin_reynolds)
  {
    return spin_reynolds > 32. ? (12.9 * std::sqrt(spin_reynolds) + 128.4) / (64. * pi)
                               : 1.;
  }

  const std::vector<VirtualMassLaw> &
  virtual_mass_laws()
  {
    static const std::vector<VirtualMassLaw> laws{
      {"constant", constant_virtual_mass, "C = 1/2", "Lamb (1932)"},
      {"zuber", zuber_virtual_mass, "C = 1/2 (3 - 2 alpha) / alpha", "Zuber (1964)"}};
    return laws;
  }

  const std::vector<ShearLiftLaw> &
  shear_lift_laws()
  {
    static const std::vector<ShearLiftLaw> laws{
      {"saffman",
       saffman_lift,
       "1.615 d^2 (rho mu / |w|)^1/2 (u - v) x w, for slow flow",
       "Saffman (1965, 1968)"},
      {"saffman-mei",
       saffman_mei_lift,
       "the same with a factor of the Reynolds numbers of slip and shear",
       "Mei (1992)"}};
    return laws;
  }

  const std::vector<SpinLiftLaw> &
  spin_lift_laws()
  {
    static const std::vector<SpinLiftLaw> laws{
      {"rubinow-keller",
       rubinow_keller_lift,
       "pi/8 rho d^3 (w/2 - spin) x (u - v), for slow flow",
       "Rubinow & Keller (1961)"},
      {"lun-liu",
       lun_liu_lift,
       "the same times 0.178 + 0.822 Re^-0.522 beyond Re = 1",
       "Lun & Liu (1997)"}};
    return laws;
  }

  const std::vector<RotationalDragLaw> &
  rotational_drag_laws()
  {
    static const std::vector<RotationalDragLaw> laws{
      {"rubinow-keller",
       rubinow_keller_torque,
       "the torque pi mu d^3 (w/2 - spin), for slow spin",
       "Rubinow & Keller (1961)"},
      {"dennis",
       dennis_torque,
       "the same times (12.9 Re^1/2 + 128.4) / (64 pi) beyond Re = rho d^2 |w/2 - spin| "
       "/ mu = 32",
       "Dennis, Singh & Ingham (1980)"}};
    return laws;
  }

  void
  ForceParameters::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Selection;
    prm.enter_subsection("Forces");
    prm.add_parameter("virtual mass",
                      virtual_mass,
                      "The fluid that a particle takes along when it accelerates: the "
                      "force C rho V (Du/Dt - dv/dt), also on particles at rest in a "
                      "fluid that accelerates." +
                        forms(virtual_mass_laws()),
                      Selection(names(virtual_mass_laws())));
    prm.add_parameter(
      "viscous stress",
      viscous_stress,
      "Whether fluid and solids share the divergence of the viscous stress by their "
      "volumes, as they share the pressure gradient in model A. Without, the fluid has "
      "all of it.");
    prm.add_parameter("shear lift",
                      shear_lift,
                      "The force across its slip u - v on a particle in a fluid of the "
                      "vorticity w." +
                        forms(shear_lift_laws()),
                      Selection(names(shear_lift_laws())));
    prm.add_parameter("spin lift",
                      spin_lift,
                      "The force across its slip u - v on a particle that spins, which "
                      "is Magnus' effect." +
                        forms(spin_lift_laws()),
                      Selection(names(spin_lift_laws())));
    prm.add_parameter("rotational drag",
                      rotational_drag,
                      "The torque of the fluid on a particle that spins otherwise than "
                      "the fluid; while particles move with the fluid, not in a steady "
                      "flow past particles at rest." +
                        forms(rotational_drag_laws()),
                      Selection(names(rotational_drag_laws())));
    prm.leave_subsection();
  }

  void
  ForceParameters::check(const double scale, const std::string &model) const
  {
    for (const auto &[name, value] :
         {std::pair("spin lift", spin_lift), {"rotational drag", rotational_drag}})
      require(value == "none" || scale == 1.,
              std::string("Forces/") + name,
              value + " is a law for the spin of a sphere, and the particles of scale " +
                std::to_string(scale) +
                " stand for several spheres, whose spins they do not know; set it to "
                "none, or the scale to 1");
    require(!viscous_stress || model == "A",
            "Forces/viscous stress",
            "in model B the fluid has all of the pressure gradient and of the viscous "
            "stress; set it to false, or Coupling/model to A");
  }

  bool
  ForceParameters::any() const
  {
    return viscous_stress || virtual_mass != "none" || shear_lift != "none" ||
           spin_lift != "none" || rotational_drag != "none";
  }

  SphereForces::SphereForces(const ForceParameters &parameters,
                             const FluidProperties &fluid)
    : fluid(fluid)
    , virtual_mass_law(find(virtual_mass_laws(), parameters.virtual_mass))
    , shear_lift_law(find(shear_lift_laws(), parameters.shear_lift))
    , spin_lift_law(find(spin_lift_laws(), parameters.spin_lift))
    , rotational_drag_law(find(rotational_drag_laws(), parameters.rotational_drag))
  {
  }

  double
  SphereForces::virtual_mass(const double alpha, const double volume) const
  {
    return virtual_mass_law ? virtual_mass_law->number(alpha) * fluid.density * volume
                            : 0.;
  }

  Vector
  SphereForces::lift(const double  diameter,
                     const double  scale,
                     const Vector &slip,
                     const Vector &vorticity,
                     const Vector &relative_spin) const
  {
    const double d = diameter / scale, rho = fluid.density, mu = fluid.viscosity;
    const double reynolds = rho * slip.norm() * d / mu, shear = vorticity.norm();
    Vector       force;
    if (shear_lift_law && shear > 0.)
      force += shear_lift_law->number(reynolds, rho * d * d * shear / mu) * d * d *
               std::sqrt(rho * mu / shear) * dealii::cross_product_3d(slip, vorticity);
    if (spin_lift_law)
      force += spin_lift_law->number(reynolds) * pi / 8. * rho * d * d * d *
               dealii::cross_product_3d(relative_spin, slip);
    return scale * scale * scale * force;
  }

  Vector
  SphereForces::torque(const double  diameter,
                       const double  inertia,
                       const double  step,
                       const Vector &relative_spin) const
  {
    if (!rotational_drag_law)
      return {};
    const double mu = fluid.viscosity;
    const double reynolds =
      fluid.density * diameter * diameter * relative_spin.norm() / mu;
    const double rate = rotational_drag_law->number(reynolds) * pi * mu * diameter *
                        diameter * diameter / inertia;
    return -inertia * std::expm1(-rate * step) / step * relative_spin;
  }
} // namespace graupel
