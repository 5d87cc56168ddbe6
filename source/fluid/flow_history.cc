#include <graupel/fluid/flow_solver.h>

#include <deal.II/distributed/solution_transfer.h>

namespace graupel
{
  namespace
  {
    using Forest   = dealii::parallel::distributed::Triangulation<3>;
    using Transfer = dealii::parallel::distributed::SolutionTransfer<3, NodalVector>;

    // Data is attached to a mesh that does not change by it.
    Forest &
    forest_of(const NodalSpace &nodes)
    {
      return const_cast<Forest &>(nodes.mesh.triangulation());
    }

    // The place of a cell among the owned ones, by its active index.
    std::vector<unsigned int>
    owned_numbers(const NodalSpace &nodes)
    {
      const auto               &forest = nodes.mesh.triangulation();
      std::vector<unsigned int> result(forest.n_active_cells());
      unsigned int              number = 0;
      for (const auto &cell : forest.active_cell_iterators())
        if (cell->is_locally_owned())
          result[cell->active_cell_index()] = number++;
      return result;
    }
  } // namespace

  std::shared_ptr<const FlowSolver::Recipe>
  FlowSolver::share(const Recipe &recipe)
  {
    const auto result = std::make_shared<Recipe>(recipe);
    // A copy has none of the ghosts' values.
    for (NodalVector *field : {&result->void_fraction, &result->drag})
      field->update_ghost_values();
    for (NodalVectorField *field : {&result->carrier, &result->solids})
      for (NodalVector &component : *field)
        component.update_ghost_values();
    return result;
  }

  FlowHistory
  FlowSolver::history() const
  {
    FlowHistory result;
    result.time             = now;
    result.last_step        = last_step;
    result.last_velocity    = last_velocity;
    result.known_media      = known_media;
    result.known_unresolved = known_unresolved;
    result.fresh_iterations = fresh_iterations;
    result.last_iterations  = last_iterations;
    if (recipe)
      {
        result.preconditioned_rate          = recipe->rate;
        result.preconditioned_subscale_rate = recipe->subscale_rate;
        result.preconditioned_speed         = recipe->speed;
        result.preconditioned_solids        = recipe->has_solids;
      }
    return result;
  }

  void
  FlowSolver::save(const std::string &file) const
  {
    std::vector<const NodalVector *> fields{&relative_pressure, &alpha_old, &alpha_older};
    const auto                       made_of = recipe ? recipe : share(assembled);
    for (const NodalVectorField *field :
         {&flux_now, &flux_old, &made_of->carrier, &made_of->solids})
      for (const NodalVector &component : *field)
        fields.push_back(&component);
    fields.push_back(&made_of->void_fraction);
    fields.push_back(&made_of->drag);
    Transfer transfer(nodes.dof_handler);
    transfer.prepare_for_serialization(fields);

    const auto numbers = owned_numbers(nodes);
    forest_of(nodes).register_data_attach(
      [&](const Forest::cell_iterator &cell, const Forest::CellStatus) {
        return pack_unresolved(
          numbers[Forest::active_cell_iterator(cell)->active_cell_index()]);
      },
      false);
    nodes.mesh.save(file);
  }

  void
  FlowSolver::restore(const FlowHistory &history)
  {
    Recipe                     made_of = assembled;
    std::vector<NodalVector *> fields{&relative_pressure, &alpha_old, &alpha_older};
    for (NodalVectorField *field :
         {&flux_now, &flux_old, &made_of.carrier, &made_of.solids})
      for (NodalVector &component : *field)
        fields.push_back(&component);
    fields.push_back(&made_of.void_fraction);
    fields.push_back(&made_of.drag);
    for (NodalVector *field : fields)
      nodes.initialize(*field);
    Transfer transfer(nodes.dof_handler);
    transfer.deserialize(fields);
    for (NodalVector *field : fields)
      field->update_ghost_values();

    const auto         numbers = owned_numbers(nodes);
    const unsigned int handle  = forest_of(nodes).register_data_attach(
      [](const Forest::cell_iterator &, const Forest::CellStatus) {
        return std::vector<char>();
      },
      false);
    forest_of(nodes).notify_ready_to_unpack(
      handle,
      [&](const Forest::cell_iterator &cell,
          const Forest::CellStatus,
          const boost::iterator_range<std::vector<char>::const_iterator> &data) {
        unpack_unresolved(
          numbers[Forest::active_cell_iterator(cell)->active_cell_index()],
          &*data.begin());
      });

    now              = history.time;
    last_step        = history.last_step;
    last_velocity    = history.last_velocity;
    known_media      = history.known_media;
    known_unresolved = history.known_unresolved;
    fresh_iterations = history.fresh_iterations;
    last_iterations  = history.last_iterations;
    recipe.reset();
    built.reset();
    if (history.preconditioned_rate >= 0.)
      {
        made_of.rate          = history.preconditioned_rate;
        made_of.subscale_rate = history.preconditioned_subscale_rate;
        made_of.speed         = history.preconditioned_speed;
        made_of.has_solids    = history.preconditioned_solids;
        recipe                = share(made_of);
      }
    set_superficial_velocity(last_velocity);
    if (known_media > 0)
      boundaries.update(now, last_velocity, density, alpha_old);
    level_published_pressure();
    restore_solution();
  }

  std::vector<char>
  FlowSolver::pack_unresolved(const unsigned int cell) const
  {
    const std::size_t  size  = space.points_per_cell * sizeof(dealii::Tensor<1, 3>);
    const unsigned int first = cell * space.points_per_cell;
    std::vector<char>  bytes(2 * size);
    std::memcpy(bytes.data(), &unresolved_now[first], size);
    std::memcpy(bytes.data() + size, &unresolved_old[first], size);
    return bytes;
  }

  void
  FlowSolver::unpack_unresolved(const unsigned int cell, const char *const bytes)
  {
    const std::size_t  size  = space.points_per_cell * sizeof(dealii::Tensor<1, 3>);
    const unsigned int first = cell * space.points_per_cell;
    std::memcpy(&unresolved_now[first], bytes, size);
    std::memcpy(&unresolved_old[first], bytes + size, size);
  }

  void
  FlowSolver::rebuild_preconditioner(const bool shares_pressure)
  {
    Medium medium(nodes);
    medium.shares_pressure = shares_pressure;
    medium.void_fraction   = recipe->void_fraction;
    medium.drag            = recipe->drag;
    if (recipe->has_solids)
      {
        medium.solids.emplace(nodes);
        medium.solids->by_velocity    = recipe->solids[0];
        medium.solids->by_gradient    = recipe->solids[1];
        medium.solids->pressure_share = recipe->solids[2];
      }
    carrier             = recipe->carrier;
    scheme.now          = recipe->rate;
    subscale_scheme.now = recipe->subscale_rate;
    fastest             = recipe->speed;
    assemble_system(medium);
    preconditioner.refresh(matrix, schur);
    built = recipe;
  }
} // namespace graupel
