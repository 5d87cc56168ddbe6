#include <graupel/fluid/flow_solver.h>
#include <graupel/mesh/cell_order.h>

#include <cstring>

namespace graupel
{
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

  template <typename Solver, typename RecipeType>
  auto
  FlowSolver::fields_of_history(Solver &solver, RecipeType &recipe)
  {
    std::vector<decltype(&solver.alpha_old)> fields{&solver.relative_pressure,
                                                    &solver.alpha_old,
                                                    &solver.alpha_older,
                                                    &recipe.void_fraction,
                                                    &recipe.drag};
    for (auto *field :
         {&solver.flux_now, &solver.flux_old, &recipe.carrier, &recipe.solids})
      for (auto &component : *field)
        fields.push_back(&component);
    return fields;
  }

  VesselMesh::CellBytes
  FlowSolver::cell_bytes() const
  {
    const auto            made_of = recipe ? recipe : share(assembled);
    const auto            fields  = fields_of_history(*this, *made_of);
    VesselMesh::CellBytes result;
    std::vector<double>   values;
    for (const auto &cell : owned_cells(nodes.dof_handler))
      {
        values.clear();
        for (const auto *field : fields)
          for (const unsigned int v : cell->vertex_indices())
            values.push_back((*field)(cell->vertex_dof_index(v, 0)));
        const auto *const begin = reinterpret_cast<const char *>(values.data());
        std::vector<char> bytes(begin, begin + values.size() * sizeof(double));
        const auto        unresolved = pack_unresolved(result.size());
        bytes.insert(bytes.end(), unresolved.begin(), unresolved.end());
        result.push_back(std::move(bytes));
      }
    return result;
  }

  void
  FlowSolver::restore(const FlowHistory &history, const VesselMesh::CellBytes &bytes)
  {
    Recipe     made_of = assembled;
    const auto fields  = fields_of_history(*this, made_of);
    for (NodalVector *field : fields)
      nodes.initialize(*field);
    unsigned int number = 0;
    for (const auto &cell : owned_cells(nodes.dof_handler))
      {
        const char *place = bytes[number].data();
        for (NodalVector *field : fields)
          for (const unsigned int v : cell->vertex_indices())
            {
              const auto dof = cell->vertex_dof_index(v, 0);
              if (nodes.owned.is_element(dof))
                std::memcpy(&(*field)(dof), place, sizeof(double));
              place += sizeof(double);
            }
        unpack_unresolved(number++, place);
      }
    for (NodalVector *field : fields)
      field->update_ghost_values();

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
