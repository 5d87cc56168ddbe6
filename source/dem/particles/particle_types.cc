// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/dem/particles/particle_types.h>

#include <deal.II/base/utilities.h>

#include <boost/math/distributions/normal.hpp>

#include <limits>
#include <sstream>

namespace graupel
{
  namespace
  {
    // Where no ends are given, the tails are cut here, in deviations.
    constexpr double usual_tail = 3.;
    // Diameters at which a mean over a distribution is taken.
    constexpr unsigned int n_samples = 2000;
  } // namespace

  void
  SizeDistribution::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "size distribution",
      kind,
      "Distribution of the original diameters: single (the diameter), list, uniform, "
      "normal (the diameter is the mean) or log-normal (it is the median).",
      dealii::Patterns::Selection("single|list|uniform|normal|log-normal"));
    prm.add_parameter("size measure",
                      measure,
                      "Whether shares of sizes are of the mass or of the number of "
                      "particles.",
                      dealii::Patterns::Selection("mass|number"));
    prm.add_parameter("size list",
                      list,
                      "Diameters [m] and their shares [-] of a list, as in "
                      "\"1e-3: 0.4, 2e-3: 0.6\".");
    prm.add_parameter("size deviation",
                      deviation,
                      "Standard deviation of the diameter if normal [m], of its "
                      "natural logarithm if log-normal [-].");
    prm.add_parameter("smallest diameter",
                      smallest,
                      "Smallest diameter of a distribution; 0: three deviations below "
                      "the middle [m].");
    prm.add_parameter("largest diameter",
                      largest,
                      "Largest diameter of a distribution; 0: three deviations above "
                      "the middle [m].");
  }

  void
  SizeDistribution::check(const double diameter, const std::string &section) const
  {
    if (kind == "single")
      return;
    if (kind == "list")
      {
        const std::string parameter = section + "/size list";
        const std::string advice = "write diameters and shares, \"1e-3: 0.4, 2e-3: 0.6\"";
        const auto        entries = dealii::Utilities::split_string_list(list);
        require(!entries.empty(), parameter, advice);
        double total = 0.;
        for (const std::string &entry : entries)
          {
            const auto share = read_share(entry);
            require(share.has_value(),
                    parameter,
                    '"' + entry + "\" is not a diameter and its share; " + advice);
            require(share->diameter > 0. && share->share >= 0.,
                    parameter,
                    "diameters are positive, in metres, and shares not negative");
            total += share->share;
          }
        require(total > 0. && std::isfinite(total),
                parameter,
                "the shares are together nothing, or too much for a number");
        return;
      }
    require(kind == "uniform" || deviation > 0.,
            section + "/size deviation",
            "a normal distribution needs a positive deviation");
    require(kind != "uniform" || (smallest > 0. && largest > 0.),
            section + "/smallest diameter",
            "a uniform distribution needs a smallest and a largest diameter");
    require(smallest_diameter(diameter) > 0.,
            section + "/smallest diameter",
            "the distribution reaches down to nothing: give a smallest diameter");
    require(smallest_diameter(diameter) <= largest_diameter(diameter),
            section + "/largest diameter",
            "the largest diameter lies below the smallest");
  }

  std::optional<SizeDistribution::Share>
  SizeDistribution::read_share(const std::string &entry)
  {
    const auto texts = dealii::Utilities::split_string_list(entry, ':');
    if (texts.size() != 2)
      return {};
    const auto diameter = number_in(texts[0]), share = number_in(texts[1]);
    if (!diameter || !share)
      return {};
    return Share{*diameter, *share};
  }

  std::vector<SizeDistribution::Share>
  SizeDistribution::shares() const
  {
    std::vector<Share> result;
    double             total = 0.;
    for (const auto &entry : dealii::Utilities::split_string_list(list))
      {
        const auto share = read_share(entry);
        if (!share)
          return {};
        result.push_back(*share);
        total += result.back().share;
        if (result.back().share == 0.)
          result.pop_back();
      }
    for (auto &share : result)
      share.share /= total;
    std::sort(result.begin(), result.end(), [](const Share &a, const Share &b) {
      return a.diameter < b.diameter;
    });
    return result;
  }

  double
  SizeDistribution::smallest_diameter(const double diameter) const
  {
    if (kind == "single")
      return diameter;
    if (kind == "list")
      return shares().front().diameter;
    if (smallest > 0.)
      return smallest;
    return kind == "normal" ? diameter - usual_tail * deviation
                            : diameter * std::exp(-usual_tail * deviation);
  }

  double
  SizeDistribution::largest_diameter(const double diameter) const
  {
    if (kind == "single")
      return diameter;
    if (kind == "list")
      return shares().back().diameter;
    if (largest > 0.)
      return largest;
    return kind == "normal" ? diameter + usual_tail * deviation
                            : diameter * std::exp(usual_tail * deviation);
  }

  double
  SizeDistribution::quantile(const double share, const double diameter) const
  {
    if (kind == "single")
      return diameter;
    if (kind == "list")
      {
        const auto sorted = shares();
        double     left   = share;
        for (const auto &entry : sorted)
          if ((left -= entry.share) < 0.)
            return entry.diameter;
        return sorted.back().diameter;
      }
    const double low = smallest_diameter(diameter), high = largest_diameter(diameter);
    if (kind == "uniform")
      return low + share * (high - low);

    // The part of the bell between the ends, in d or in ln d.
    const bool in_logarithm = kind == "log-normal";
    const auto x = [&](const double d) { return in_logarithm ? std::log(d) : d; };
    const boost::math::normal bell(x(diameter), deviation);
    const double              below = boost::math::cdf(bell, x(low));
    const double              above = boost::math::cdf(bell, x(high));
    const double p  = std::clamp(below + share * (above - below), 1e-300, 1. - 1e-16);
    const double at = boost::math::quantile(bell, p);
    return std::clamp(in_logarithm ? std::exp(at) : at, low, high);
  }

  unsigned int
  SizeDistribution::n_sizes(const double diameter) const
  {
    if (is_one_size(diameter))
      return 1;
    return kind == "list" ? shares().size() : 0;
  }

  std::vector<SizeDistribution::Share>
  SizeDistribution::samples(const double diameter) const
  {
    if (is_one_size(diameter))
      return {{smallest_diameter(diameter), 1.}};
    if (kind == "list")
      return shares();
    std::vector<Share> result;
    for (unsigned int k = 0; k < n_samples; ++k)
      result.push_back({quantile((k + 0.5) / n_samples, diameter), 1. / n_samples});
    return result;
  }

  double
  SizeDistribution::mean_volume(const double diameter) const
  {
    // A mean by number of V is, over a distribution by mass, one over that of 1/V. In
    // ratios to the smallest one, so that one size gives its volume to the last digit.
    const double least = smallest_diameter(diameter);
    double       share = 0., sum = 0.;
    for (const auto &sample : samples(diameter))
      {
        const double ratio =
          measure == "mass" ? least / sample.diameter : sample.diameter / least;
        share += sample.share;
        sum += sample.share * ratio * ratio * ratio;
      }
    return sphere_volume(least / 2.) * (measure == "mass" ? share / sum : sum / share);
  }

  double
  SizeDistribution::sauter_diameter(const double diameter) const
  {
    // Shares of the volume, or those by number times d^3.
    const double least  = smallest_diameter(diameter);
    double       volume = 0., surface = 0.;
    for (const auto &sample : samples(diameter))
      {
        const double ratio = sample.diameter / least;
        const double part =
          sample.share * (measure == "mass" ? 1. : ratio * ratio * ratio);
        volume += part;
        surface += part / ratio;
      }
    return least * (volume / surface);
  }

  bool
  ParticleType::has_size(const double radius) const
  {
    return radius >= (1. - size_tolerance) * smallest_radius() &&
           radius <= (1. + size_tolerance) * largest_radius();
  }

  void
  ParticleType::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("mass fraction",
                      mass_fraction,
                      "Share of this type in the mass that is filled in; 0: there is no "
                      "such type [-].");
    prm.add_parameter("diameter", diameter, "Diameter of its original particles [m].");
    prm.add_parameter("scale",
                      scale,
                      "Diameter of its simulated particles over that of the original "
                      "ones [-].");
    prm.add_parameter("density", density, "Density of its solid [kg/m^3].");
    prm.add_parameter("Young's modulus",
                      elasticity.young_modulus,
                      "Young's modulus of its solid, usually reduced [Pa].");
    prm.add_parameter(
      "Poisson's ratio", elasticity.poisson_ratio, "Poisson's ratio of its solid [-].");
    sizes.declare(prm);
  }

  void
  ParticleType::check(const std::string &section) const
  {
    require(mass_fraction >= 0. && mass_fraction < 1.,
            section + "/mass fraction",
            "a share lies between 0 and 1; what is left over is of the first type");
    if (mass_fraction == 0.)
      return;
    require(diameter > 0., section + "/diameter", "a sphere needs a positive diameter");
    require(scale >= 1., section + "/scale", "choose 1 or more");
    require(density > 0., section + "/density", "a solid needs a positive density");
    require(elasticity.young_modulus > 0.,
            section + "/Young's modulus",
            "a solid needs a positive modulus, in pascal");
    require(elasticity.poisson_ratio >= 0. && elasticity.poisson_ratio <= 0.5,
            section + "/Poisson's ratio",
            "an isotropic solid has a ratio between 0 and 0.5");
    sizes.check(diameter, section);
  }

  std::string
  problem_of_size(const NewParticle &particle, const std::vector<ParticleType> &types)
  {
    const ParticleType &type = types[particle.type];
    if (type.has_size(particle.radius))
      return {};
    std::ostringstream text;
    text << "its diameter of " << 2. * particle.radius
         << " m is none of its type's, number " << particle.type + 1
         << ", whose simulated particles measure ";
    if (type.largest_radius() > type.smallest_radius())
      text << "from " << 2. * type.smallest_radius() << " to ";
    text
      << 2. * type.largest_radius()
      << " m (Particles: diameter, scale, size distribution); the substep and the "
         "search for neighbours follow from these. Set the type's diameter, or let its "
         "size distribution (list, or uniform from smallest to largest) reach so far";
    return text.str();
  }

  ParticleSource::ParticleSource(const std::vector<ParticleType> &types,
                                 const unsigned int               only)
    : types(types)
  {
    double numbers = 0.;
    for (unsigned int t = 0; t < types.size(); ++t)
      {
        const bool is_drawn = only == 0 || only == t + 1;
        number_fraction.push_back(is_drawn ? (only > 0 ? 1. : types[t].mass_fraction) /
                                               types[t].mean_mass()
                                           : 0.);
        numbers += number_fraction.back();
      }
    for (unsigned int t = 0; t < types.size(); ++t)
      {
        number_fraction[t] /= numbers;
        mass += number_fraction[t] * types[t].mean_mass();
        volume += number_fraction[t] * types[t].mean_volume();
      }
  }

  unsigned int
  ParticleSource::n_sizes() const
  {
    unsigned int n       = 0;
    double       largest = 0., smallest = 0.;
    for (unsigned int t = 0; t < types.size(); ++t)
      {
        if (number_fraction[t] == 0.)
          continue;
        const unsigned int of_type = types[t].sizes.n_sizes(types[t].diameter);
        if (of_type == 0)
          return 0;
        n += of_type;
        largest  = std::max(largest, types[t].largest_radius());
        smallest = smallest == 0. ? types[t].smallest_radius()
                                  : std::min(smallest, types[t].smallest_radius());
      }
    return largest == smallest ? 1 : n;
  }

  double
  ParticleSource::largest_radius() const
  {
    double largest = 0.;
    for (unsigned int t = 0; t < types.size(); ++t)
      if (number_fraction[t] > 0.)
        largest = std::max(largest, types[t].largest_radius());
    return largest;
  }
} // namespace graupel
