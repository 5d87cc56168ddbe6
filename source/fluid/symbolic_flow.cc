// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/fluid/symbolic_flow.h>

#include <ginac/ginac.h>

#include <sstream>
#include <stdexcept>

namespace graupel
{
  namespace
  {
    using GiNaC::ex;
    using VectorEx = std::array<ex, 3>;

    class Reader
    {
    public:
      Reader()
        : parser(table())
      {
      }

      ex
      operator()(const std::string &text)
      {
        try
          {
            return parser(text);
          }
        catch (const std::exception &error)
          {
            throw std::runtime_error("\"" + text +
                                     "\" cannot be differentiated: " + error.what());
          }
      }

      VectorEx
      operator()(const VectorExpression &text)
      {
        return {(*this)(text[0]), (*this)(text[1]), (*this)(text[2])};
      }

      const std::array<GiNaC::symbol, 3> x{
        GiNaC::symbol("x"), GiNaC::symbol("y"), GiNaC::symbol("z")};
      const GiNaC::symbol t{"t"};

    private:
      GiNaC::symtab
      table() const
      {
        GiNaC::symtab result;
        result["x"]  = x[0];
        result["y"]  = x[1];
        result["z"]  = x[2];
        result["t"]  = t;
        result["pi"] = GiNaC::Pi;
        return result;
      }

      GiNaC::parser parser;
    };

    std::string
    print(const ex &expression)
    {
      std::ostringstream text;
      text.precision(17);
      text << GiNaC::dflt << GiNaC::evalf(expression);
      return text.str();
    }

    VectorExpression
    print(const VectorEx &expression)
    {
      return {print(expression[0]), print(expression[1]), print(expression[2])};
    }
  } // namespace

  NeededSources
  derive_sources(const GivenFlow &flow, const double density, const double viscosity)
  {
    Reader   read;
    const ex alpha = read(flow.void_fraction), p = read(flow.pressure),
             drag    = read(flow.drag);
    const VectorEx u = read(flow.velocity), v = read(flow.particle_velocity);
    const auto    &x = read.x;

    ex divergence = 0;
    for (unsigned int i = 0; i < 3; ++i)
      divergence += u[i].diff(x[i]);
    const auto stress = [&](const unsigned int i, const unsigned int j) -> ex {
      ex result = u[i].diff(x[j]) + u[j].diff(x[i]);
      if (i == j)
        result -= GiNaC::numeric(2, 3) * divergence;
      return alpha * viscosity * result;
    };

    VectorEx q, c, f, traction;
    ex       s = alpha.diff(read.t);
    for (unsigned int i = 0; i < 3; ++i)
      {
        q[i] = alpha * u[i];
        c[i] = drag * v[i];
        f[i] = density * q[i].diff(read.t) + alpha * p.diff(x[i]) + drag * (u[i] - v[i]);
        for (unsigned int j = 0; j < 3; ++j)
          f[i] += density * (q[i] * u[j]).diff(x[j]) - stress(i, j).diff(x[j]);
        s += q[i].diff(x[i]);
        traction[i] = stress(i, 2);
      }
    return {print(q), print(c), print(f), print(s), print(traction)};
  }
} // namespace graupel
