#include <graupel/base/parameters.h>
#include <graupel/dem/bed_observables.h>
#include <graupel/dem/dem_error.h>
#include <graupel/dem/filling.h>

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
    prm.add_parameter(
      "seed", seed, "Start of the random numbers that place particles [-].");
    prm.leave_subsection();
  }

  void
  FillingParameters::check(const Cylinder           &cylinder,
                           const ParticleParameters &particles) const
  {
    require(mass >= 0., "Filling/mass", "a mass is positive, in kg; 0 if not used");
    require(bed_height >= 0.,
            "Filling/bed height",
            "a height is positive, in metres; 0 if not used");
    require((count > 0) + (mass > 0.) + (bed_height > 0.) == 1,
            "Filling/bed height",
            "exactly one of count, mass and bed height must be set and the other two be "
            "zero");
    require(drop_speed > 0.,
            "Filling/drop speed",
            "particles must leave the place where they enter; choose a positive speed, "
            "in m/s");
    require(interval >= 0.,
            "Filling/interval",
            "a time is positive, in seconds; 0 for the default");

    const double d    = 2. * particles.simulated_radius();
    const double room = cylinder.height - (1. + zone_thickness + gap) * d;
    require(
      room > d, "Geometry/height", "the column is too low to drop particles into it");
    require(bed_height <= room,
            "Filling/bed height",
            "the bed would reach the place where particles enter, 1.5 diameters below "
            "the top; "
            "choose a lower bed or a higher column");
    const double solid =
      count > 0 ? count * sphere_volume(d / 2.) : mass / particles.density;
    require(solid <= 0.74 * cylinder.cross_section() * room,
            count > 0 ? "Filling/count" : "Filling/mass",
            "not even the densest packing has room for so many particles in the column");
  }

  Filling::Filling(const FillingParameters &parameters, Dem &dem)
    : input(parameters)
    , dem(dem)
    , radius(dem.parameters().particles.simulated_radius())
    , layer_interval(std::max(input.interval,
                              shortest_interval(2. * radius,
                                                input.drop_speed,
                                                dem.parameters().particles.gravity)))
    , generator(input.seed)
  {
    dem.use_packing_materials(true);
    if (input.count > 0)
      target = input.count;
    else if (input.mass > 0.)
      target = std::lround(input.mass / dem.parameters().particles.simulated_mass());
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
      BedObservables(dem.particles(), dem.cylinder(), dem.communicator()).bed();
    // A heap of a few layers has no bulk yet, and rain is none.
    const bool   is_bed = bed.height > 12. * radius && bed.bulk_solid_fraction > 0.5;
    const double bulk   = is_bed ? bed.bulk_solid_fraction : usual_solid_fraction;
    return dem.solid_volume() / (dem.cylinder().cross_section() * bulk);
  }

  unsigned int
  Filling::n_missing()
  {
    if (input.bed_height == 0.)
      return target - std::min(target, dem.n_global());

    const double missing_volume = (input.bed_height - expected_height()) *
                                  dem.cylinder().cross_section() * usual_solid_fraction;
    return static_cast<unsigned int>(
      std::max(0., missing_volume / sphere_volume(radius)));
  }

  double
  Filling::progress() const
  {
    if (input.bed_height == 0.)
      return dem.n_global() / static_cast<double>(target);
    return std::min(1.,
                    dem.solid_volume() / (dem.cylinder().cross_section() *
                                          usual_solid_fraction * input.bed_height));
  }

  std::vector<Point<3>>
  Filling::particles_above(const double z) const
  {
    const ParticleArrays &p = dem.particles();
    std::vector<Point<3>> mine, all;
    for (unsigned int i = 0; i < p.n_owned; ++i)
      if (p.body[i].position[2] > z)
        mine.push_back(p.body[i].position);
    for (const auto &of_rank :
         dealii::Utilities::MPI::all_gather(dem.communicator(), mine))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    return all;
  }

  void
  Filling::drop_layer(const unsigned int at_most)
  {
    const double d         = 2. * radius;
    const double clearance = (1. + gap) * d;
    const double top       = dem.cylinder().height - (0.5 + gap) * d;
    const double reach     = 0.5 * dem.cylinder().diameter - radius * (1. + gap);

    auto       obstacles = particles_above(top - zone_thickness * d - clearance);
    const auto n_tries   = static_cast<unsigned int>(
      tries_per_place * (1. + reach * reach / (radius * radius)));

    std::vector<Point<3>> layer;
    for (unsigned int attempt = 0; attempt < n_tries && layer.size() < at_most; ++attempt)
      {
        const double   rho   = reach * std::sqrt(next_random());
        const double   angle = 2. * dealii::numbers::PI * next_random();
        const Point<3> place(rho * std::cos(angle),
                             rho * std::sin(angle),
                             top - zone_thickness * d * next_random());
        const bool     free =
          std::none_of(obstacles.begin(), obstacles.end(), [&](const Point<3> &other) {
            return other.distance_square(place) < clearance * clearance;
          });
        if (free)
          {
            obstacles.push_back(place);
            layer.push_back(place);
          }
      }

    barren_layers = layer.empty() ? barren_layers + 1 : 0;
    if (barren_layers > most_barren_layers)
      throw DemError(
        "the column is full: " + std::to_string(dem.n_global()) +
        " particles are in, and no room is left below the top for more. Fill in less "
        "(Filling/count, mass or bed height), or make Geometry/height larger.");
    if (!layer.empty())
      dem.insert(layer, dealii::Tensor<1, 3>({0., 0., -input.drop_speed}));
  }

  bool
  Filling::step()
  {
    if (finished)
      return false;
    if (elapsed >= next_drop)
      {
        const unsigned int missing = n_missing();
        finished                   = missing == 0;
        if (finished)
          return false;
        drop_layer(missing);
        next_drop += layer_interval;
      }
    const double duration = std::min(std::max(next_drop - elapsed, dem.substep()), pause);
    dem.advance(duration);
    elapsed += duration;
    return true;
  }
} // namespace graupel
