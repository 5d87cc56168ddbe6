#ifndef graupel_closures_bed_correlations_h
#define graupel_closures_bed_correlations_h

#include <graupel/closures/fluid_properties.h>

#include <vector>

namespace graupel
{
  /**
   * Pressure gradient G [Pa/m] (positive: the loss along the flow) of a bed of
   * spheres of diameter @p diameter [m] with void fraction @p alpha [-] at the
   * superficial velocity V >= 0 [m/s]:
   *
   *   G = a V + b V^2,  a = 150 (1 - alpha)^2 mu / (alpha^3 d^2),
   *                     b = 1.75 (1 - alpha) rho / (alpha^3 d).
   *
   * Source: Ergun, Chem. Eng. Prog. 48 (1952) 89; Ricklick & Baran (2014),
   * eqs. 6 and 7.
   */
  double ergun_pressure_gradient(const FluidProperties &fluid,
                                 const double           diameter,
                                 const double           alpha,
                                 const double           superficial_velocity);

  /** The gradient above times the @p length [m] of the bed [Pa]. */
  double ergun_pressure_drop(const FluidProperties &fluid,
                             const double           diameter,
                             const double           alpha,
                             const double           superficial_velocity,
                             const double           length);

  /**
   * Superficial velocity [m/s] at which the gradient above is @p gradient
   * >= 0 [Pa/m]: the positive root, V = 2 G / (a + sqrt(a^2 + 4 b G)).
   */
  double ergun_superficial_velocity(const FluidProperties &fluid,
                                    const double           diameter,
                                    const double           alpha,
                                    const double           gradient);

  /**
   * Superficial velocity [m/s] at the onset of fluidisation, where Ergun's
   * gradient carries the weight less the buoyancy of the spheres,
   * G = (1 - alpha) (rho_p - rho) g. Densities in [kg/m^3], @p gravity in
   * [m/s^2]; 0 for spheres that float.
   */
  double ergun_onset_velocity(const FluidProperties &fluid,
                              const double           diameter,
                              const double           alpha,
                              const double           particle_density,
                              const double           gravity = 9.81);

  /** Flow area [m^2] and void fraction [-] of one of several channels side by side. */
  struct Channel
  {
    double area;
    double alpha;
  };

  /**
   * The pressure gradient G [Pa/m] that channels of different void fraction
   * share at the mean superficial velocity V [m/s]: sum A_i V_i(G) = V sum A_i,
   * each V_i by Ergun. With annuli that get looser towards the wall it tells
   * how much of a bed's deviation from Ergun is channelling. To about 14
   * digits; between the gradients of the loosest and of the densest channel.
   * Throws std::invalid_argument without channels, and for a
   * channel without area or with a void fraction outside (0, 1].
   */
  double parallel_channels_pressure_gradient(const FluidProperties      &fluid,
                                             const double                diameter,
                                             const std::vector<Channel> &channels,
                                             const double superficial_velocity);
} // namespace graupel

#endif
