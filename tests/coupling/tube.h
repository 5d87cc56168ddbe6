// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_coupling_tube_h
#define graupel_tests_coupling_tube_h

#include "../say.h"

#include <graupel/coupling/exchange.h>
#include <graupel/dem/dem.h>

#include <gtest/gtest.h>

#include <optional>

namespace graupel
{
  /** Equal spheres in a tube with a fluid that rises through it. */
  struct Tube
  {
    using ContactForce = std::function<dealii::Tensor<1, 3>(const unsigned int row)>;

    struct Settings
    {
      double                diameter = 0.02, height = 0.05, cell = 2.5e-3; // [m]
      double                particle = 2e-3; // diameter of a sphere [m]
      double                density  = 998.; // of the spheres [kg/m^3]
      FluidProperties       fluid    = {998., 1e-3};
      double                velocity = 0.;       // superficial [m/s]
      std::string           law      = "wen-yu"; // or "none", without drag
      std::optional<double> filter_length;       // [m], instead of auto
      bool                  shares_pressure = true;
      dealii::Tensor<1, 3>  gravity{{0., 0., -9.81}};
      BoundaryParameters    boundaries;
      ForceParameters       forces;
      double                imbalance = 1e-10; // of momentum, the largest to pass [-]

      double
      volume() const
      {
        return sphere_volume(0.5 * particle);
      }

      double
      mass() const
      {
        return density * volume();
      }

      DragOfType
      drag() const
      {
        DragParameters choice;
        if (law == "none")
          {
            choice.scaling    = "expression";
            choice.expression = "0";
          }
        else
          choice.law = law;
        return {Drag(choice, fluid, particle, 1.), 0.5 * particle};
      }

      /** The slip at which drag carries the weight of one sphere in clear fluid [m/s]. */
      double
      terminal_velocity() const
      {
        const double weight =
          std::abs(density - fluid.density) * gravity.norm() * volume();
        const auto of_law = drag();
        double     low = 0., high = 10.;
        for (unsigned int n = 0; n < 60; ++n)
          {
            const double middle = 0.5 * (low + high);
            const double force  = of_law.beta(1., middle, 0.5 * particle) * middle;
            (force < weight ? low : high) = middle;
          }
        return low;
      }
    };

    Tube(const Settings &settings, const std::vector<dealii::Point<3>> &positions)
      : settings(settings)
      , mesh({settings.diameter, settings.height}, {settings.cell, 0.}, MPI_COMM_WORLD)
      , nodes(mesh)
      , dem(dem_parameters(settings), mesh, costs)
      , exchange(settings.filter_length.value_or(settings.particle / std::sqrt(2.)),
                 settings.shares_pressure,
                 {},
                 {settings.drag()},
                 nodes,
                 costs,
                 {settings.forces, settings.fluid, {1.}})
      , flow(flow_parameters(settings),
             settings.fluid.density,
             settings.fluid.viscosity,
             nodes,
             costs)
    {
      flow.share_viscous_stress(settings.forces.viscous_stress);
      flow.set_superficial_velocity(settings.velocity);
      dem.set_gravity(settings.gravity);
      dem.insert(positions);
      dem.synchronise();
    }

    static DemParameters
    dem_parameters(const Settings &settings)
    {
      DemParameters result;
      result.particles.diameter = settings.particle;
      result.particles.density  = settings.density;
      return result;
    }

    static FlowParameters
    flow_parameters(const Settings &settings)
    {
      FlowParameters result;
      result.boundaries = settings.boundaries;
      return result;
    }

    /** A step of the fluid past the spheres where they are. They answer, where @p contact
     * has the forces of their contacts; else they go on as they do. */
    void
    step_fluid(const double dt, const ContactForce &contact = nullptr)
    {
      auto &particles = dem.particles();
      dem.synchronise();
      exchange.update_bed(dem.store(), particles);
      if (contact)
        {
          auto response = particle_response(
            particles, contact, settings.gravity, settings.fluid.density, dt);
          response.step_before = flow.history().last_step;
          exchange.update_drag(particles, response);
        }
      else
        exchange.update_drag(particles);
      flow.step(exchange.medium(), dt);
      particles.external_force =
        exchange.forces(particles, flow, settings.fluid.density, settings.gravity);
      particles.external_torque = exchange.torques(particles, dt);
      particles.solid_fraction  = exchange.solid_fractions();
      // From rest next to nothing is exchanged, beside which round-off is large.
      EXPECT_LE(exchange.momentum_imbalance(), is_from_rest ? 1e-9 : settings.imbalance);
      is_from_rest = false;
    }

    /** A step of both, with spheres that answer or with the explicit drag. */
    void
    step(const double dt, const bool answering = true)
    {
      const auto contact = [&](const unsigned int row) { return dem.contact_force(row); };
      step_fluid(dt, answering ? contact : ContactForce());
      dem.advance(dt);
    }

    /** Of a Body, mean over all spheres. */
    dealii::Tensor<1, 3>
    mean(dealii::Tensor<1, 3> Body::*value) const
    {
      dealii::Tensor<1, 3> sum;
      for (unsigned int row = 0; row < dem.particles().n_owned; ++row)
        sum += dem.particles().body[row].*value;
      return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD) / dem.n_global();
    }

    double
    rise_velocity() const
    {
      return mean(&Body::velocity)[2];
    }

    const Settings settings;
    CostSheet      costs;
    VesselMesh     mesh;
    NodalSpace     nodes;
    Dem            dem;
    Exchange       exchange;
    FlowSolver     flow;
    bool           is_from_rest = true;
  };
} // namespace graupel

#endif
