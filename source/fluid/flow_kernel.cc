// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flow_kernel.h>

namespace graupel
{
  namespace
  {
    using VectorLanes = std::array<EightLanes, 3>;

    EightLanes
    lanes(const Eight &values)
    {
      return EightLanes(values.data(), std::experimental::element_aligned);
    }

    VectorLanes
    lanes(const EightVectors &values)
    {
      return {lanes(values[0]), lanes(values[1]), lanes(values[2])};
    }

    Eight
    stored(const EightLanes &values)
    {
      Eight result;
      values.copy_to(result.data(), std::experimental::element_aligned);
      return result;
    }

    EightLanes
    product(const VectorLanes &x, const VectorLanes &y)
    {
      return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    }

    // Fields of a cell at its points.
    class PointFields
    {
    public:
      PointFields(const FlowCoefficients &coefficients,
                  const CellState        &state,
                  const ShapePoints      &points)
        : points(points)
      {
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          for (unsigned int q = 0; q < points_per_cell; ++q)
            value_of[a][q] = points[q].value[a];
        flux           = at_points(state.flux);
        void_fraction  = at_points(state.void_fraction);
        pressure_share = at_points(state.pressure_share);
        for (unsigned int i = 0; i < 3; ++i)
          source[i] =
            at_points(stored(lanes(state.force[i]) + lanes(state.drag_source[i]) -
                             coefficients.density * lanes(state.history[i])));
        flux_divergence = divergence(state.flux);

        const EightLanes resistance = lanes(at_points(state.resistance));
        const double     convection =
          2. * coefficients.density * coefficients.speed / state.size;
        const double diffusion = 12. * coefficients.viscosity / (state.size * state.size);
        tau = stored(1. / (coefficients.density * coefficients.subscale_rate +
                           sqrt(resistance * resistance + convection * convection +
                                diffusion * diffusion)));
      }

      Eight
      at_points(const Eight &nodal) const
      {
        EightLanes sum = 0.;
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          sum += lanes(value_of[a]) * nodal[a];
        return stored(sum);
      }

      EightVectors
      at_points(const EightVectors &nodal) const
      {
        return {at_points(nodal[0]), at_points(nodal[1]), at_points(nodal[2])};
      }

      Eight
      divergence(const EightVectors &nodal) const
      {
        Eight             result;
        const VectorLanes field = lanes(nodal);
        for (unsigned int q = 0; q < points_per_cell; ++q)
          result[q] = reduce(product(lanes(points[q].gradient), field));
        return result;
      }

    private:
      const ShapePoints                &points;
      std::array<Eight, nodes_per_cell> value_of; // basis functions, by point

    public:
      EightVectors flux;
      Eight        flux_divergence;
      Eight        void_fraction;
      Eight        pressure_share;
      Eight        tau;    // time scale of the subscales over density [m^3 s/kg]
      EightVectors source; // known terms of the momentum residual [N/m^3]
    };

    // Of the fluxes of a cell's nodes at one point.
    struct Transport
    {
      Transport(const FlowCoefficients &coefficients,
                const CellState        &state,
                const ShapePoint       &point,
                const PointFields      &fields,
                const unsigned int      q)
        : value(lanes(point.value))
        , gradient(lanes(point.gradient))
        , along_flux(fields.flux[0][q] * gradient[0] + fields.flux[1][q] * gradient[1] +
                     fields.flux[2][q] * gradient[2])
        , inertia(coefficients.density *
                  (coefficients.rate * value +
                   (along_flux + fields.flux_divergence[q] * value) /
                     lanes(state.void_fraction)))
        , drag(lanes(state.resistance) * value)
      {
      }

      EightLanes  value;      // basis functions
      VectorLanes gradient;   // theirs
      EightLanes  along_flux; // q grad
      EightLanes  inertia;    // acceleration and convection
      EightLanes  drag;
    };

    // What the matrix has of a point, by node of the column, times the point's weight.
    struct PointTerms
    {
      EightLanes galerkin; // acceleration, convection and, where it is not on nodes, drag
      EightLanes strong;   // the same with all drag: the residual
      EightLanes friction;
      EightLanes continuity;   // div q, and what the subscales carry of the momentum
      VectorLanes gradient;    // without the weight
      VectorLanes by_friction; // friction grad
      VectorLanes by_divergence;
      double      of_pressure; // factor of the pressure's Laplacian
      Eight       upwind;      // test function of SUPG, without the weight
    };

    void
    assemble_matrix(const CellState                               &state,
                    const ShapePoints                             &points,
                    const PointFields                             &fields,
                    const std::array<PointTerms, points_per_cell> &terms,
                    CellSystem                                    &system)
    {
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        {
          EightLanes entry[unknowns_per_node][unknowns_per_node];
          for (auto &row : entry)
            for (EightLanes &value : row)
              value = 0.;
          for (unsigned int q = 0; q < points_per_cell; ++q)
            {
              const ShapePoint &point = points[q];
              const PointTerms &term  = terms[q];
              const double      grad[]{
                     point.gradient[0][a], point.gradient[1][a], point.gradient[2][a]};
              const EightLanes of_gradients = grad[0] * term.gradient[0] +
                                              grad[1] * term.gradient[1] +
                                              grad[2] * term.gradient[2];
              const EightLanes diagonal = point.value[a] * term.galerkin +
                                          term.upwind[a] * term.strong +
                                          term.friction * of_gradients;
              const double of_gradient =
                point.weight * (state.pressure_share[a] * point.value[a] +
                                term.upwind[a] * fields.pressure_share[q]);
              for (unsigned int i = 0; i < 3; ++i)
                {
                  for (unsigned int j = 0; j < 3; ++j)
                    entry[i][j] +=
                      grad[j] * term.by_friction[i] + grad[i] * term.by_divergence[j];
                  entry[i][i] += diagonal;
                  entry[i][3] += of_gradient * term.gradient[i];
                  entry[3][i] += grad[i] * term.continuity;
                }
              entry[3][3] += term.of_pressure * of_gradients;
            }
          for (unsigned int i = 0; i < unknowns_per_node; ++i)
            for (unsigned int j = 0; j < unknowns_per_node; ++j)
              system.matrix[a][i][j] = stored(entry[i][j]);
        }
    }
  } // namespace

  void
  assemble_flow(const FlowCoefficients &coefficients,
                const CellState        &state,
                const ShapePoints      &points,
                const EightVectors     &subscale_history,
                CellSystem             &system)
  {
    const double      rho = coefficients.density;
    const PointFields fields(coefficients, state, points);
    const VectorLanes flux  = lanes(fields.flux);
    const EightLanes  alpha = lanes(fields.void_fraction);
    const EightLanes  speed = sqrt(product(flux, flux)) / alpha;
    const Eight       gamma =
      stored(coefficients.grad_div * (rho * speed * state.size + coefficients.viscosity) /
             alpha);
    const Eight mu_alpha =
      stored(coefficients.viscosity * (state.whole_stress ? EightLanes(1.) : alpha));
    const Eight        solids_by_gradient = fields.at_points(state.solids_by_gradient);
    const Eight        solid_divergence   = fields.divergence(state.solid_flux);
    const Eight        void_fraction_rate = fields.at_points(state.void_fraction_rate);
    const EightVectors solid_flux         = fields.at_points(state.solid_flux);
    const EightVectors drag_source        = fields.at_points(state.drag_source);
    const EightLanes   with_solids        = 1. + lanes(state.solids_by_flux);
    // Where the drag is put on the nodes, it enters the residual only.
    const double drag_here = state.drag_on_nodes ? 0. : 1.;

    std::array<PointTerms, points_per_cell>   terms;
    std::array<EightLanes, unknowns_per_node> right;
    right.fill(0.);
    for (unsigned int q = 0; q < points_per_cell; ++q)
      {
        const Transport  of(coefficients, state, points[q], fields, q);
        const double     weight = points[q].weight, tau = fields.tau[q];
        const EightLanes upwind = tau * rho / fields.void_fraction[q] * of.along_flux;
        PointTerms      &term   = terms[q];
        term.galerkin           = weight * (of.inertia + drag_here * of.drag);
        term.strong             = weight * (of.inertia + of.drag);
        term.friction           = weight * mu_alpha[q] / lanes(state.void_fraction);
        term.continuity         = tau * term.strong - weight * with_solids * of.value;
        term.gradient           = of.gradient;
        term.of_pressure =
          weight * (tau * fields.pressure_share[q] + solids_by_gradient[q]);
        term.upwind = stored(upwind);

        const EightLanes of_divergence =
          weight * gamma[q] * with_solids - 2. / 3. * term.friction;
        const double of_known = gamma[q] * (void_fraction_rate[q] + solid_divergence[q]);
        right[3] -= weight * of.value * lanes(state.void_fraction_rate);
        for (unsigned int i = 0; i < 3; ++i)
          {
            term.by_friction[i]   = term.friction * of.gradient[i];
            term.by_divergence[i] = of_divergence * of.gradient[i];
            const double galerkin =
              fields.source[i][q] - (1. - drag_here) * drag_source[i][q];
            const double residual = fields.source[i][q] - rho * subscale_history[i][q];
            right[i] += weight * (galerkin * of.value + residual * upwind -
                                  of_known * of.gradient[i]);
            right[3] += weight * (tau * residual + solid_flux[i][q]) * of.gradient[i];
          }
      }
    for (unsigned int c = 0; c < unknowns_per_node; ++c)
      system.rhs[c] = stored(right[c]);
    assemble_matrix(state, points, fields, terms, system);
  }

  EightVectors
  unresolved_flux(const FlowCoefficients &coefficients,
                  const CellState        &state,
                  const ShapePoints      &points,
                  const EightVectors     &subscale_history,
                  const Eight            &pressure)
  {
    const PointFields fields(coefficients, state, points);
    const VectorLanes flux = lanes(state.flux);
    EightVectors      result;
    for (unsigned int q = 0; q < points_per_cell; ++q)
      {
        const Transport  of(coefficients, state, points[q], fields, q);
        const EightLanes momentum = of.inertia + of.drag;
        for (unsigned int i = 0; i < 3; ++i)
          result[i][q] =
            -fields.tau[q] *
            (coefficients.density * subscale_history[i][q] - fields.source[i][q] +
             reduce(momentum * flux[i] +
                    fields.pressure_share[q] * lanes(pressure) * of.gradient[i]));
      }
    return result;
  }
} // namespace graupel
