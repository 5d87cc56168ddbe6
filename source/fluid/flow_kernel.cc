#include <graupel/fluid/flow_kernel.h>

namespace graupel
{
  namespace
  {
    using dealii::Tensor;

    // The fields of the cell at the point.
    struct PointState
    {
      double       void_fraction      = 0.;
      double       resistance         = 0.;
      double       pressure_share     = 0.;
      double       void_fraction_rate = 0.;
      double       flux_divergence    = 0.;
      double       solids_by_gradient = 0.;
      double       solid_divergence   = 0.;
      Tensor<1, 3> solid_flux;
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
          result.solids_by_gradient += psi * state.solids_by_gradient[a];
          result.solid_divergence += point.gradient[a] * state.solid_flux[a];
          result.solid_flux += psi * state.solid_flux[a];
          result.flux += psi * state.flux[a];
          result.history += psi * state.history[a];
          result.drag_source += psi * state.drag_source[a];
          result.source += psi * state.force[a];
        }
      result.source += result.drag_source - coefficients.density * result.history;
      return result;
    }

    // Acceleration and convection of the flux at node b.
    double
    inertia(const FlowCoefficients &coefficients,
            const CellState        &state,
            const ShapePoint       &point,
            const PointState       &here,
            const unsigned int      b)
    {
      return coefficients.density *
             (coefficients.rate * point.value[b] +
              (here.flux * point.gradient[b] + here.flux_divergence * point.value[b]) /
                state.void_fraction[b]);
    }
  } // namespace

  double
  stabilization_time(const FlowCoefficients &coefficients,
                     const double            resistance,
                     const double            size)
  {
    const double convection = 2. * coefficients.density * coefficients.speed / size;
    const double diffusion  = 12. * coefficients.viscosity / (size * size);
    return 1. / (coefficients.density * coefficients.subscale_rate +
                 std::sqrt(resistance * resistance + convection * convection +
                           diffusion * diffusion));
  }

  void
  add_flow_point(const FlowCoefficients     &coefficients,
                 const CellState            &state,
                 const ShapePoint           &point,
                 const Tensor<1, 3>         &subscale_history,
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
    const double mu_alpha = coefficients.viscosity * (state.whole_stress ? 1. : alpha);

    std::array<double, nodes_per_cell> galerkin; // acceleration and convection of node b
    std::array<double, nodes_per_cell> strong;   // the same with the drag: its residual
    std::array<double, nodes_per_cell> upwind;   // test function of SUPG
    // Where the drag is put on the nodes, it enters the residual only.
    const double       drag_here      = state.drag_on_nodes ? 0. : 1.;
    const Tensor<1, 3> galerkin_force = here.source - (1. - drag_here) * here.drag_source;
    const Tensor<1, 3> residual_source = here.source - rho * subscale_history;
    for (unsigned int b = 0; b < nodes_per_cell; ++b)
      {
        galerkin[b]       = inertia(coefficients, state, point, here, b);
        const double drag = state.resistance[b] * point.value[b];
        strong[b]         = galerkin[b] + drag;
        galerkin[b] += drag_here * drag;
        upwind[b] = tau * rho * (here.flux * point.gradient[b]) / alpha;
      }

    for (unsigned int a = 0; a < nodes_per_cell; ++a)
      {
        const Tensor<1, 3> grad_a = point.gradient[a];
        const double       psi_a  = point.value[a];
        const unsigned int row    = unknowns_per_node * a;
        for (unsigned int b = 0; b < nodes_per_cell; ++b)
          {
            const Tensor<1, 3> grad_b      = point.gradient[b];
            const unsigned int column      = unknowns_per_node * b;
            const double       friction    = mu_alpha / state.void_fraction[b];
            const double       with_solids = 1. + state.solids_by_flux[b];
            const double       diagonal =
              psi_a * galerkin[b] + upwind[a] * strong[b] + friction * (grad_a * grad_b);
            const double pressure_weight =
              state.pressure_share[a] * psi_a + upwind[a] * here.pressure_share;
            for (unsigned int i = 0; i < 3; ++i)
              {
                matrix(row + i, column + i) += point.weight * diagonal;
                for (unsigned int j = 0; j < 3; ++j)
                  matrix(row + i, column + j) +=
                    point.weight *
                    (friction * grad_a[j] * grad_b[i] +
                     (gamma * with_solids - 2. / 3. * friction) * grad_a[i] * grad_b[j]);
                matrix(row + i, column + 3) += point.weight * pressure_weight * grad_b[i];
                matrix(row + 3, column + i) +=
                  point.weight * grad_a[i] *
                  (tau * strong[b] - with_solids * point.value[b]);
              }
            matrix(row + 3, column + 3) +=
              point.weight * (tau * here.pressure_share + here.solids_by_gradient) *
              (grad_a * grad_b);
          }

        for (unsigned int i = 0; i < 3; ++i)
          rhs[row + i] +=
            point.weight *
            (psi_a * galerkin_force[i] + upwind[a] * residual_source[i] -
             gamma * grad_a[i] * (here.void_fraction_rate + here.solid_divergence));
        rhs[row + 3] +=
          point.weight * (tau * (grad_a * residual_source) + grad_a * here.solid_flux -
                          psi_a * state.void_fraction_rate[a]);
      }
  }

  Tensor<1, 3>
  unresolved_flux(const FlowCoefficients                   &coefficients,
                  const CellState                          &state,
                  const ShapePoint                         &point,
                  const Tensor<1, 3>                       &subscale_history,
                  const std::array<double, nodes_per_cell> &pressure)
  {
    const PointState here     = interpolate(coefficients, state, point);
    Tensor<1, 3>     residual = coefficients.density * subscale_history - here.source;
    for (unsigned int b = 0; b < nodes_per_cell; ++b)
      residual += (inertia(coefficients, state, point, here, b) +
                   state.resistance[b] * point.value[b]) *
                    state.flux[b] +
                  here.pressure_share * pressure[b] * point.gradient[b];
    return -stabilization_time(coefficients, here.resistance, state.size) * residual;
  }
} // namespace graupel
