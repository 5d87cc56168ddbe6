#ifndef graupel_closures_drag_laws_h
#define graupel_closures_drag_laws_h

#include <string>
#include <vector>

namespace graupel
{
  // Drag on one sphere of diameter d in a bed of void fraction alpha, for the
  // model-A equations (both phases share the pressure gradient) and with the
  // slip between the interstitial velocity u and the sphere's velocity v:
  //
  //   F = 1/2 rho C_d (pi d^2 / 4) |u - v| (u - v),   Re = rho |u - v| d / mu.
  //
  // C_d grows without bound as the slip vanishes; the laws therefore return the
  // drag number N = C_d Re [-], which stays finite and with which
  //
  //   F = beta_p (u - v),   beta_p = pi/8 mu d N.
  //
  // The exchange coefficient beta per volume of the literature is
  // (1 - alpha) / V_p spheres times beta_p, with V_p = pi d^3 / 6, hence
  //
  //   N = 4/3 beta d^2 / ((1 - alpha) mu).
  //
  // All hold for 0 < alpha <= 1 and Re >= 0 and do not check it.

  /**
   * Ergun's law, N = 4/3 (150 (1 - alpha) / alpha + 1.75 Re), so that
   * C_d = 4/3 (150 (1 - alpha) / (alpha Re) + 1.75) [-]. Gives Ergun's pressure
   * gradient in a uniform bed:
   * beta = 150 (1 - alpha)^2 mu / (alpha d^2) + 1.75 (1 - alpha) rho |u - v| / d.
   * Source: Gidaspow, Multiphase Flow and Fluidization (1994), ch. 2; Ergun,
   * Chem. Eng. Prog. 48 (1952) 89.
   */
  double ergun_drag_number(const double alpha, const double reynolds);

  /**
   * Wen and Yu's law, C_d = C_0(alpha Re) alpha^-1.65 [-], from
   * beta = 3/4 C_0 alpha (1 - alpha) rho |u - v| / d alpha^-2.65, with the drag
   * coefficient of one sphere in clear fluid, at the superficial slip,
   *
   *   C_0(x) = 24 / x (1 + 0.15 x^0.687) for x < 1000, else 0.44.
   *
   * Source: Gidaspow, Multiphase Flow and Fluidization (1994), ch. 2; Wen & Yu,
   * Chem. Eng. Prog. Symp. Ser. 62 (1966) 100; C_0 by Schiller & Naumann (1935).
   */
  double wen_yu_drag_number(const double alpha, const double reynolds);

  /**
   * Gidaspow's law: Ergun's below void fraction 0.8, Wen and Yu's from there
   * on. It jumps at 0.8.
   * Source: Ding & Gidaspow (1990), doi:10.1002/aic.690360404.
   */
  double gidaspow_drag_number(const double alpha, const double reynolds);

  /** What the program knows of a law. */
  struct DragLaw
  {
    /** As in a parameter file. */
    std::string name;
    /** N = C_d Re [-] of void fraction [-] and particle Reynolds number [-]. */
    double (*drag_number)(const double alpha, const double reynolds);
    /** The formula, in a line for the reader. */
    std::string form;
    /** Who found it. */
    std::string source;
  };

  /** All laws. A new law adds one line there. */
  const std::vector<DragLaw> &drag_laws();

  /** The law of this name; throws std::out_of_range if there is none. */
  const DragLaw &find_drag_law(const std::string &name);

  /** C_d [-] of a law; infinite at rest. */
  double drag_coefficient(const DragLaw &law, const double alpha, const double reynolds);
} // namespace graupel

#endif
