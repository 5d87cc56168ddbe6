// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/flow_solver.h>

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
    result.iteration_growth = iteration_growth;
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
    VesselMesh::CellBytes result;
    nodes.append(result, fields_of_history(*this, *made_of));
    append_unresolved(result);
    return result;
  }

  void
  FlowSolver::restore(const FlowHistory &history, VesselMesh::CellBytes bytes)
  {
    Recipe made_of = assembled;
    take_unresolved(bytes);
    nodes.take(bytes, fields_of_history(*this, made_of));

    now              = history.time;
    last_step        = history.last_step;
    last_velocity    = history.last_velocity;
    known_media      = history.known_media;
    known_unresolved = history.known_unresolved;
    fresh_iterations = history.fresh_iterations;
    last_iterations  = history.last_iterations;
    iteration_growth = history.iteration_growth;
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

  void
  FlowSolver::append_unresolved(VesselMesh::CellBytes &bytes) const
  {
    const std::size_t size = sizeof(EightVectors);
    for (std::size_t cell = 0; cell < bytes.size(); ++cell)
      for (const auto *values : {&unresolved_now, &unresolved_old})
        {
          const auto *begin = reinterpret_cast<const char *>(&(*values)[cell]);
          bytes[cell].insert(bytes[cell].end(), begin, begin + size);
        }
  }

  void
  FlowSolver::take_unresolved(VesselMesh::CellBytes &bytes)
  {
    const std::size_t size = sizeof(EightVectors);
    for (std::size_t cell = 0; cell < bytes.size(); ++cell)
      for (auto *values : {&unresolved_old, &unresolved_now})
        {
          const std::size_t rest = bytes[cell].size() - size;
          std::memcpy(&(*values)[cell], bytes[cell].data() + rest, size);
          bytes[cell].resize(rest);
        }
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
    assemble_schur(medium);
    preconditioner.refresh(schur.trilinos(), of_grad_div);
    built = recipe;
  }
} // namespace graupel
