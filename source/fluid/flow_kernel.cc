#include <graupel/fluid/flow_kernel.h>

namespace graupel
{
  namespace
  {
    using dealii::Tensor;

    // Of rho tau and the time step: at 200 the stabilisation, which sees no acceleration
    // at the nodes of an inlet, makes pressure oscillate from step to step.
    constexpr double largest_time_ratio = 30.;

    // The fields of the cell at the point.
    struct PointState
    {
      double       void_fraction      = 0.;
      double       resistance         = 0.;
      double       pressure_share     = 0.;
      double       void_fraction_rate = 0.;
      double       flux_divergence    = 0.;
      Tensor<1, 3> flux;
      Tensor<1, 3> history;
      Tensor<1, 3> drag_source;
      // The known terms of the momentum residual [N/m^3].
      Tensor<1, 3> source;
    };

    PointState
    interpolate(const FlowCoefficients &coefficients,
                const CellState        &state,
                const ShapePoint       &point)
    {
      PointState result;
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        {
          const double psi = point.value[a];
          result.void_fraction += psi * state.void_fraction[a];
          result.resistance += psi * state.resistance[a];
          result.pressure_share += psi * state.pressure_share[a];
          result.void_fraction_rate += psi * state.void_fraction_rate[a];
          result.flux_divergence += point.gradient[a] * state.flux[a];
          result.flux += psi * state.flux[a];
          result.history += psi * state.history[a];
          result.drag_source += psi * state.drag_source[a];
          result.source += psi * state.force[a];
        }
      result.source += result.drag_source - coefficients.density * result.history;
      return result;
    }
  } // namespace

  double
  stabilization_time(const FlowCoefficients &coefficients,
                     const double            resistance,
                     const double            size)
  {
    const double convection = 2. * coefficients.density * coefficients.speed / size;
    const double diffusion  = 12. * coefficients.viscosity / (size * size);
    const double inertia = coefficients.density * coefficients.rate / largest_time_ratio;
    return 1. / std::sqrt(resistance * resistance + inertia * inertia +
                          convection * convection + diffusion * diffusion);
  }

  void
  add_flow_point(const FlowCoefficients     &coefficients,
                 const CellState            &state,
                 const ShapePoint           &point,
                 dealii::FullMatrix<double> &matrix,
                 dealii::Vector<double>     &rhs)
  {
    const double     rho   = coefficients.density;
    const PointState here  = interpolate(coefficients, state, point);
    const double     alpha = here.void_fraction;
    const double     speed = here.flux.norm() / alpha;
    const double     tau = stabilization_time(coefficients, here.resistance, state.size);
    const double     gamma =
      coefficients.grad_div * (rho * speed * state.size + coefficients.viscosity) / alpha;
    const double mu_alpha = coefficients.viscosity * alpha;

    std::array<double, nodes_per_cell> galerkin; // acceleration and convection of node b
    std::array<double, nodes_per_cell> strong;   // the same with the drag: its residual
    std::array<double, nodes_per_cell> upwind;   // test function of SUPG
    // Where the drag is put on the nodes, it enters the residual only.
    const double       drag_here      = state.drag_on_nodes ? 0. : 1.;
    const Tensor<1, 3> galerkin_force = here.source - (1. - drag_here) * here.drag_source;
    for (unsigned int b = 0; b < nodes_per_cell; ++b)
      {
        const double along = here.flux * point.gradient[b];
        const double psi   = point.value[b];
        galerkin[b] =
          rho * (coefficients.rate * psi +
                 (along + here.flux_divergence * psi) / state.void_fraction[b]);
        strong[b] = galerkin[b] + state.resistance[b] * psi;
        galerkin[b] += drag_here * state.resistance[b] * psi;
        upwind[b] = tau * rho * along / alpha;
      }

    for (unsigned int a = 0; a < nodes_per_cell; ++a)
      {
        const Tensor<1, 3> grad_a = point.gradient[a];
        const double       psi_a  = point.value[a];
        const unsigned int row    = unknowns_per_node * a;
        for (unsigned int b = 0; b < nodes_per_cell; ++b)
          {
            const Tensor<1, 3> grad_b   = point.gradient[b];
            const unsigned int column   = unknowns_per_node * b;
            const double       friction = mu_alpha / state.void_fraction[b];
            const double       diagonal =
              psi_a * galerkin[b] + upwind[a] * strong[b] + friction * (grad_a * grad_b);
            const double pressure_weight =
              state.pressure_share[a] * psi_a + upwind[a] * here.pressure_share;
            for (unsigned int i = 0; i < 3; ++i)
              {
                matrix(row + i, column + i) += point.weight * diagonal;
                for (unsigned int j = 0; j < 3; ++j)
                  matrix(row + i, column + j) +=
                    point.weight * (friction * grad_a[j] * grad_b[i] +
                                    (gamma - 2. / 3. * friction) * grad_a[i] * grad_b[j]);
                matrix(row + i, column + 3) += point.weight * pressure_weight * grad_b[i];
                matrix(row + 3, column + i) +=
                  point.weight * grad_a[i] * (tau * strong[b] - point.value[b]);
              }
            matrix(row + 3, column + 3) +=
              point.weight * tau * here.pressure_share * (grad_a * grad_b);
          }

        for (unsigned int i = 0; i < 3; ++i)
          rhs[row + i] +=
            point.weight * (psi_a * galerkin_force[i] + upwind[a] * here.source[i] -
                            gamma * grad_a[i] * here.void_fraction_rate);
        rhs[row + 3] += point.weight * (tau * (grad_a * here.source) -
                                        psi_a * state.void_fraction_rate[a]);
      }
  }
} // namespace graupel
