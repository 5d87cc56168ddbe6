// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/state/field_averages.h>

namespace graupel
{
  FieldAverages::Fields
  FieldAverages::of(const CoupledFlow &flow)
  {
    const NodalVectorField &q = flow.fluid().flux();
    return {{&flow.exchange().medium().void_fraction,
             &flow.fluid().pressure(),
             &q[0],
             &q[1],
             &q[2]}};
  }

  void
  FieldAverages::record(const CoupledFlow &flow, const double duration)
  {
    if (time == 0.)
      for (NodalVector *field : all())
        flow.nodes().initialize(*field);
    time += duration;
    const auto fields = of(flow);
    for (unsigned int f = 0; f < n_fields; ++f)
      {
        for (unsigned int k = 0; k < means[f].locally_owned_size(); ++k)
          {
            Moments moments{
              time - duration, means[f].local_element(k), squares[f].local_element(k)};
            moments.add(fields[f]->local_element(k), duration);
            means[f].local_element(k)   = moments.mean;
            squares[f].local_element(k) = moments.squares;
          }
        means[f].update_ghost_values();
        squares[f].update_ghost_values();
      }
  }

  NodalVector
  FieldAverages::rms(const unsigned int field) const
  {
    NodalVector result = squares[field];
    for (unsigned int k = 0; k < result.locally_owned_size(); ++k)
      result.local_element(k) = std::sqrt(result.local_element(k) / time);
    result.update_ghost_values();
    return result;
  }

  std::vector<NodalVector *>
  FieldAverages::all()
  {
    std::vector<NodalVector *> fields;
    for (auto *array : {&means, &squares})
      for (NodalVector &field : *array)
        fields.push_back(&field);
    return fields;
  }

  void
  FieldAverages::append(const NodalSpace &nodes, VesselMesh::CellBytes &bytes) const
  {
    if (time == 0.)
      return;
    std::vector<const NodalVector *> fields;
    for (const auto *array : {&means, &squares})
      for (const NodalVector &field : *array)
        fields.push_back(&field);
    nodes.append(bytes, fields);
  }

  void
  FieldAverages::load(const NodalSpace      &nodes,
                      const double           averaged_time,
                      VesselMesh::CellBytes &bytes)
  {
    time = averaged_time;
    if (time > 0.)
      nodes.take(bytes, all());
  }
} // namespace graupel
