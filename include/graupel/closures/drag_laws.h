// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

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

  /**
   * Gidaspow's law without the jump: (1 - w) Ergun + w Wen-Yu with
   * w = arctan(262.5 (alpha - 0.8)) / pi + 1/2. In a packed bed w is 0.003.
   * Source: Lu & Gidaspow, Chem. Eng. Sci. 58 (2003) 3777.
   */
  double blended_gidaspow_drag_number(const double alpha, const double reynolds);

  /**
   * Di Felice's law, C_d = C_0(x) alpha^(2 - chi) [-], x = alpha Re, with
   * C_0 = (0.63 + 4.8 x^-1/2)^2 (Dallavalle) and
   * chi = 3.7 - 0.65 exp(-(1.5 - log10 x)^2 / 2). The drag beside the common pressure
   * gradient: it is in balance with alpha times the weight less the buoyancy.
   * Source: Di Felice (1994), doi:10.1016/0301-9322(94)90011-6.
   */
  double di_felice_drag_number(const double alpha, const double reynolds);

  /**
   * Rong, Dong and Yu's law from lattice-Boltzmann simulations of packed beds, as Di
   * Felice's with
   * chi = 2.65 (alpha + 1) - (5.3 - 3.5 alpha) alpha^2 exp(-(1.5 - log10 x)^2 / 2).
   * Source: Rong, Dong & Yu (2013), doi:10.1016/j.ces.2013.05.036.
   */
  double rong_drag_number(const double alpha, const double reynolds);

  /**
   * Hill, Koch and Ladd's law from lattice-Boltzmann simulations,
   * N = 24 alpha^2 (F_0 + F_3 x / 2), x = alpha Re, from
   * beta = 18 mu alpha^2 phi / d^2 (F_0 + F_3 x / 2), phi = 1 - alpha, with
   *
   *   F_0 = (1 + 3 (phi/2)^1/2 + 135/64 phi ln phi + 16.14 phi) /
   *         (1 + 0.681 phi - 8.48 phi^2 + 8.16 phi^3) for phi < 0.4, else
   *         10 phi / alpha^3,
   *   F_3 = 0.0673 + 0.212 phi + 0.0232 / alpha^5.
   *
   * Source: Hill, Koch & Ladd (2001), doi:10.1017/S0022112001005936; the form of
   * Benyahia, Syamlal & O'Brien (2006), doi:10.1016/j.powtec.2005.12.014, without its
   * small range of very low Reynolds numbers.
   */
  double koch_hill_drag_number(const double alpha, const double reynolds);

  /**
   * Beetstra, van der Hoef and Kuipers' law from lattice-Boltzmann simulations,
   * N = 24 alpha F, x = alpha Re, phi = 1 - alpha,
   *
   *   F = 10 phi / alpha^2 + alpha^2 (1 + 1.5 phi^1/2)
   *       + 0.413 x / (24 alpha^2) (1/alpha + 3 phi alpha + 8.4 x^-0.343)
   *         / (1 + 10^(3 phi) x^-(1 + 4 phi)/2),
   *
   * the drag over 3 pi mu d alpha |u - v|, without the pressure gradient's part.
   * Source: Beetstra, van der Hoef & Kuipers (2007), doi:10.1002/aic.11065.
   */
  double beetstra_drag_number(const double alpha, const double reynolds);

  /**
   * Tang et al.'s law from immersed-boundary simulations, N = 24 alpha F as Beetstra's,
   *
   *   F = 10 phi / alpha^2 + alpha^2 (1 + 1.5 phi^1/2)
   *       + x (0.11 phi (1 + phi) - 0.00456 / alpha^4
   *            + (0.169 alpha + 0.0644 / alpha^4) x^-0.343).
   *
   * Source: Tang, Peters, Kuipers, Kriebitzsch & van der Hoef (2015),
   * doi:10.1002/aic.14645.
   */
  double tang_drag_number(const double alpha, const double reynolds);

  /**
   * Gibilaro et al.'s law, N = 4/3 (17.3 / alpha + 0.336 Re) alpha^-1.8, from the
   * pressure gradient (17.3 / x + 0.336) rho V^2 / d (1 - alpha) alpha^-4.8, x = alpha
   * Re. Source: Gibilaro, Di Felice, Waldram & Foscolo (1985),
   * doi:10.1016/0009-2509(85)80116-0.
   */
  double gibilaro_drag_number(const double alpha, const double reynolds);

  /**
   * The rule of the German nuclear safety standards commission for pebble beds,
   * N = 2/3 / alpha (320 phi + 6 phi^0.1 x^0.9), from the pressure gradient
   * psi phi / alpha^3 rho V^2 / (2 d), psi = 320 phi / x + 6 (phi / x)^0.1. For packed
   * beds; no drag on a single sphere.
   * Source: KTA 3102.3, Reactor core design of high-temperature gas-cooled reactors,
   * part 3: loss of pressure through friction in pebble bed cores (1981).
   */
  double kta_drag_number(const double alpha, const double reynolds);

  /**
   * Erdim, Akgiray and Demir's law for packed beds,
   * N = 4/3 / alpha (160 phi + 2.81 phi^0.096 x^0.904), from the pressure gradient
   * (160 + 2.81 (x / phi)^0.904) mu V phi^2 / (d^2 alpha^3). No drag on a single sphere.
   * Source: Erdim, Akgiray & Demir (2015), doi:10.1016/j.powtec.2015.06.017.
   */
  double erdim_drag_number(const double alpha, const double reynolds);

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

  /**
   * Factor on the drag coefficient beta_p of the law for spheres of the Sauter mean
   * diameter <d>, which gives that of a sphere of diameter @p y <d> in a mixture of void
   * fraction @p alpha [-]:
   *
   *   y (alpha y + (1 - alpha) y^2).
   *
   * The sum over all spheres is that of equal ones of the Sauter mean diameter and the
   * same volume, for any mixture. The cubic term that the source fits to simulations,
   * which is not 0 for equal spheres, is left out.
   * Source: van der Hoef, Beetstra & Kuipers, J. Fluid Mech. 528 (2005) 233,
   * doi:10.1017/S0022112004003295.
   */
  double polydisperse_drag_factor(const double alpha, const double y);
} // namespace graupel

#endif
