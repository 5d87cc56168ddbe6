// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_phases_packing_phases_h
#define graupel_simulation_phases_packing_phases_h

#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/settling.h>
#include <graupel/simulation/phases/phase.h>

namespace graupel
{
  /** Divides the mesh among the ranks anew as the particles gather. */
  class PackingBalance
  {
  public:
    /** Looks from time to time; @p time since the phase began [s]. Collective. */
    void operator()(Dem &dem, const double time);

  private:
    double next = 0.; // [s]
  };

  /** Fills the vessel. */
  class FillingPhase : public Phase
  {
  public:
    FillingPhase(const FillingParameters &parameters, SimulationState &state);

    const char *
    kind() const override
    {
      return "fill";
    }

    void        begin() override;
    bool        step() override;
    void        end() override;
    Moment      moment() const override;
    std::string save() const override;
    void        resume(const std::string &saved) override;

  private:
    SimulationState &state;
    double           begun; // [s]
    Filling          filling;
    PackingBalance   balance;
  };

  /** A settled bed of another run takes the place of filling. */
  class TakingBed : public Phase
  {
  public:
    /** Both must outlive it. */
    TakingBed(const DemState &bed, SimulationState &state);

    const char *
    kind() const override
    {
      return "fill";
    }

    void        begin() override;
    bool        step() override;
    Moment      moment() const override;
    std::string save() const override;
    void        resume(const std::string &saved) override;

  private:
    const DemState  &bed;
    SimulationState &state;
  };

  /** Lets the bed settle, or taps it. */
  class SettlingPhase : public Phase
  {
  public:
    SettlingPhase(const SettlingParameters &parameters, SimulationState &state);

    const char *
    kind() const override
    {
      return "settle";
    }

    void        begin() override;
    bool        step() override;
    void        end() override;
    Moment      moment() const override;
    std::string save() const override;
    void        resume(const std::string &saved) override;

  private:
    const SettlingParameters parameters;
    SimulationState         &state;
    double                   begun; // [s]
    Settling                 settling;
    PackingBalance           balance;
  };
} // namespace graupel

#endif
