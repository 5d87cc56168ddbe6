// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/packing/feed.h>
#include <graupel/dem/particles/dem_error.h>

#include <numeric>
#include <sstream>

namespace graupel
{
  namespace
  {
    Section
    section_of(const FeedParameters &parameters, const Dem &dem, const double radius)
    {
      if (parameters.lower == 0. && parameters.upper == 0.)
        return section_below_top(dem.cylinder(), radius);
      return {parameters.lower, parameters.upper};
    }
  } // namespace

  Feed::Feed(const FeedParameters &parameters, Dem &dem, const std::string &name)
    : input(parameters)
    , name(name)
    , dem(dem)
    , insertion(
        ParticleSource(dem.parameters().types(), parameters.type), parameters.seed, dem)
    , section(section_of(parameters, dem, insertion.source.largest_radius()))
  {
    at.inserted.assign(dem.parameters().types().size(), 0);
  }

  unsigned long
  Feed::n_inserted() const
  {
    return std::accumulate(at.inserted.begin(), at.inserted.end(), 0ul);
  }

  unsigned int
  Feed::advance(const double t, const double dt)
  {
    const double end  = input.until > 0. ? std::min(t + dt, input.until) : t + dt;
    const double time = std::max(0., end - input.from);

    RandomInsertion::Request request;
    request.section  = section;
    request.velocity = [this](const double) { return input.velocity; };
    if (input.mass_rate > 0.)
      request.mass = input.mass_rate * time - at.mass;
    else
      {
        // Rounding must not hold back the one that is just due.
        const auto due = static_cast<unsigned long>(input.rate * time + 1e-6);
        request.number = due - std::min(due, n_inserted());
      }
    if (request.number == 0 || request.mass <= 0.)
      {
        at.owed = 0.;
        return 0;
      }

    const auto added = insertion.fill(request);
    for (unsigned int type = 0; type < at.inserted.size(); ++type)
      at.inserted[type] += added.by_type[type];
    at.mass += added.mass;
    at.owed = !added.no_room ? 0.
              : input.mass_rate > 0.
                ? (request.mass - added.mass) / insertion.source.mean_mass()
                : request.number - added.number;
    if (at.owed <= input.most_owed)
      return added.number;
    std::ostringstream text;
    text << "the section from " << section.lower << " to " << section.upper
         << " m has no room for what " << name
         << (input.mass_rate > 0. ? "/mass rate" : "/rate") << " brings: " << n_inserted()
         << " particles came in within " << time << " s, and " << at.owed
         << " wait for a place, more than " << name << "/most owed = " << input.most_owed
         << ". Choose a lower rate, a larger section or a higher velocity.";
    throw DemError(text.str());
  }

  Feed::State
  Feed::state() const
  {
    State result     = at;
    result.insertion = insertion.state();
    return result;
  }

  void
  Feed::restore(const State &state)
  {
    at = state;
    at.inserted.resize(dem.parameters().types().size(), 0);
    insertion.restore(state.insertion);
  }

  Feeds::Feeds(const FeedsParameters &parameters, Dem &dem)
    : n_types(dem.parameters().types().size())
  {
    for (unsigned int n = 0; n < parameters.feeds.size(); ++n)
      if (parameters.feeds[n].is_wanted())
        feeds.emplace_back(parameters.feeds[n], dem, FeedsParameters::name(n));
  }

  unsigned int
  Feeds::advance(const double t, const double dt)
  {
    unsigned int n = 0;
    for (Feed &feed : feeds)
      n += feed.advance(t, dt);
    return n;
  }

  std::vector<unsigned long>
  Feeds::inserted() const
  {
    std::vector<unsigned long> result(n_types, 0);
    for (const Feed &feed : feeds)
      for (unsigned int type = 0; type < n_types; ++type)
        result[type] += feed.inserted()[type];
    return result;
  }

  double
  Feeds::inserted_mass() const
  {
    double mass = 0.;
    for (const Feed &feed : feeds)
      mass += feed.inserted_mass();
    return mass;
  }

  double
  Feeds::owed() const
  {
    double owed = 0.;
    for (const Feed &feed : feeds)
      owed += feed.owed();
    return owed;
  }

  Feeds::State
  Feeds::state() const
  {
    State result;
    for (const Feed &feed : feeds)
      result.push_back(feed.state());
    return result;
  }

  void
  Feeds::restore(const State &state)
  {
    for (std::size_t n = 0; n < std::min(state.size(), feeds.size()); ++n)
      feeds[n].restore(state[n]);
  }
} // namespace graupel
