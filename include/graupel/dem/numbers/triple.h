// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_dem_numbers_triple_h
#define graupel_dem_numbers_triple_h

#include <deal.II/base/tensor.h>

#include <cmath>

namespace graupel
{
  /** A vector of three components, each a double or Lanes of doubles. */
  template <class Real>
  struct Triple
  {
    Real x = 0., y = 0., z = 0.;

    Triple &
    operator+=(const Triple &other)
    {
      x += other.x;
      y += other.y;
      z += other.z;
      return *this;
    }

    Triple &
    operator-=(const Triple &other)
    {
      x -= other.x;
      y -= other.y;
      z -= other.z;
      return *this;
    }

    Triple &
    operator*=(const Real &factor)
    {
      x *= factor;
      y *= factor;
      z *= factor;
      return *this;
    }

    friend Triple
    operator+(Triple a, const Triple &b)
    {
      return a += b;
    }

    friend Triple
    operator-(Triple a, const Triple &b)
    {
      return a -= b;
    }

    friend Triple
    operator-(const Triple &a)
    {
      return {-a.x, -a.y, -a.z};
    }

    friend Triple
    operator*(const Real &factor, Triple a)
    {
      return a *= factor;
    }

    /** Scalar product. */
    friend Real
    operator*(const Triple &a, const Triple &b)
    {
      return a.x * b.x + a.y * b.y + a.z * b.z;
    }

    Real
    norm_square() const
    {
      return *this * *this;
    }

    Real
    norm() const
    {
      using std::sqrt;
      return sqrt(norm_square());
    }
  };

  /** Vector product. */
  template <class Real>
  Triple<Real>
  cross(const Triple<Real> &a, const Triple<Real> &b)
  {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }

  inline Triple<double>
  triple(const dealii::Tensor<1, 3> &a)
  {
    return {a[0], a[1], a[2]};
  }

  inline dealii::Tensor<1, 3>
  tensor(const Triple<double> &a)
  {
    return dealii::Tensor<1, 3>({a.x, a.y, a.z});
  }
} // namespace graupel

#endif
