#ifndef graupel_fluid_flow_boundaries_h
#define graupel_fluid_flow_boundaries_h

#include <graupel/fluid/boundary_parameters.h>
#include <graupel/fluid/flow_space.h>

#include <deal.II/base/function_parser.h>

#include <memory>

namespace graupel
{
  /**
   * The boundary conditions on the nodes: which flux and which pressure they
   * prescribe now, and the linear constraints that follow for the flow's
   * unknowns (hanging nodes included).
   */
  class FlowBoundaries
  {
  public:
    /**
     * @p conditions by boundary id; an id without one is slip. @p space must
     * outlive this object.
     */
    FlowBoundaries(
      const std::map<dealii::types::boundary_id, BoundaryCondition> &conditions,
      const bool                                                     weigh_inlets,
      const FlowSpace                                               &space);

    /**
     * Evaluates all conditions at the time @p time [s] for the superficial
     * velocity @p velocity [m/s] of a fluid of @p density [kg/m^3] where
     * @p void_fraction holds (ghosts up to date). Collective.
     */
    void update(const double       time,
                const double       velocity,
                const double       density,
                const NodalVector &void_fraction);

    const dealii::AffineConstraints<double> &
    constraints() const
    {
      return closed;
    }

    /** Prescribed flux at the nodes of inlets, elsewhere 0 [m/s]; ghosts up to date. */
    const NodalVectorField &
    flux() const
    {
      return prescribed_flux;
    }

    /** Prescribed pressure at the nodes of outlets, elsewhere 0 [Pa]; ghosts up to date.
     */
    const NodalVector &
    pressure() const
    {
      return prescribed_pressure;
    }

    /** Ids of the boundaries with a flux, and with a pressure. */
    const std::vector<dealii::types::boundary_id> &
    inlets() const
    {
      return inlet_ids;
    }
    const std::vector<dealii::types::boundary_id> &
    outlets() const
    {
      return outlet_ids;
    }

    /** Volume that enters through the inlets, counted without sign [m^3/s]. Collective.
     */
    double throughput() const;

  private:
    struct Node
    {
      unsigned int                    local;
      dealii::types::global_dof_index global;
      dealii::Point<3>                position;
    };

    struct Boundary
    {
      dealii::types::boundary_id id;
      BoundaryCondition          condition;
      // Those that no earlier boundary has taken.
      std::vector<Node>    nodes;
      double               area = 0.;
      dealii::Point<3>     center;
      dealii::Tensor<1, 3> inward; // mean unit normal
      // Poiseuille's profile, and its mean as the mesh has it [-].
      double parabola(const dealii::Point<3> &x) const;
      double parabola_mean = 1.;
    };

    void   find_nodes();
    void   measure(Boundary &boundary) const;
    void   make_template();
    void   measure_parabola(Boundary &boundary) const;
    double mean(const Boundary &boundary, const NodalVector &field) const;
    void   prescribe_flux(const Boundary                        &boundary,
                          const dealii::FunctionParser<3> *const function,
                          const double                           velocity,
                          const double                           density,
                          const NodalVector                     &void_fraction);

    const FlowSpace      &space;
    const bool            weigh_inlets;
    std::vector<Boundary> boundaries; // inlets, then no-slip walls, then the others
    std::vector<dealii::types::boundary_id> inlet_ids, outlet_ids;

    dealii::AffineConstraints<double> open, closed;
    NodalVectorField                  prescribed_flux;
    NodalVector                       prescribed_pressure;
  };
} // namespace graupel

#endif
