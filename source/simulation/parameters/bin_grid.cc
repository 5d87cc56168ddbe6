// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/simulation/parameters/bin_grid.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <set>

namespace graupel
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    // More bins than anyone reads.
    constexpr double most_bins = 1e6;
    // Cosine of an angle that is a right one still.
    constexpr double right_angle = 1e-6;

    Point<3>
    point_at(const std::vector<double> &numbers, const unsigned int first)
    {
      return {numbers[first], numbers[first + 1], numbers[first + 2]};
    }

    unsigned int
    count_of(const std::string &parameter, const std::string &name, const double number)
    {
      require(number >= 1. && number <= most_bins && number == std::floor(number),
              parameter,
              name + " needs a whole number of bins, at least 1");
      return static_cast<unsigned int>(number);
    }

    // Of a grid's side that is no point.
    Tensor<1, 3>
    direction(const std::string  &parameter,
              const std::string  &name,
              const Tensor<1, 3> &way)
    {
      require(way.norm() > 0., parameter, name + " begins where it ends");
      return way / way.norm();
    }

    // From sides of @p grid that meet in its corner, in the middle of what lies across.
    void
    widen(const std::string &parameter, BinGrid &grid, const unsigned int axis)
    {
      require(grid.sizes[axis] > 0.,
              parameter,
              grid.name + " needs a positive width and thickness, in metres");
      grid.corner -= 0.5 * grid.sizes[axis] * grid.axes[axis];
    }

    BinGrid
    line_of(const std::string         &parameter,
            const std::string         &name,
            const std::vector<double> &numbers)
    {
      BinGrid            grid;
      const Tensor<1, 3> way = point_at(numbers, 3) - point_at(numbers, 0);
      grid.name              = name;
      grid.corner            = point_at(numbers, 0);
      grid.axes[0]           = direction(parameter, name, way);
      const Tensor<1, 3> up({0., 0., 1.});
      const Tensor<1, 3> level = dealii::cross_product_3d(up, grid.axes[0]);
      grid.axes[1] =
        level.norm() > right_angle ? level / level.norm() : Tensor<1, 3>({1., 0., 0.});
      grid.axes[2] = dealii::cross_product_3d(grid.axes[0], grid.axes[1]);
      grid.sizes   = {{way.norm(), numbers[7], numbers[8]}};
      grid.counts  = {{count_of(parameter, name, numbers[6]), 1, 1}};
      widen(parameter, grid, 1);
      widen(parameter, grid, 2);
      return grid;
    }

    BinGrid
    plane_of(const std::string         &parameter,
             const std::string         &name,
             const std::vector<double> &numbers)
    {
      BinGrid            grid;
      const Tensor<1, 3> one   = point_at(numbers, 3) - point_at(numbers, 0);
      const Tensor<1, 3> other = point_at(numbers, 6) - point_at(numbers, 0);
      grid.name                = name;
      grid.corner              = point_at(numbers, 0);
      grid.axes[0]             = direction(parameter, name, one);
      grid.axes[1]             = direction(parameter, name, other);
      require(std::abs(grid.axes[0] * grid.axes[1]) < right_angle,
              parameter,
              "the sides of " + name + " are not at right angles");
      grid.axes[2] = dealii::cross_product_3d(grid.axes[0], grid.axes[1]);
      grid.sizes   = {{one.norm(), other.norm(), numbers[11]}};
      grid.counts  = {{count_of(parameter, name, numbers[9]),
                       count_of(parameter, name, numbers[10]),
                       1}};
      widen(parameter, grid, 2);
      return grid;
    }

    template <typename Make>
    std::vector<BinGrid>
    read_grids(const std::string &parameter,
               const std::string &text,
               const unsigned int n_numbers,
               const std::string &form,
               const Make        &make)
    {
      std::vector<BinGrid>  grids;
      std::set<std::string> names;
      for (const auto &entry : dealii::Utilities::split_string_list(text, '|'))
        {
          const auto colon   = entry.find(':');
          const auto numbers = colon == std::string::npos
                                 ? std::vector<double>()
                                 : read_numbers(parameter, entry.substr(colon + 1));
          require(numbers.size() == n_numbers,
                  parameter,
                  "\"" + entry + "\" is none: write " + form +
                    "; several are separated by bars (|)");
          const std::string name = dealii::Utilities::trim(entry.substr(0, colon));
          require(!name.empty() && name.find_first_of(",\" ") == std::string::npos,
                  parameter,
                  "a name without blanks, commas or quotes goes before the colon");
          require(names.insert(name).second, parameter, "there are two named " + name);
          grids.push_back(make(parameter, name, numbers));
        }
      return grids;
    }
  } // namespace

  unsigned int
  BinGrid::n_bins() const
  {
    return counts[0] * counts[1] * counts[2];
  }

  std::array<unsigned int, 3>
  BinGrid::places(const unsigned int bin) const
  {
    return {{bin % counts[0], bin / counts[0] % counts[1], bin / counts[0] / counts[1]}};
  }

  std::array<double, 3>
  BinGrid::in_frame(const Point<3> &point) const
  {
    const Tensor<1, 3> way = point - corner;
    return {{way * axes[0], way * axes[1], way * axes[2]}};
  }

  std::optional<unsigned int>
  BinGrid::bin_at(const Point<3> &point) const
  {
    const auto                  place = in_frame(point);
    std::array<unsigned int, 3> at;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double part = place[i] / width(i);
        if (!(part >= 0. && part < counts[i]))
          return {};
        at[i] = static_cast<unsigned int>(part);
      }
    return at[0] + counts[0] * (at[1] + counts[1] * at[2]);
  }

  Point<3>
  BinGrid::point_of(const unsigned int bin, const std::array<double, 3> &parts) const
  {
    const auto at    = places(bin);
    Point<3>   point = corner;
    for (unsigned int i = 0; i < 3; ++i)
      point += (at[i] + parts[i]) * width(i) * axes[i];
    return point;
  }

  std::vector<BinGrid>
  read_lines(const std::string &parameter, const std::string &text)
  {
    return read_grids(parameter,
                      text,
                      9,
                      "NAME: x y z x y z BINS WIDTH THICKNESS, where the line begins and "
                      "where it ends, its bins, and how far they reach across it",
                      line_of);
  }

  std::vector<BinGrid>
  read_planes(const std::string &parameter, const std::string &text)
  {
    return read_grids(
      parameter,
      text,
      12,
      "NAME: x y z x y z x y z BINS BINS THICKNESS, a corner and the ends "
      "of both sides, the bins along them, and the thickness",
      plane_of);
  }
} // namespace graupel
