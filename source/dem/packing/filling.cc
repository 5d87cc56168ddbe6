#include <graupel/base/parameters.h>
#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/particles/dem_error.h>
#include <graupel/dem/particles/particle_list.h>

#include <limits>

namespace graupel
{
  namespace
  {
    using dealii::Point;

    // The rain starts in a zone below the top, in diameters: the spheres are
    // at different heights so that they do not land as one raft.
    constexpr double zone_thickness = 0.5;
    constexpr double gap            = 0.05;

    // Tries to find a place, for each place that a dense layer would have.
    constexpr unsigned int tries_per_place = 20;

    // Layers without room for a single particle after which the column counts
    // as full; a bed that still settles makes room sooner.
    constexpr unsigned int most_barren_layers = 60;

    constexpr double pause = 1e-3;

    // A loose random packing: up to here places are found quickly (none are left
    // beyond 0.38), and how often one is looked for.
    constexpr double       loose_solid_fraction = 0.28;
    constexpr unsigned int most_tries           = 3000;

    // The loose packing of a batch ends above the bed by this many diameters, and
    // is as high as this at least.
    constexpr double batch_clearance = 1.;
    constexpr double least_batch     = 2.;

    // Without a bed to measure, that of a loose random packing.
    constexpr double usual_solid_fraction = 0.6;

    // Until the layer before has fallen out of the zone.
    double
    shortest_interval(const double diameter, const double speed, const double gravity)
    {
      const double way = (1. + zone_thickness + 2. * gap) * diameter;
      return 2. * way / (speed + std::sqrt(speed * speed + 2. * gravity * way));
    }
  } // namespace

  void
  FillingParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Filling");
    prm.add_parameter(
      "method",
      method,
      "How the bed is filled: rain (layer by layer from the top), packing (loose "
      "packings of the whole free space that fall; faster), volume (one loose packing "
      "between lower and upper), or list (from a file).",
      dealii::Patterns::Selection("rain|packing|volume|list"));
    prm.add_parameter(
      "count",
      count,
      "Number of simulated particles to fill in; 0 to fill by mass or bed "
      "height [-].");
    prm.add_parameter(
      "mass",
      mass,
      "Mass of all particles to fill in; 0 to fill by count or bed height [kg].");
    prm.add_parameter(
      "bed height",
      bed_height,
      "Height of the bed at which filling ends, taking particles still in the air "
      "into account; 0 to fill by count or mass [m].");
    prm.add_parameter("drop speed",
                      drop_speed,
                      "Downward speed at which particles enter below the top [m/s].");
    prm.add_parameter(
      "interval",
      interval,
      "Time between two layers of particles; 0 for the shortest in which a layer "
      "makes room for the next [s].");
    prm.add_parameter("rate",
                      rate,
                      "Particles that rain in a second; 0 for as many as there is room "
                      "for [1/s].");
    prm.add_parameter("lower", lower, "Lower end of the section that volume fills [m].");
    prm.add_parameter(
      "upper", upper, "Upper end of the section that volume fills; 0 for the top [m].");
    prm.add_parameter(
      "start from",
      start_from,
      "Output directory of another run: its settled bed is taken instead "
      "of filling, and settles again where it must. The vessel's diameter "
      "and the particles' must be the same; density, contacts, mesh and "
      "flow may differ. Empty: fill.");
    prm.add_parameter("file",
                      file,
                      "CSV file of the method list, with the columns x, y, z, diameter "
                      "and if wanted vx, vy, vz, wx, wy, wz, type (SI units).");
    prm.add_parameter(
      "seed", seed, "Start of the random numbers that place particles [-].");
    prm.leave_subsection();
  }

  void
  FillingParameters::check(const Cylinder &cylinder, const DemParameters &particles) const
  {
    require(drop_speed > 0.,
            "Filling/drop speed",
            "particles must leave the place where they enter; choose a positive speed, "
            "in m/s");
    require((method != "rain" && method != "packing") || !start_from.empty() ||
              particles.particles.gravity_is_axial(),
            "Filling/method",
            "particles fall from the top along the axis, but Particles/gravity points "
            "elsewhere; take the method volume or list");
    require(interval >= 0.,
            "Filling/interval",
            "a time is positive, in seconds; 0 for the default");
    require(rate >= 0., "Filling/rate", "a rate is positive, in 1/s; 0 for the fastest");
    require((method == "list") == !file.empty(),
            "Filling/file",
            "the method list needs a file, and no other method has one");
    const double end = upper > 0. ? upper : cylinder.height;
    require(method != "volume" || (lower >= 0. && end <= cylinder.height &&
                                   end - lower > 2.2 * particles.largest_radius()),
            "Filling/upper",
            "the section to fill must lie in the vessel and be higher than a particle");
    if (method != "list" && start_from.empty())
      check_amount(cylinder, particles);
  }

  void
  FillingParameters::check_amount(const Cylinder      &cylinder,
                                  const DemParameters &particles) const
  {
    require(mass >= 0., "Filling/mass", "a mass is positive, in kg; 0 if not used");
    require(bed_height >= 0.,
            "Filling/bed height",
            "a height is positive, in metres; 0 if not used");
    require((count > 0) + (mass > 0.) + (bed_height > 0.) == 1,
            "Filling/bed height",
            "exactly one of count, mass and bed height must be set and the other two be "
            "zero");

    const double d    = 2. * particles.largest_radius();
    const double room = cylinder.height - (1. + zone_thickness + gap) * d;
    require(
      room > d, "Geometry/height", "the column is too low to drop particles into it");
    require(bed_height <= room,
            "Filling/bed height",
            "the bed would reach the place where particles enter, 1.5 diameters below "
            "the top; "
            "choose a lower bed or a higher column");
    double lightest = std::numeric_limits<double>::max(), mean_volume = lightest;
    for (const auto &type : particles.types())
      {
        lightest    = std::min(lightest, type.density);
        mean_volume = std::min(mean_volume, type.mean_mass() / type.density);
      }
    const double solid = count > 0 ? count * mean_volume : mass / lightest;
    const bool   one_size =
      particles.types().size() == 1 && particles.particles.sizes.kind == "single";
    require(!one_size || solid <= 0.74 * cylinder.cross_section() * room,
            count > 0 ? "Filling/count" : "Filling/mass",
            "not even the densest packing has room for so many particles in the column");
  }

  Filling::Filling(const FillingParameters &parameters, Dem &dem)
    : input(parameters)
    , dem(dem)
    , source(dem.parameters().types())
    , radius(dem.parameters().largest_radius())
    , layer_interval(std::max(input.interval,
                              shortest_interval(2. * radius,
                                                input.drop_speed,
                                                dem.parameters().particles.gravity)))
    , generator(input.seed)
  {
    dem.use_packing_materials(true);
  }

  double
  Filling::next_random()
  {
    // The standard leaves the distributions to the library; this is the same
    // everywhere.
    return static_cast<double>(generator() >> 11) * 0x1p-53;
  }

  double
  Filling::expected_height() const
  {
    const BedObservables::Bed bed =
      BedObservables(dem.particles(), dem.vessel_shape(), dem.communicator()).bed();
    // A heap of a few layers has no bulk yet, and rain is none.
    const bool   is_bed = bed.height > 12. * radius && bed.bulk_solid_fraction > 0.5;
    const double bulk   = is_bed ? bed.bulk_solid_fraction : usual_solid_fraction;
    return dem.vessel_shape().depth_of(dem.solid_volume(), bulk);
  }

  unsigned int
  Filling::n_missing()
  {
    if (input.count > 0)
      return input.count - std::min(input.count, dem.n_global());
    if (input.mass > 0.)
      return static_cast<unsigned int>(
        std::max(0., std::round((input.mass - dem.solid_mass()) / source.mean_mass())));

    const Vessel &vessel         = dem.vessel_shape();
    const double  missing_volume = vessel.volume(vessel.floor() + expected_height(),
                                                vessel.floor() + input.bed_height) *
                                  usual_solid_fraction;
    return static_cast<unsigned int>(
      std::max(0., missing_volume * dem.mean_density() / source.mean_mass()));
  }

  double
  Filling::progress() const
  {
    if (finished)
      return 1.;
    if (input.count > 0)
      return dem.n_global() / static_cast<double>(input.count);
    if (input.mass > 0.)
      return std::min(1., dem.solid_mass() / input.mass);
    if (input.bed_height > 0.)
      return std::min(
        1.,
        dem.vessel_shape().depth_of(dem.solid_volume(), usual_solid_fraction) /
          input.bed_height);
    return 0.;
  }

  void
  Filling::add_obstacles(RandomPlaces &places, const double above) const
  {
    const ParticleArrays &p = dem.particles();
    std::vector<Point<3>> mine;
    std::vector<double>   radii;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      if (p.body[i].position[2] > above)
        {
          mine.push_back(p.body[i].position);
          radii.push_back(p.body[i].radius);
        }
    const auto all_centers = dealii::Utilities::MPI::all_gather(dem.communicator(), mine);
    const auto all_radii = dealii::Utilities::MPI::all_gather(dem.communicator(), radii);
    for (std::size_t rank = 0; rank < all_centers.size(); ++rank)
      for (std::size_t k = 0; k < all_centers[rank].size(); ++k)
        places.add_obstacle(all_centers[rank][k], all_radii[rank][k]);
  }

  double
  Filling::fallen_speed(const double z) const
  {
    return std::sqrt(input.drop_speed * input.drop_speed +
                     2. * dem.parameters().particles.gravity *
                       std::max(0., dem.cylinder().height - z));
  }

  unsigned int
  Filling::fill_section(const double       lower,
                        const double       upper,
                        const unsigned int at_most,
                        const unsigned int n_tries,
                        const double       solid_fraction,
                        const bool         fallen_from_top)
  {
    RandomPlaces places(dem.cylinder(), dem.vessel(), lower, upper, radius, gap);
    add_obstacles(places, lower - 2. * (1. + gap) * radius);
    const double most_solid = solid_fraction * dem.vessel_shape().volume(lower, upper);
    const auto   random     = [this]() { return next_random(); };

    std::vector<NewParticle> added;
    double                   solid = 0.;
    while (added.size() < at_most && solid < most_solid)
      {
        const auto  drawn = source.draw(random);
        NewParticle particle;
        particle.radius   = drawn.radius;
        particle.type     = drawn.type;
        particle.velocity = dealii::Tensor<1, 3>({0., 0., -input.drop_speed});
        if (!places.place(drawn.radius, n_tries, random, particle.position))
          break;
        if (fallen_from_top)
          particle.velocity[2] = -fallen_speed(particle.position[2]);
        solid += sphere_volume(drawn.radius);
        added.push_back(particle);
      }
    if (!added.empty())
      dem.insert(added);
    return added.size();
  }

  void
  Filling::drop_layer(const unsigned int at_most)
  {
    const double reach   = 0.5 * dem.cylinder().diameter - radius * (1. + gap);
    const auto   n_tries = static_cast<unsigned int>(
      tries_per_place * (1. + reach * reach / (radius * radius)));
    const double upper = dem.cylinder().height;
    const double lower = upper - (2. * (1. + gap) + 2. * zone_thickness) * radius;
    const auto   by_rate =
      input.rate > 0.
          ? std::max(1u, static_cast<unsigned int>(input.rate * layer_interval))
          : at_most;
    const unsigned int n =
      fill_section(lower, upper, std::min(at_most, by_rate), n_tries, 1., false);

    barren_layers = n == 0 ? barren_layers + 1 : 0;
    if (barren_layers > most_barren_layers)
      throw DemError(
        "the column is full: " + std::to_string(dem.n_global()) +
        " particles are in, and no room is left below the top for more. Fill in less "
        "(Filling/count, mass or bed height), or make Geometry/height larger.");
    next_drop += layer_interval;
    if (input.rate > 0.)
      next_drop += std::max(0., n / input.rate - layer_interval);
  }

  void
  Filling::drop_batch(const unsigned int at_most)
  {
    const double d     = 2. * radius;
    const double upper = dem.cylinder().height;
    const double lower =
      dem.vessel_shape().floor() +
      (dem.n_global() == 0 ? 0. : expected_height() + batch_clearance * d);
    if (upper - lower < least_batch * d)
      return drop_layer(at_most);
    fill_section(lower, upper, at_most, most_tries, loose_solid_fraction, true);

    // Until the last of them has come down on the others.
    const double way =
      (upper - lower) * (1. - loose_solid_fraction / usual_solid_fraction);
    const double g = dem.parameters().particles.gravity;
    const double v = input.drop_speed;
    next_drop += g > 0. ? (std::sqrt(v * v + 2. * g * way) - v) / g : way / v;
  }

  void
  Filling::fill_volume()
  {
    const double upper = input.upper > 0. ? input.upper : dem.cylinder().height;
    unsigned int missing;
    while ((missing = n_missing()) > 0)
      if (fill_section(input.lower, upper, missing, most_tries, 1., false) == 0)
        throw DemError("the section from " + std::to_string(input.lower) + " m to " +
                       std::to_string(upper) + " m has no room for more than " +
                       std::to_string(dem.n_global()) +
                       " particles at random places (Filling/method = volume). Fill in "
                       "less, make it higher, or choose the method packing.");
  }

  bool
  Filling::step()
  {
    if (finished)
      return false;
    if (input.method == "list" || input.method == "volume")
      {
        if (input.method == "volume")
          fill_volume();
        else
          dem.insert(read_particle_list(input.file, dem.parameters().types().size()));
        finished = true;
        return false;
      }
    if (elapsed >= next_drop)
      {
        const unsigned int missing = n_missing();
        finished                   = missing == 0;
        if (finished)
          return false;
        input.method == "rain" ? drop_layer(missing) : drop_batch(missing);
      }
    const double duration = std::min(std::max(next_drop - elapsed, dem.substep()), pause);
    dem.advance(duration);
    elapsed += duration;
    return true;
  }
} // namespace graupel
