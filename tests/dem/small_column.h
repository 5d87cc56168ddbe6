// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_tests_dem_small_column_h
#define graupel_tests_dem_small_column_h

#include <graupel/dem/dem.h>

#include <gtest/gtest.h>

#include <cstring>
#include <map>

namespace graupel
{
  /** The lists of all ranks behind each other, on each of them. */
  template <class Record>
  std::vector<Record>
  of_all_ranks(const std::vector<Record> &mine, MPI_Comm communicator)
  {
    const auto       *bytes = reinterpret_cast<const char *>(mine.data());
    std::vector<char> part(bytes, bytes + mine.size() * sizeof(Record)), whole;
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, part))
      whole.insert(whole.end(), of_rank.begin(), of_rank.end());
    std::vector<Record> all(whole.size() / sizeof(Record));
    std::memcpy(static_cast<void *>(all.data()), whole.data(), whole.size());
    return all;
  }

  /** The state of all ranks, for a column that one rank has alone. */
  inline DemState
  whole_state(const Dem &dem)
  {
    const auto  communicator = dem.communicator();
    DemState    state        = dem.state();
    std::size_t below        = 0;
    const auto  numbers =
      dealii::Utilities::MPI::all_gather(communicator, state.contacts.size());
    for (unsigned int rank = 0;
         rank < dealii::Utilities::MPI::this_mpi_process(communicator);
         ++rank)
      below += numbers[rank];
    for (auto &particle : state.particles)
      particle.first_contact += below;
    state.particles = of_all_ranks(state.particles, communicator);
    state.contacts  = of_all_ranks(state.contacts, communicator);
    return state;
  }

  /** A small column with spheres of 2 mm, and a DEM in it. */
  struct SmallColumn
  {
    explicit SmallColumn(const DemParameters &parameters,
                         MPI_Comm             communicator = MPI_COMM_WORLD,
                         const Cylinder      &cylinder     = vessel())
      : mesh(cylinder, mesh_parameters(), communicator)
      , dem(parameters, mesh, costs)
    {
    }

    static Cylinder
    vessel()
    {
      Cylinder cylinder;
      cylinder.diameter = 0.01;
      cylinder.height   = 0.03;
      return cylinder;
    }

    static MeshParameters
    mesh_parameters()
    {
      MeshParameters parameters;
      parameters.cell_size = 2.5e-3;
      return parameters;
    }

    static DemParameters
    parameters()
    {
      DemParameters parameters;
      parameters.particles.diameter = 2e-3;
      return parameters;
    }

    /** The own row of a particle, or -1 if another rank has it. */
    int
    row(const std::int64_t id) const
    {
      const auto &p = dem.particles();
      for (unsigned int i = 0; i < p.n_owned; ++i)
        if (p.id[i] == id)
          return i;
      return -1;
    }

    void
    set_velocity(const std::int64_t id, const dealii::Tensor<1, 3> &velocity)
    {
      if (row(id) >= 0)
        dem.particles().body[row(id)].velocity = velocity;
    }

    /** A vector of one particle, on all ranks. */
    template <class Get>
    dealii::Tensor<1, 3>
    everywhere(const std::int64_t id, const Get &get) const
    {
      dealii::Tensor<1, 3> value;
      if (row(id) >= 0)
        value = get(row(id));
      return dealii::Utilities::MPI::sum(value, dem.communicator());
    }

    dealii::Tensor<1, 3>
    velocity(const std::int64_t id) const
    {
      return everywhere(id,
                        [&](const int i) { return dem.particles().body[i].velocity; });
    }

    dealii::Tensor<1, 3>
    spin(const std::int64_t id) const
    {
      return everywhere(id, [&](const int i) { return dem.particles().body[i].spin; });
    }

    dealii::Tensor<1, 3>
    force(const std::int64_t id) const
    {
      return everywhere(id, [&](const int i) { return dem.contact_force(i); });
    }

    dealii::Point<3>
    position(const std::int64_t id) const
    {
      return dealii::Point<3>(everywhere(id, [&](const int i) {
        return dealii::Tensor<1, 3>(dem.particles().body[i].position);
      }));
    }

    /** Position, velocity, spin and force of every particle by id, on all ranks. */
    std::map<std::int64_t, std::vector<double>>
    state() const
    {
      std::map<std::int64_t, std::vector<double>> mine, all;
      const auto                                 &p = dem.particles();
      for (unsigned int i = 0; i < p.n_owned; ++i)
        for (const dealii::Tensor<1, 3> &v : {dealii::Tensor<1, 3>(p.body[i].position),
                                              p.body[i].velocity,
                                              p.body[i].spin,
                                              dem.contact_force(i),
                                              dem.contact_torque(i)})
          for (unsigned int d = 0; d < 3; ++d)
            mine[p.id[i]].push_back(v[d]);
      for (const auto &of_rank :
           dealii::Utilities::MPI::all_gather(dem.communicator(), mine))
        all.insert(of_rank.begin(), of_rank.end());
      return all;
    }

    VesselMesh mesh;
    CostSheet  costs;
    Dem        dem;
  };
} // namespace graupel

#endif
