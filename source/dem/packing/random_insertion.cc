// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/packing/random_insertion.h>

#include <sstream>

namespace graupel
{
  using dealii::Point;

  Section
  section_below_top(const Cylinder &cylinder, const double radius)
  {
    const double upper = cylinder.height;
    return {upper -
              (2. * (1. + RandomInsertion::gap) + 2. * RandomInsertion::zone_thickness) *
                radius,
            upper};
  }

  RandomInsertion::RandomInsertion(const ParticleSource &source,
                                   const unsigned int    seed,
                                   Dem                  &dem)
    : source(source)
    , dem(dem)
    , generator(seed)
  {
  }

  NewParticle
  RandomInsertion::next_particle(RandomPlaces &places)
  {
    const auto random = [this]() { return next_random(generator); };
    if (!is_drawn)
      {
        places.give_back();
        drawn = source.draw(random);
      }
    // Where all are equal the next one is as good.
    is_drawn = source.n_sizes() != 1 || dem.n_by_type().size() > 1;
    NewParticle particle;
    particle.radius = drawn.radius;
    particle.type   = drawn.type;
    return particle;
  }

  void
  RandomInsertion::add_images(RandomPlaces   &places,
                              const Point<3> &center,
                              const double    radius) const
  {
    if (!dem.period().exists())
      return;
    const dealii::Tensor<1, 3> shift({0., 0., dem.period().length()});
    places.add_obstacle(center + shift, radius);
    places.add_obstacle(center - shift, radius);
  }

  std::vector<NewParticle>
  RandomInsertion::obstacles(const Section &section) const
  {
    const ParticleArrays    &p     = dem.particles();
    const Period             ends  = dem.period();
    const double             reach = 2. * (1. + gap) * dem.parameters().largest_radius();
    std::vector<NewParticle> result;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        const Body  &body = p.body[i];
        const double z    = body.position[2];
        if (ends.exists() || (z > section.lower - reach && z < section.upper + reach))
          result.push_back({body.position, body.radius});
      }
    const std::size_t n = ends.exists() ? result.size() : 0;
    for (const double shift : {ends.length(), -ends.length()})
      for (std::size_t k = 0; k < n; ++k)
        {
          result.push_back(result[k]);
          result.back().position[2] += shift;
        }
    return result;
  }

  std::optional<dealii::BoundingBox<3>>
  RandomInsertion::box_around(const std::vector<NewParticle> &obstacles) const
  {
    auto box = dem.ranks().own_box();
    for (const NewParticle &obstacle : obstacles)
      {
        const dealii::BoundingBox<3> around(
          std::make_pair(obstacle.position, obstacle.position));
        if (box)
          box->merge_with(around);
        else
          box = around;
      }
    return box;
  }

  RandomInsertion::Added
  RandomInsertion::fill(const Request &request)
  {
    const auto   known = obstacles(request.section);
    RandomPlaces places(dem.cylinder(),
                        dem.vessel(),
                        request.section.lower,
                        request.section.upper,
                        dem.parameters().largest_radius(),
                        gap,
                        box_around(known),
                        generator,
                        dem.communicator());
    for (const NewParticle &obstacle : known)
      places.add_obstacle(obstacle.position, obstacle.radius);
    const auto types = dem.parameters().types();

    Added      result;
    Dem::Batch batch(dem);
    double     solid = 0.;
    result.by_type.assign(types.size(), 0);
    while (result.number < request.number && solid < request.solid_volume)
      {
        NewParticle  particle = next_particle(places);
        const double volume   = sphere_volume(particle.radius);
        const double mass     = types[particle.type].density * volume;
        if (result.mass + mass > request.mass)
          {
            is_drawn = true;
            break;
          }
        if (!places.place(particle.radius, request.n_tries, particle.position))
          {
            result.no_room = true;
            break;
          }
        is_drawn          = false;
        particle.velocity = request.velocity(particle.position[2]);
        add_images(places, particle.position, particle.radius);
        solid += volume;
        result.mass += mass;
        ++result.number;
        ++result.by_type[particle.type];
        batch.add(particle);
      }
    places.give_back();
    if (result.number > 0)
      dem.insert(batch);
    return result;
  }

  RandomInsertion::State
  RandomInsertion::state() const
  {
    std::ostringstream text;
    text << generator;
    return {text.str(), is_drawn, drawn.type, drawn.radius};
  }

  void
  RandomInsertion::restore(const State &state)
  {
    std::istringstream(state.generator) >> generator;
    is_drawn = state.is_drawn;
    drawn    = {state.type, state.radius};
  }
} // namespace graupel
