// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_state_field_averages_h
#define graupel_simulation_state_field_averages_h

#include <graupel/base/moments.h>
#include <graupel/simulation/state/coupled_flow.h>

namespace graupel
{
  /**
   * Means over time of the fluid's fields at the nodes, and how they scatter: as Moments,
   * node by node. The mesh must stay the same.
   */
  class FieldAverages
  {
  public:
    /** What is averaged, in this order. */
    enum Field : unsigned int
    {
      void_fraction,
      pressure,
      flux,
      n_fields = flux + 3
    };

    using Fields = std::array<const NodalVector *, n_fields>;

    /** Those of @p flow as it is now, which must outlive them. */
    static Fields of(const CoupledFlow &flow);

    /** Takes in the fields of @p flow as of the last @p duration [s]. */
    void record(const CoupledFlow &flow, const double duration);

    /** Forgets all. */
    void
    clear()
    {
      time = 0.;
    }

    /** Time that they are means over; 0: there are none [s]. */
    double
    averaged_time() const
    {
      return time;
    }

    /** Of @p field, flux + i for a component; ghosts up to date. Only if there are any.
     */
    const NodalVector &
    mean(const unsigned int field) const
    {
      return means[field];
    }

    /** Root of the mean squared distance from the mean. */
    NodalVector rms(const unsigned int field) const;

    /** Puts the fields, if there are any, behind the @p bytes of a checkpoint. */
    void append(const NodalSpace &nodes, VesselMesh::CellBytes &bytes) const;

    /** Takes them back from there; means over @p time [s], nothing if that is 0.
     * Collective. */
    void load(const NodalSpace &nodes, const double time, VesselMesh::CellBytes &bytes);

  private:
    std::vector<NodalVector *> all();

    double                            time = 0.;
    std::array<NodalVector, n_fields> means, squares;
  };
} // namespace graupel

#endif
