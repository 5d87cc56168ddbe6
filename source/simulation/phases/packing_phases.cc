// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/phases/packing_phases.h>
#include <graupel/simulation/state/bytes.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <sstream>

namespace graupel
{
  namespace
  {
    // What a cell counts while there is no fluid, in particles.
    constexpr double share_of_empty_cell = 0.02;
    // Simulated time between two looks at how particles are spread over the ranks [s].
    constexpr double balance_interval = 0.1;
  } // namespace

  void
  PackingBalance::operator()(Dem &dem, const double time)
  {
    if (time < next)
      return;
    dem.balance(share_of_empty_cell);
    next = time + balance_interval;
  }

  FillingPhase::FillingPhase(const FillingParameters &parameters, SimulationState &state)
    : state(state)
    , begun(state.time)
    , filling(parameters, state.dem)
  {
  }

  void
  FillingPhase::begin()
  {
    state.progress.start_phase(state.name + "fill", {0., 1., "", false});
  }

  bool
  FillingPhase::step()
  {
    const bool goes_on = filling.step();
    state.time         = begun + filling.time();
    if (!goes_on)
      return false;
    balance(state.dem, filling.time());
    state.progress.update(filling.progress());
    return true;
  }

  void
  FillingPhase::end()
  {
    std::ostringstream text;
    text << state.dem.n_global() << " particles in " << filling.time()
         << " s of simulated time";
    state.progress.finish_phase(text.str());
  }

  Moment
  FillingPhase::moment() const
  {
    return Moment(state);
  }

  std::string
  FillingPhase::save() const
  {
    return to_bytes(std::make_pair(begun, filling.state()));
  }

  void
  FillingPhase::resume(const std::string &saved)
  {
    const auto record = from_bytes<std::pair<double, Filling::State>>(saved);
    begun             = record.first;
    filling.restore(record.second);
    begin();
  }

  TakingBed::TakingBed(const DemState &bed, SimulationState &state)
    : bed(bed)
    , state(state)
  {
  }

  void
  TakingBed::begin()
  {
    state.dem.restore(bed);
    state.progress.say("the settled bed is taken from " +
                       state.parameters.filling.start_from);
  }

  bool
  TakingBed::step()
  {
    return false;
  }

  Moment
  TakingBed::moment() const
  {
    return Moment(state);
  }

  std::string
  TakingBed::save() const
  {
    return {};
  }

  void
  TakingBed::resume(const std::string &)
  {
    begin();
  }

  SettlingPhase::SettlingPhase(const SettlingParameters &parameters,
                               SimulationState          &state)
    : parameters(parameters)
    , state(state)
    , begun(state.time)
    , settling(parameters, state.dem)
  {
  }

  void
  SettlingPhase::begin()
  {
    state.progress.start_phase(state.name + "settle",
                               {0., parameters.maximum_time, "s", true});
  }

  bool
  SettlingPhase::step()
  {
    const bool goes_on = settling.step();
    state.time         = begun + settling.time();
    if (!goes_on)
      return false;
    balance(state.dem, settling.time());
    state.progress.update(settling.time());
    return true;
  }

  void
  SettlingPhase::end()
  {
    std::ostringstream text;
    text << "at rest after " << settling.time() << " s of simulated time";
    if (settling.n_taps() > 0)
      text << " and " << settling.n_taps() << " taps";
    state.progress.finish_phase(text.str());
  }

  Moment
  SettlingPhase::moment() const
  {
    return Moment(state);
  }

  std::string
  SettlingPhase::save() const
  {
    return to_bytes(std::make_pair(begun, settling.state()));
  }

  void
  SettlingPhase::resume(const std::string &saved)
  {
    const auto record = from_bytes<std::pair<double, Settling::State>>(saved);
    begun             = record.first;
    settling.restore(record.second);
    begin();
  }
} // namespace graupel
