#include <graupel/closures/drag_laws.h>

#include <stdexcept>

namespace graupel
{
  double
  ergun_drag_number(const double alpha, const double reynolds)
  {
    const double viscous  = 150. * (1. - alpha) / alpha;
    const double inertial = 1.75 * reynolds;
    return 4. / 3. * (viscous + inertial);
  }

  double
  wen_yu_drag_number(const double alpha, const double reynolds)
  {
    const double superficial = alpha * reynolds;
    const double one_sphere  = superficial < 1000.
                                 ? 24. * (1. + 0.15 * std::pow(superficial, 0.687))
                                 : 0.44 * superficial;
    return one_sphere * std::pow(alpha, -2.65);
  }

  double
  gidaspow_drag_number(const double alpha, const double reynolds)
  {
    return alpha < 0.8 ? ergun_drag_number(alpha, reynolds)
                       : wen_yu_drag_number(alpha, reynolds);
  }

  const std::vector<DragLaw> &
  drag_laws()
  {
    static const std::vector<DragLaw> laws{
      {"gidaspow",
       gidaspow_drag_number,
       "ergun below void fraction 0.8, wen-yu from there on",
       "Ding & Gidaspow (1990)"},
      {"ergun",
       ergun_drag_number,
       "C_d = 4/3 (150 (1 - alpha) / (alpha Re) + 1.75)",
       "Ergun (1952)"},
      {"wen-yu",
       wen_yu_drag_number,
       "C_d = 24 / (alpha Re) (1 + 0.15 (alpha Re)^0.687) alpha^-1.65, with 0.44 in "
       "place "
       "of the first factors from alpha Re = 1000 on",
       "Wen & Yu (1966)"}};
    return laws;
  }

  const DragLaw &
  find_drag_law(const std::string &name)
  {
    for (const DragLaw &law : drag_laws())
      if (law.name == name)
        return law;
    throw std::out_of_range("There is no drag law \"" + name + "\".");
  }

  double
  drag_coefficient(const DragLaw &law, const double alpha, const double reynolds)
  {
    return law.drag_number(alpha, reynolds) / reynolds;
  }
} // namespace graupel
