#include <graupel/base/parameters.h>
#include <graupel/dem/size_distribution.h>

#include <algorithm>
#include <cmath>

namespace graupel
{
  namespace
  {
    // Where the tails of the normal and the log-normal distribution are cut.
    constexpr double usual_tail = 3.;

    double
    cube(const double x)
    {
      return x * x * x;
    }
  } // namespace

  double
  uniform_number(std::mt19937_64 &generator)
  {
    return static_cast<double>(generator() >> 11) * 0x1p-53;
  }

  void
  SizeDistribution::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "size distribution",
      kind,
      "How diameters scatter: single (all are the diameter above), list, uniform "
      "(between smallest and largest), normal (the diameter above is the mean) or "
      "log-normal (it is the median).",
      dealii::Patterns::Selection("single|list|uniform|normal|log-normal"));
    prm.add_parameter(
      "size weighting",
      weighting,
      "What the size distribution and its weights are shares of: mass, as a sieve "
      "analysis gives it, or number of particles.",
      dealii::Patterns::Selection("mass|number"));
    prm.add_parameter("size deviation",
                      deviation,
                      "Standard deviation of the normal distribution [m].");
    prm.add_parameter("size log deviation",
                      log_deviation,
                      "Standard deviation of the natural logarithm of the diameter in "
                      "the log-normal distribution [-].");
    prm.add_parameter("smallest diameter",
                      smallest,
                      "Diameter of original particles below which the distribution is "
                      "cut off; 0 for three standard deviations [m].");
    prm.add_parameter("largest diameter",
                      largest,
                      "Diameter of original particles above which the distribution is "
                      "cut off; 0 for three standard deviations [m].");
    prm.add_parameter("diameters",
                      diameters,
                      "Diameters of original particles in the size distribution list [m].");
    prm.add_parameter("diameter weights",
                      weights,
                      "Shares of these diameters, of any sum, in the mass or number of "
                      "the type [-].");
  }

  void
  SizeDistribution::check(const std::string &section, const double nominal) const
  {
    if (kind == "single")
      return;
    if (kind == "list")
      {
        require(!diameters.empty(),
                section + "/diameters",
                "the size distribution is a list, which needs at least one diameter, in "
                "metres");
        require(weights.size() == diameters.size(),
                section + "/diameter weights",
                "each of the " + std::to_string(diameters.size()) +
                  " diameters of the list needs one weight");
        double sum = 0.;
        for (const double weight : weights)
          {
            require(weight >= 0.,
                    section + "/diameter weights",
                    "a share cannot be negative");
            sum += weight;
          }
        require(sum > 0., section + "/diameter weights", "some share must be positive");
      }
    if (kind == "normal")
      require(deviation > 0.,
              section + "/size deviation",
              "a normal distribution needs a positive standard deviation, in metres");
    if (kind == "log-normal")
      require(log_deviation > 0. && log_deviation <= 1.,
              section + "/size log deviation",
              "a log-normal distribution needs a standard deviation of ln d between 0 and "
              "1");
    if (kind == "uniform")
      require(smallest > 0. && largest > 0.,
              section + "/smallest diameter",
              "a uniform distribution needs the smallest and the largest diameter, in "
              "metres");

    const double least = smallest_diameter(nominal), most = largest_diameter(nominal);
    const std::string which = kind == "list" ? "/diameters" : "/smallest diameter";
    require(least > 0.,
            section + which,
            "the distribution reaches down to no diameter at all; cut it off higher, in "
            "metres");
    require(least < most || (kind == "list" && least == most),
            section + which,
            "the smallest diameter must lie below the largest one");
    require(least >= least_ratio * most,
            section + which,
            "particles of one type differ by more than 1 : 20 in diameter, and the "
            "smallest decides the substep; cut the distribution off");
  }

  double
  SizeDistribution::smallest_diameter(const double nominal) const
  {
    if (kind == "single")
      return nominal;
    if (kind == "list")
      return diameters.empty() ? 0. :
                                 *std::min_element(diameters.begin(), diameters.end());
    if (smallest > 0.)
      return smallest;
    return kind == "normal" ? nominal - usual_tail * deviation :
                              nominal * std::exp(-usual_tail * log_deviation);
  }

  double
  SizeDistribution::largest_diameter(const double nominal) const
  {
    if (kind == "single")
      return nominal;
    if (kind == "list")
      return diameters.empty() ? 0. :
                                 *std::max_element(diameters.begin(), diameters.end());
    if (largest > 0.)
      return largest;
    return kind == "normal" ? nominal + usual_tail * deviation :
                              nominal * std::exp(usual_tail * log_deviation);
  }

  double
  SizeDistribution::relative_density(const double d, const double nominal) const
  {
    if (kind == "normal")
      {
        const double t = (d - nominal) / deviation;
        return std::exp(-0.5 * t * t);
      }
    if (kind == "log-normal")
      {
        // Over its greatest value, that at D exp(-sigma^2).
        const double sigma = log_deviation;
        const double t     = std::log(d / nominal) / sigma;
        return std::exp(-0.5 * (t * t + sigma * sigma)) * nominal / d;
      }
    return 1.;
  }

  double
  SizeDistribution::draw(const double nominal, std::mt19937_64 &generator) const
  {
    if (kind == "single")
      return nominal;
    if (kind == "list")
      return draw_from_list(generator);

    // By rejection: the functions of the library, which may differ in the last
    // bit, decide only whether a diameter is taken, not what it is.
    const double least = smallest_diameter(nominal), most = largest_diameter(nominal);
    while (true)
      {
        const double d       = least + (most - least) * uniform_number(generator);
        double       density = relative_density(d, nominal);
        if (weighting == "mass")
          density *= cube(least / d);
        if (uniform_number(generator) < density)
          return d;
      }
  }

  double
  SizeDistribution::draw_from_list(std::mt19937_64 &generator) const
  {
    std::vector<double> up_to;
    double              sum = 0.;
    for (std::size_t k = 0; k < diameters.size(); ++k)
      up_to.push_back(sum +=
                      weighting == "mass" ? weights[k] / cube(diameters[k]) : weights[k]);
    const double x = sum * uniform_number(generator);
    const auto   k = std::upper_bound(up_to.begin(), up_to.end(), x) - up_to.begin();
    return diameters[std::min<std::size_t>(k, diameters.size() - 1)];
  }
} // namespace graupel
