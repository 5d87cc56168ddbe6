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

  double
  RandomInsertion::next_random()
  {
    // The standard leaves the distributions to the library; this is the same
    // everywhere.
    return static_cast<double>(generator() >> 11) * 0x1p-53;
  }

  NewParticle
  RandomInsertion::next_particle()
  {
    const auto random = [this]() { return next_random(); };
    if (!is_drawn)
      drawn = source.draw(random);
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
    if (!dem.parameters().walls.is_periodic())
      return;
    const dealii::Tensor<1, 3> shift({0., 0., dem.cylinder().height});
    places.add_obstacle(center + shift, radius);
    places.add_obstacle(center - shift, radius);
  }

  void
  RandomInsertion::add_obstacles(RandomPlaces &places, const Section &section) const
  {
    const ParticleArrays &p     = dem.particles();
    const bool            all   = dem.parameters().walls.is_periodic();
    const double          reach = 2. * (1. + gap) * dem.parameters().largest_radius();
    std::vector<Point<3>> mine;
    std::vector<double>   radii;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        const double z = p.body[i].position[2];
        if (all || (z > section.lower - reach && z < section.upper + reach))
          {
            mine.push_back(p.body[i].position);
            radii.push_back(p.body[i].radius);
          }
      }
    const auto all_centers = dealii::Utilities::MPI::all_gather(dem.communicator(), mine);
    const auto all_radii = dealii::Utilities::MPI::all_gather(dem.communicator(), radii);
    for (std::size_t rank = 0; rank < all_centers.size(); ++rank)
      for (std::size_t k = 0; k < all_centers[rank].size(); ++k)
        {
          places.add_obstacle(all_centers[rank][k], all_radii[rank][k]);
          add_images(places, all_centers[rank][k], all_radii[rank][k]);
        }
  }

  RandomInsertion::Added
  RandomInsertion::fill(const Request &request)
  {
    RandomPlaces places(dem.cylinder(),
                        dem.vessel(),
                        request.section.lower,
                        request.section.upper,
                        dem.parameters().largest_radius(),
                        gap);
    add_obstacles(places, request.section);
    const auto types  = dem.parameters().types();
    const auto random = [this]() { return next_random(); };

    Added                    result;
    std::vector<NewParticle> added;
    double                   solid = 0.;
    result.by_type.assign(types.size(), 0);
    while (added.size() < request.number && solid < request.solid_volume)
      {
        NewParticle  particle = next_particle();
        const double volume   = sphere_volume(particle.radius);
        const double mass     = types[particle.type].density * volume;
        if (result.mass + mass > request.mass)
          {
            is_drawn = true;
            break;
          }
        if (!places.place(particle.radius, request.n_tries, random, particle.position))
          {
            result.no_room = true;
            break;
          }
        is_drawn          = false;
        particle.velocity = request.velocity(particle.position[2]);
        add_images(places, particle.position, particle.radius);
        solid += volume;
        result.mass += mass;
        ++result.by_type[particle.type];
        added.push_back(particle);
      }
    result.number = added.size();
    if (!added.empty())
      dem.insert(added);
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
