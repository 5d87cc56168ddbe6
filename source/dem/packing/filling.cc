// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/loose_packing.h>
#include <graupel/dem/particles/dem_error.h>

#include <numeric>
#include <sstream>

namespace graupel
{
  namespace
  {
    constexpr double zone_thickness = RandomInsertion::zone_thickness;
    constexpr double gap            = RandomInsertion::gap;

    // Tries to find a place, for each place that a dense layer would have.
    constexpr unsigned int tries_per_place = 20;

    // Layers without room for a single particle after which the column counts
    // as full; a bed that still settles makes room sooner.
    constexpr unsigned int most_barren_layers = 60;

    // The longest piece of time that is simulated at once [s].
    constexpr double pause = 1e-3;

    // The loose packing of a batch ends above the bed by this many diameters, and
    // is as high as this at least.
    constexpr double batch_clearance = 1.;
    constexpr double least_batch     = 2.;

    // A bed that within this time [s] loses more than this part of what falls in does
    // not grow.
    constexpr double watch_time   = 1.;
    constexpr double most_of_loss = 0.9;

    // Until the layer before has fallen out of the zone.
    double
    shortest_interval(const double diameter, const double speed, const double gravity)
    {
      const double way = (1. + zone_thickness + 2. * gap) * diameter;
      return 2. * way / (speed + std::sqrt(speed * speed + 2. * gravity * way));
    }
  } // namespace

  Filling::Filling(const FillingParameters &parameters, Dem &dem)
    : input(parameters)
    , dem(dem)
    , insertion(
        ParticleSource(dem.parameters().types(), parameters.type), parameters.seed, dem)
    , radius(insertion.source.largest_radius())
    , time_to_fall(shortest_interval(
        2. * radius, input.drop_speed, dem.parameters().particles.gravity))
  {
    dem.use_packing_materials(true);
  }

  Filling::State
  Filling::state() const
  {
    State result     = at;
    result.insertion = insertion.state();
    return result;
  }

  void
  Filling::restore(const State &state)
  {
    at = state;
    insertion.restore(state.insertion);
    dem.use_packing_materials(true);
  }

  double
  Filling::expected_height() const
  {
    const BedObservables::Bed bed =
      BedObservables(dem.particles(), dem.vessel_shape(), dem.communicator()).bed();
    // A heap of a few layers has no bulk yet, and rain is none.
    const bool   is_bed = bed.height > 12. * radius && bed.bulk_solid_fraction > 0.5;
    const double bulk =
      is_bed ? bed.bulk_solid_fraction : loose_packing::usual_solid_fraction;
    return dem.vessel_shape().depth_of(dem.solid_volume(), bulk);
  }

  unsigned long
  Filling::n_put_in() const
  {
    return dem.n_global() + dem.n_departed();
  }

  double
  Filling::mass_put_in() const
  {
    const auto departed = dem.departed_mass();
    return std::accumulate(departed.begin(), departed.end(), dem.solid_mass());
  }

  unsigned int
  Filling::n_missing() const
  {
    if (input.count > 0)
      return input.count - std::min<unsigned long>(input.count, n_put_in());
    const double mean_mass = insertion.source.mean_mass();
    if (input.mass > 0.)
      return static_cast<unsigned int>(
        std::max(0., std::round((input.mass - mass_put_in()) / mean_mass)));

    const Vessel &vessel         = dem.vessel_shape();
    const double  missing_volume = vessel.volume(vessel.floor() + expected_height(),
                                                vessel.floor() + input.bed_height) *
                                  loose_packing::usual_solid_fraction;
    return static_cast<unsigned int>(
      std::max(0., missing_volume * dem.mean_density() / mean_mass));
  }

  double
  Filling::progress() const
  {
    if (at.finished)
      return 1.;
    if (input.count > 0)
      return std::min(1., n_put_in() / static_cast<double>(input.count));
    if (input.mass > 0.)
      return std::min(1., mass_put_in() / input.mass);
    if (input.bed_height > 0.)
      return std::min(1.,
                      dem.vessel_shape().depth_of(dem.solid_volume(),
                                                  loose_packing::usual_solid_fraction) /
                        input.bed_height);
    return 0.;
  }

  double
  Filling::fallen_speed(const double z) const
  {
    return std::sqrt(input.drop_speed * input.drop_speed +
                     2. * dem.parameters().particles.gravity *
                       std::max(0., dem.cylinder().height - z));
  }

  RandomInsertion::Request
  Filling::request(const Section     &section,
                   const unsigned int at_most,
                   const double       solid_fraction) const
  {
    RandomInsertion::Request request;
    request.section = section;
    request.number  = at_most;
    request.n_tries = loose_packing::most_tries;
    request.solid_volume =
      solid_fraction * dem.vessel_shape().volume(section.lower, section.upper);
    request.velocity = [this](const double) {
      return dealii::Tensor<1, 3>({0., 0., -input.drop_speed});
    };
    return request;
  }

  unsigned int
  Filling::tries_below_top() const
  {
    const double reach = 0.5 * dem.cylinder().diameter - radius * (1. + gap);
    return static_cast<unsigned int>(tries_per_place *
                                     (1. + reach * reach / (radius * radius)));
  }

  void
  Filling::drop_layer(const unsigned int at_most)
  {
    auto layer    = request(section_below_top(dem.cylinder(), radius), at_most, 1.);
    layer.n_tries = tries_below_top();
    const unsigned int n = insertion.fill(layer).number;
    at.barren_layers     = n == 0 ? at.barren_layers + 1 : 0;
    if (at.barren_layers > most_barren_layers)
      throw DemError(
        "the column is full: " + std::to_string(dem.n_global()) +
        " particles are in, and no room is left below the top for more. Fill in less "
        "(Filling/count, mass or bed height), or make Geometry/height larger.");
    at.next_drop += std::max(input.interval, time_to_fall);
  }

  unsigned int
  Filling::n_due() const
  {
    // Rounding must not hold back the one that is just due.
    const auto due = static_cast<unsigned long>(input.rate * at.elapsed + 1e-6);
    return due - std::min(due, at.n_dropped);
  }

  unsigned int
  Filling::drop_due(const unsigned int at_most)
  {
    const unsigned int due = std::min(n_due(), at_most);
    auto drops             = request(section_below_top(dem.cylinder(), radius), due, 1.);
    drops.n_tries          = tries_below_top();
    const unsigned int n   = insertion.fill(drops).number;
    at.n_dropped += n;
    // One layer may have to fall out of the way first.
    if (due - n <= 1. + input.rate * time_to_fall)
      return n;
    std::ostringstream text;
    text << "the section below the top has no room for " << input.rate
         << " particles a second (Filling/rate): " << at.n_dropped << " came in within "
         << at.elapsed << " s, " << at.n_dropped / at.elapsed << " a second, and "
         << due - n
         << " wait. Choose a lower rate than that or a higher Filling/drop speed; if the "
            "bed has reached the top, fill in less or make Geometry/height larger.";
    throw DemError(text.str());
  }

  void
  Filling::rain_by_rate()
  {
    move_on(pause);
    if (at.elapsed < at.next_drop || n_due() == 0)
      return;
    const unsigned int missing = n_missing();
    const unsigned int dropped = missing > 0 ? drop_due(missing) : 0;
    // A height is an estimate that is made anew.
    at.finished = missing == (input.bed_height > 0. ? 0 : dropped);
    // What found no place is tried again at once.
    if (n_due() == 0)
      at.next_drop += input.interval;
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
    auto batch     = request({lower, upper}, at_most, loose_packing::solid_fraction);
    batch.velocity = [this](const double z) {
      return dealii::Tensor<1, 3>({0., 0., -fallen_speed(z)});
    };
    insertion.fill(batch);

    // Until the last of them has come down on the others.
    const double way = (upper - lower) * (1. - loose_packing::solid_fraction /
                                                 loose_packing::usual_solid_fraction);
    const double g   = dem.parameters().particles.gravity;
    const double v   = input.drop_speed;
    at.next_drop += g > 0. ? (std::sqrt(v * v + 2. * g * way) - v) / g : way / v;
  }

  void
  Filling::fill_volume()
  {
    const double upper = input.upper > 0. ? input.upper : dem.cylinder().height;
    unsigned int missing;
    while ((missing = n_missing()) > 0)
      if (insertion.fill(request({input.lower, upper}, missing, 1.)).number == 0)
        throw DemError("the section from " + std::to_string(input.lower) + " m to " +
                       std::to_string(upper) + " m has no room for more than " +
                       std::to_string(dem.n_global()) +
                       " particles at random places (Filling/method = volume). Fill in "
                       "less, make it higher, or choose the method packing.");
  }

  void
  Filling::fill_from_list()
  {
    Dem::Batch batch(dem);
    input.read_list(dem.cylinder(),
                    dem.parameters(),
                    dem.vessel(),
                    [&](const NewParticle &particle) { batch.add(particle); });
    dem.insert(batch);
  }

  void
  Filling::fill_at_once()
  {
    if (input.method == "volume")
      fill_volume();
    else if (input.method == "list")
      fill_from_list();
    at.finished = true;
  }

  void
  Filling::move_on(const double duration)
  {
    dem.advance(duration);
    at.elapsed += duration;
    if (input.bed_height > 0.)
      watch_growth();
  }

  void
  Filling::watch_growth()
  {
    if (at.elapsed - at.watch_begin < watch_time)
      return;
    const auto n_in  = n_put_in() - at.watch_put_in,
               n_out = dem.n_departed() - at.watch_left;
    if (n_out > 0 && n_out >= most_of_loss * n_in)
      throw DemError("the bed does not grow to Filling/bed height: of " +
                     std::to_string(n_in) + " particles filled in within a second " +
                     std::to_string(n_out) +
                     " left through an open end (Walls/bottom, Walls/top). Close it, or "
                     "fill by Filling/count or mass, which count what leaves.");
    at.watch_begin  = at.elapsed;
    at.watch_put_in = n_put_in();
    at.watch_left   = dem.n_departed();
  }

  bool
  Filling::step()
  {
    if (at.finished)
      return false;
    if (input.method != "rain" && input.method != "packing")
      {
        fill_at_once();
        return false;
      }
    if (input.rate > 0.)
      {
        rain_by_rate();
        return true;
      }
    if (at.elapsed >= at.next_drop)
      {
        const unsigned int missing = n_missing();
        at.finished                = missing == 0;
        if (at.finished)
          return false;
        input.method == "rain" ? drop_layer(missing) : drop_batch(missing);
      }
    move_on(std::min(std::max(at.next_drop - at.elapsed, dem.substep()), pause));
    return true;
  }
} // namespace graupel
