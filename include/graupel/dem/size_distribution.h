#ifndef graupel_dem_size_distribution_h
#define graupel_dem_size_distribution_h

#include <deal.II/base/parameter_handler.h>

#include <random>
#include <string>
#include <vector>

namespace graupel
{
  /**
   * A random number in [0, 1), the same on every platform: the standard leaves
   * its own distributions to the library, but not the generator.
   */
  double uniform_number(std::mt19937_64 &generator);

  /**
   * How the diameters of one type of particles scatter around its nominal
   * diameter D. Densities are of MASS: g(d) dd is the share of the mass in
   * particles of a diameter between d and d + dd; of NUMBER if so weighted. In
   * number a share of mass g means f ~ g / d^3.
   */
  struct SizeDistribution
  {
    /**
     * "single": all of diameter D; "list": those of @p diameters; "uniform": from
     * smallest to largest; "normal": D is the mean, @p deviation the standard
     * deviation; "log-normal": D is the median, @p log_deviation the standard
     * deviation of ln d. The latter two are cut off at smallest and largest.
     */
    std::string kind = "single";
    /** What the weights and densities count: "mass" or "number". */
    std::string weighting = "mass";
    /** Standard deviation of the normal distribution [m]. */
    double deviation = 0.;
    /** Standard deviation of ln d of the log-normal distribution [-]. */
    double log_deviation = 0.;
    /** Cut-offs [m]; zero: three standard deviations off. */
    double smallest = 0.;
    double largest  = 0.;
    /** Diameters of the list [m] and their weights [-]. */
    std::vector<double> diameters;
    std::vector<double> weights;

    /** Declares its entries in the section that is open. */
    void declare(dealii::ParameterHandler &prm);
    /** @p section is the path of the entries, for errors. */
    void check(const std::string &section, const double nominal) const;

    /** The least and the greatest diameter that occur [m]. */
    double smallest_diameter(const double nominal) const;
    double largest_diameter(const double nominal) const;

    /** The diameter of one particle [m], drawn by number. */
    double draw(const double nominal, std::mt19937_64 &generator) const;

  private:
    double relative_density(const double d, const double nominal) const;
    double draw_from_list(std::mt19937_64 &generator) const;

    /** Least over greatest diameter of one type below which a list is refused [-]. */
    static constexpr double least_ratio = 0.05;
  };
} // namespace graupel

#endif
