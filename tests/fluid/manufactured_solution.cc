#include <graupel/fluid/manufactured_solution.h>

#include <deal.II/base/convergence_table.h>
#include <deal.II/base/mpi.h>
#include <gtest/gtest.h>

using namespace graupel;

namespace
{
  // A vessel of diameter and height 1 m with a liquid in which convection,
  // viscosity and drag weigh alike.
  constexpr double density = 1., viscosity = 0.1;
  const Cylinder   vessel{1., 1.};

  ManufacturedParameters
  swirling_flow(const std::string &void_fraction, const std::string &drag)
  {
    ManufacturedParameters result;
    result.void_fraction     = void_fraction;
    result.velocity          = "0.3*sin(2*y+z)*cos(t); 0.3*cos(2*x)*sin(1+z); "
                               "1+0.3*sin(x+y+2*z)*cos(t)";
    result.pressure          = "sin(2*x)*cos(2*y)+cos(2*z)*(1+0.5*sin(t))";
    result.drag              = drag;
    result.particle_velocity = "0.1; 0; 0.2*x";
    return result;
  }

  struct Case
  {
    std::string name, void_fraction, drag;
  };

  const std::vector<Case> cases{
    {"alpha constant, no drag", "0.6", "0"},
    {"alpha constant, drag", "0.6", "20*(1+0.3*x)"},
    {"alpha(x), no drag", "0.6+0.2*sin(2*x)*cos(2*z)", "0"},
    {"alpha(x), drag", "0.6+0.2*sin(2*x)*cos(2*z)", "20*(1+0.3*x)"},
    {"alpha(x,t), no drag", "0.6+0.2*sin(2*x+t)*cos(2*z)", "0"},
    {"alpha(x,t), drag", "0.6+0.2*sin(2*x+t)*cos(2*z)", "20*(1+0.3*x+0.3*t)"}};
} // namespace

TEST(ManufacturedSolution, ConvergesInSpace)
{
  for (const Case &flow : cases)
    {
      const bool             steady = flow.name.find("x,t") == std::string::npos;
      ManufacturedParameters given  = swirling_flow(flow.void_fraction, flow.drag);
      given.duration                = steady ? 0. : 0.1;
      FlowParameters parameters;
      parameters.time_scheme = "bdf2";
      dealii::ConvergenceTable table;
      for (const unsigned int n : {4, 8, 16})
        {
          CostSheet        costs;
          const VesselMesh mesh(vessel, {1. / n, 0.}, MPI_COMM_WORLD);
          const NodalSpace nodes(mesh);
          const auto       errors = ManufacturedSolution(given, density, viscosity)
                                .run(parameters, nodes, 0.02, costs);
          table.add_value("cells", mesh.triangulation().n_global_active_cells());
          table.add_value("flux", errors.flux);
          table.add_value("pressure", errors.pressure);
          table.add_value("solves", errors.solves);
        }
      for (const std::string quantity : {"flux", "pressure"})
        {
          table.set_scientific(quantity, true);
          table.evaluate_convergence_rates(
            quantity, "cells", dealii::ConvergenceTable::reduction_rate_log2, 3);
        }
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        {
          std::cout << flow.name << '\n';
          table.write_text(std::cout);
        }
    }
}
