// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/dem/walls/surface_mesh.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using dealii::Tensor;

  using Triangles = std::vector<std::array<Point<3>, 3>>;
  using Touches   = std::vector<SurfaceMesh::Touch>;

  Touches
  touches(const SurfaceMesh &mesh, const Point<3> &center, const double reach)
  {
    Touches result;
    mesh.touches(center, reach, result);
    return result;
  }

  // Two triangles a rectangle, wound one against the other: winding is no matter.
  void
  add_rectangle(Triangles          &triangles,
                const Point<3>     &origin,
                const Tensor<1, 3> &a,
                const Tensor<1, 3> &b)
  {
    triangles.push_back({{origin, origin + a, origin + a + b}});
    triangles.push_back({{origin, origin + b, origin + a + b}});
  }

  // n x n squares in the plane spanned by a and b.
  Triangles
  plate(const Point<3>     &origin,
        const Tensor<1, 3> &a,
        const Tensor<1, 3> &b,
        const unsigned int  n)
  {
    const auto node = [&](const unsigned int i, const unsigned int j) {
      return origin + (double(i) / n) * a + (double(j) / n) * b;
    };
    Triangles triangles;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          triangles.push_back({{node(i, j), node(i + 1, j), node(i + 1, j + 1)}});
          triangles.push_back({{node(i, j), node(i + 1, j + 1), node(i, j + 1)}});
        }
    return triangles;
  }

  const Tensor<1, 3> x({1., 0., 0.}), y({0., 1., 0.}), z({0., 0., 1.});

  // The box 0 to 1 in each direction, n x n squares a side.
  Triangles
  unit_box(const unsigned int n)
  {
    Triangles  triangles;
    const auto add =
      [&](const Point<3> &origin, const Tensor<1, 3> &a, const Tensor<1, 3> &b) {
        for (const auto &t : plate(origin, a, b, n))
          triangles.push_back(t);
      };
    for (const double end : {0., 1.})
      {
        add(Point<3>(end, 0., 0.), y, z);
        add(Point<3>(0., end, 0.), x, z);
        add(Point<3>(0., 0., end), x, y);
      }
    return triangles;
  }

  // Distance from a triangle by another route than that of the library: through
  // the projection if it is inside, judged by areas, else from the three sides.
  double
  distance_by_projection(const std::array<Point<3>, 3> &t, const Point<3> &c)
  {
    const auto   normal = dealii::cross_product_3d(t[1] - t[0], t[2] - t[0]);
    const double height = (c - t[0]) * normal / normal.norm();
    const auto   foot   = c - height * normal / normal.norm();
    bool         inside = true;
    double       least  = std::numeric_limits<double>::max();
    for (unsigned int k = 0; k < 3; ++k)
      {
        const auto side = t[(k + 1) % 3] - t[k];
        inside = inside && dealii::cross_product_3d(side, foot - t[k]) * normal >= 0.;
        const double s =
          std::min(1., std::max(0., (c - t[k]) * side / side.norm_square()));
        least = std::min(least, c.distance(t[k] + s * side));
      }
    return inside ? std::abs(height) : least;
  }

  double
  distance_by_brute_force(const Triangles &triangles, const Point<3> &c)
  {
    double least = std::numeric_limits<double>::max();
    for (const auto &t : triangles)
      least = std::min(least, distance_by_projection(t, c));
    return least;
  }

  // A plane has one contact, from both sides; on it the normal is its own.
  TEST(SurfaceMesh, PlaneFromBothSides)
  {
    const SurfaceMesh mesh(plate(Point<3>(-1., -1., 0.), 2. * x, 2. * y, 1));
    EXPECT_EQ(mesh.n_triangles(), 2u);
    EXPECT_EQ(mesh.n_facets(), 1u);
    EXPECT_EQ(mesh.n_free_edges(), 4u);
    for (const double height : {0.3, 1e-3, -1e-3, -0.3})
      {
        const auto t = touches(mesh, Point<3>(0.3, 0.1, height), 0.5);
        ASSERT_EQ(t.size(), 1u);
        EXPECT_NEAR(t[0].distance, std::abs(height), 1e-16);
        EXPECT_NEAR(t[0].normal[2], height > 0. ? -1. : 1., 1e-15);
        EXPECT_NEAR(t[0].point.distance(Point<3>(0.3, 0.1, 0.)), 0., 1e-16);
      }
    for (const Point<3> &on : {Point<3>(0.3, 0.1, 0.), Point<3>(0.2, 0.2, 0.)})
      {
        const auto t = touches(mesh, on, 0.5);
        ASSERT_EQ(t.size(), 1u);
        EXPECT_LE(t[0].distance, 1e-16);
        EXPECT_NEAR(std::abs(t[0].normal[2]), 1., 1e-15);
      }
    // Nearer than reach, not as near.
    EXPECT_TRUE(touches(mesh, Point<3>(0.3, 0.1, 0.5), 0.5).empty());
    EXPECT_FALSE(mesh.near(Point<3>(0.3, 0.1, 0.5), 0.5));
    EXPECT_TRUE(mesh.near(Point<3>(0.3, 0.1, 0.499), 0.5));
    EXPECT_EQ(mesh.bounding_box().get_boundary_points().second, Point<3>(1., 1., 0.));
  }

  // Inside a box a sphere touches each face within reach once, whatever their
  // triangles: up to three of them in a corner. Exact count, limit rounding.
  TEST(SurfaceMesh, BoxFromInside)
  {
    const SurfaceMesh mesh(unit_box(5));
    EXPECT_EQ(mesh.n_facets(), 6u);
    EXPECT_EQ(mesh.n_free_edges(), 0u);
    EXPECT_EQ(touches(mesh, Point<3>(0.1, 0.1, 0.1), 0.11).size(), 3u);

    std::mt19937                           random(1);
    std::uniform_real_distribution<double> place(0.001, 0.999);
    unsigned int                           n_by_count[4] = {0, 0, 0, 0};
    for (unsigned int k = 0; k < 20000; ++k)
      {
        const Point<3>      c(place(random), place(random), place(random));
        const double        reach = 0.3;
        std::vector<double> expected, found;
        for (unsigned int d = 0; d < 3; ++d)
          for (const double distance : {c[d], 1. - c[d]})
            if (distance < reach)
              expected.push_back(distance);
        for (const auto &touch : touches(mesh, c, reach))
          found.push_back(touch.distance);
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found.size(), expected.size()) << c;
        for (unsigned int i = 0; i < found.size(); ++i)
          ASSERT_NEAR(found[i], expected[i], 1e-15);
        ++n_by_count[found.size()];
      }
    std::cout << "places with 0 to 3 contacts: " << n_by_count[0] << ' ' << n_by_count[1]
              << ' ' << n_by_count[2] << ' ' << n_by_count[3] << std::endl;
    EXPECT_GT(n_by_count[3], 100u);
  }

  // Outside a convex body there is one contact: on a face, an edge or a corner.
  TEST(SurfaceMesh, BoxFromOutside)
  {
    const SurfaceMesh                      mesh(unit_box(5));
    std::mt19937                           random(2);
    std::uniform_real_distribution<double> place(-0.3, 1.3);
    double                                 worst = 0.;
    unsigned int                           n     = 0;
    for (unsigned int k = 0; k < 20000; ++k)
      {
        // On a grid as well, so that many are right above joints and corners.
        Point<3> c(place(random), place(random), place(random));
        if (k % 2)
          for (unsigned int d = 0; d < 3; ++d)
            c[d] = 0.1 * std::round(10. * c[d]);
        Point<3> nearest;
        for (unsigned int d = 0; d < 3; ++d)
          nearest[d] = std::min(1., std::max(0., c[d]));
        if (c.distance(nearest) < 1e-6)
          continue;
        const auto t = touches(mesh, c, 0.6);
        ASSERT_EQ(t.size(), 1u) << c;
        worst = std::max(worst, t[0].point.distance(nearest));
        ASSERT_NEAR(t[0].distance, c.distance(nearest), 1e-15);
        ASSERT_NEAR(
          (t[0].normal - (nearest - c) / c.distance(nearest)).norm(), 0., 1e-14);
        ++n;
      }
    std::cout << n << " places, nearest point off by " << worst << " m, limit 1e-15"
              << std::endl;
    EXPECT_LE(worst, 1e-15);
    EXPECT_GT(n, 10000u);
  }

  // Around the convex edge between two plates and back: one contact throughout,
  // and one name on the edge whichever way one comes.
  TEST(SurfaceMesh, ConvexEdgeHasOneName)
  {
    Triangles triangles;
    add_rectangle(triangles, Point<3>(0., 0., 0.), -1. * x, y);
    add_rectangle(triangles, Point<3>(0., 0., 0.), -2. * z, y);
    const SurfaceMesh mesh(triangles);
    ASSERT_EQ(mesh.n_facets(), 2u);
    for (int step = -10; step <= 100; ++step)
      {
        const double angle = step * 0.01 * M_PI / 2.;
        const auto   t     = touches(
          mesh, Point<3>(0.1 * std::sin(angle), 0.4, 0.1 * std::cos(angle)), 0.11);
        ASSERT_EQ(t.size(), 1u);
        EXPECT_NEAR(t[0].distance, step < 0 ? 0.1 * std::cos(angle) : 0.1, 1e-16);
        // The plate up the edge has the smaller area, so number 0.
        EXPECT_EQ(t[0].facet, 0u) << step;
      }
  }

  // Two plates that meet at an angle, seen from the concave side: a contact with
  // each whose plane the center projects into, none with the edge.
  TEST(SurfaceMesh, ConcaveWedge)
  {
    for (const double opening : {0.3, 1., M_PI / 2., 2., 3., 3.1})
      {
        const Tensor<1, 3> other({std::cos(opening), 0., std::sin(opening)});
        Triangles          triangles;
        add_rectangle(triangles, Point<3>(), 1. * x, y);
        add_rectangle(triangles, Point<3>(), other, y);
        const SurfaceMesh mesh(triangles);
        ASSERT_EQ(mesh.n_facets(), 2u);
        unsigned int n_double = 0;
        for (double angle = 0.01; angle < opening; angle += 0.02)
          {
            const Point<3>     c(0.1 * std::cos(angle), 0.5, 0.1 * std::sin(angle));
            const unsigned int expected =
              (angle < M_PI / 2.) + (opening - angle < M_PI / 2.);
            const auto t = touches(mesh, c, 0.1001);
            ASSERT_EQ(t.size(), expected) << opening << ' ' << angle;
            n_double += t.size() == 2;
            for (const auto &touch : t)
              EXPECT_NEAR(
                std::min(std::abs(touch.distance - 0.1 * std::sin(angle)),
                         std::abs(touch.distance - 0.1 * std::sin(opening - angle))),
                0.,
                1e-15);
          }
        EXPECT_GT(n_double, 0u);
      }
  }

  // Across the joints of a plate that lies askew, and over the common corner of
  // a fan of triangles: one contact with one name, same distance and normal.
  // As they do where a mesh program computes a corner anew for each triangle.
  TEST(SurfaceMesh, CornersMayDifferByRounding)
  {
    auto triangles = plate(Point<3>(0.3, -0.2, 0.1),
                           Tensor<1, 3>({0.1, 0., 0.}),
                           Tensor<1, 3>({0., 0.1, 0.}),
                           4);
    for (unsigned int t = 0; t < triangles.size(); ++t)
      for (auto &corner : triangles[t])
        for (unsigned int d = 0; d < 3; ++d)
          corner[d] *= 1. + 2e-16 * (t % 3);
    EXPECT_EQ(SurfaceMesh(triangles).n_facets(), 1u);
  }

  TEST(SurfaceMesh, FlatJointsAreNotFelt)
  {
    const Tensor<1, 3> a({0.6, 0.8, 0.}), b({-0.64, 0.48, 0.6});
    const auto         normal = dealii::cross_product_3d(a, b);
    const Point<3>     origin(0.3, -0.2, 0.1);
    Triangles          fan;
    for (int k = 0; k < 7; ++k)
      {
        const auto rim = [&](const double angle) {
          return origin + std::cos(angle) * a + std::sin(angle) * b;
        };
        fan.push_back(
          {{origin, rim(k * 2. * M_PI / 7.), rim((k + 1) % 7 * 2. * M_PI / 7.)}});
      }

    double worst = 0.;
    for (const auto &triangles : {plate(origin - (a + b), 2. * a, 2. * b, 4), fan})
      {
        const SurfaceMesh mesh(triangles);
        ASSERT_EQ(mesh.n_facets(), 1u);
        for (int line = 0; line <= 20; ++line)
          for (int step = -50; step <= 50; ++step)
            {
              // The middle lines go along a joint and over the common corner.
              const double s = 0.01 * step, direction = line * M_PI / 20.;
              const auto   c = origin + s * std::cos(direction) * a +
                             s * std::sin(direction) * b + 0.05 * normal;
              const auto t = touches(mesh, c, 0.06);
              ASSERT_EQ(t.size(), 1u) << line << ' ' << step;
              ASSERT_EQ(t[0].facet, 0u);
              worst = std::max(
                {worst, std::abs(t[0].distance - 0.05), (t[0].normal + normal).norm()});
            }
      }
    std::cout << "distance and normal off by " << worst << ", limit 1e-14" << std::endl;
    EXPECT_LE(worst, 1e-14);
  }

  // A sphere in the square hole of a thick plate, smaller than the sphere: it
  // rests on four edges, all of which border on the top facet.
  TEST(SurfaceMesh, HoleHoldsASphere)
  {
    Triangles triangles;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (i != 1 || j != 1)
          add_rectangle(triangles, Point<3>(i, j, 0.), x, y);
    add_rectangle(triangles, Point<3>(1., 1., 0.), x, -2. * z);
    add_rectangle(triangles, Point<3>(1., 2., 0.), x, -2. * z);
    add_rectangle(triangles, Point<3>(1., 1., 0.), y, -2. * z);
    add_rectangle(triangles, Point<3>(2., 1., 0.), y, -2. * z);
    const SurfaceMesh mesh(triangles);
    ASSERT_EQ(mesh.n_facets(), 5u);
    const auto t = touches(mesh, Point<3>(1.51, 1.5, 0.4), 0.7);
    ASSERT_EQ(t.size(), 4u);
    std::vector<unsigned int> names;
    for (const auto &touch : t)
      {
        EXPECT_EQ(touch.point[2], 0.);
        names.push_back(touch.facet);
      }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, std::vector<unsigned int>({0, 1, 2, 3}));

    // In a sheet without thickness the four edges have one name only: the
    // nearest is kept, as promised.
    triangles.resize(16);
    const auto one = touches(SurfaceMesh(triangles), Point<3>(1.51, 1.5, 0.4), 0.7);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].point, Point<3>(2., 1.5, 0.));
  }

  // A tube of n flat strips inscribed in a circle: seen from inside, its wall is
  // nearer than the circle by at most the sagitta R (1 - cos(pi / n)).
  TEST(SurfaceMesh, TubeWithinItsTessellationError)
  {
    const double radius = 0.0125;
    for (const unsigned int n : {16, 64, 256})
      {
        Triangles  triangles;
        const auto rim = [&](const unsigned int k) {
          const double angle = 2. * M_PI * (k % n) / n;
          return Point<3>(radius * std::cos(angle), radius * std::sin(angle), 0.);
        };
        for (unsigned int k = 0; k < n; ++k)
          add_rectangle(triangles, rim(k), rim(k + 1) - rim(k), 0.1 * z);
        const SurfaceMesh mesh(triangles);
        EXPECT_EQ(mesh.n_facets(), n);

        const double sagitta = radius * (1. - std::cos(M_PI / n));
        double       most    = 0.;
        for (double angle = 0.; angle < 6.28; angle += 0.01)
          {
            const auto t = touches(mesh,
                                   Point<3>(0.9 * radius * std::cos(angle),
                                            0.9 * radius * std::sin(angle),
                                            0.05),
                                   0.1 * radius);
            ASSERT_GE(t.size(), 1u);
            ASSERT_LE(t.size(), 2u);
            const double least =
              t.size() == 1 ? t[0].distance : std::min(t[0].distance, t[1].distance);
            ASSERT_LE(least, 0.1 * radius + 1e-16);
            most = std::max(most, 0.1 * radius - least);
          }
        std::cout << n << " strips: nearer by up to " << most << " m, limit " << sagitta
                  << " m" << std::endl;
        EXPECT_LE(most, sagitta * (1. + 1e-10));
        EXPECT_GT(most, 0.9 * sagitta);
      }
  }

  // Hills and valleys with an edge at every joint.
  Triangles
  rough_surface(const unsigned int n)
  {
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> height(-0.4 / n, 0.4 / n);
    std::vector<double>                    heights((n + 1) * (n + 1));
    for (double &h : heights)
      h = height(random);
    auto triangles = plate(Point<3>(), x, y, n);
    for (auto &t : triangles)
      for (auto &corner : t)
        corner[2] =
          heights[std::lround(corner[0] * n) * (n + 1) + std::lround(corner[1] * n)];
    return triangles;
  }

  // The nearest contact is the nearest point of all triangles, no less and no
  // more; near() agrees; places lie on the surface, names are never repeated.
  TEST(SurfaceMesh, NearestOfAllByBruteForce)
  {
    const auto                             triangles = rough_surface(20);
    const SurfaceMesh                      mesh(triangles);
    const double                           reach = 0.06;
    std::mt19937                           random(4);
    std::uniform_real_distribution<double> place(-0.1, 1.1), height(-0.1, 0.1);
    double                                 worst      = 0.;
    unsigned int                           n_touching = 0, most = 0;
    for (unsigned int k = 0; k < 3000; ++k)
      {
        const Point<3> c(place(random), place(random), height(random));
        const double   expected = distance_by_brute_force(triangles, c);
        const auto     t        = touches(mesh, c, reach);
        ASSERT_EQ(!t.empty(), expected < reach);
        ASSERT_EQ(mesh.near(c, reach), expected < reach);
        if (t.empty())
          continue;
        ++n_touching;
        most         = std::max<unsigned int>(most, t.size());
        double least = reach;
        for (const auto &touch : t)
          {
            least = std::min(least, touch.distance);
            ASSERT_LE(distance_by_brute_force(triangles, touch.point), 1e-15);
            ASSERT_NEAR(
              (c + touch.distance * touch.normal).distance(touch.point), 0., 1e-15);
            ASSERT_EQ(std::count_if(
                        t.begin(),
                        t.end(),
                        [&](const auto &other) { return other.facet == touch.facet; }),
                      1);
          }
        worst = std::max(worst, std::abs(least - expected));
      }
    std::cout << n_touching << " places, up to " << most
              << " contacts, nearest distance off by " << worst << " m, limit 1e-15"
              << std::endl;
    EXPECT_LE(worst, 1e-15);
    EXPECT_GT(n_touching, 1000u);
    EXPECT_GT(most, 3u);
  }

  // The contacts are the local minima of the distance: with the surface sampled
  // around each place, no sample is nearer to the center.
  TEST(SurfaceMesh, ContactsAreLocalMinima)
  {
    const auto                             triangles = rough_surface(20);
    const SurfaceMesh                      mesh(triangles);
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> place(0.1, 0.9), height(0.02, 0.08);
    std::normal_distribution<double>       offset(0., 1.);
    unsigned int                           n_samples = 0;
    double                                 worst     = 0.;
    for (unsigned int k = 0; k < 1000; ++k)
      {
        const Point<3> c(place(random), place(random), height(random));
        for (const auto &touch : touches(mesh, c, 0.1))
          for (unsigned int sample = 0; sample < 50; ++sample)
            {
              // From near the place straight to the surface, by the library's own
              // nearest point, which the test above has verified.
              const double distance = 1e-6;
              const auto   beside =
                touch.point +
                distance * Tensor<1, 3>({offset(random), offset(random), offset(random)});
              const auto on = touches(mesh, beside, 1e-5);
              ASSERT_FALSE(on.empty());
              worst = std::max(worst, touch.distance - c.distance(on[0].point));
              ++n_samples;
            }
      }
    std::cout << n_samples << " samples at 1e-6 m, nearer by up to " << worst
              << " m, limit 1e-14" << std::endl;
    EXPECT_LE(worst, 1e-14);
    EXPECT_GT(n_samples, 50000u);
  }

  class StlFile : public testing::Test
  {
  protected:
    // One a process: the ranks run the same test at the same time.
    StlFile()
      : name(std::filesystem::temp_directory_path() /
             ("graupel-" + std::to_string(getpid()) + ".stl"))
    {
    }

    ~StlFile() override
    {
      std::filesystem::remove(name);
    }

    void
    write_text(const Triangles &triangles) const
    {
      std::ofstream out(name);
      out << "solid part\n";
      for (const auto &t : triangles)
        {
          out << "facet normal 0 0 0\n outer loop\n";
          for (const auto &corner : t)
            out << "  vertex " << corner << '\n';
          out << " endloop\nendfacet\n";
        }
      out << "endsolid part\n";
    }

    // The header begins with the word of the text format, as some programs' do.
    void
    write_binary(const Triangles &triangles) const
    {
      std::ofstream out(name, std::ios::binary);
      const auto    put = [&](const auto value) {
        out.write(reinterpret_cast<const char *>(&value), sizeof(value));
      };
      out << std::string("solid part") + std::string(70, ' ');
      put(static_cast<std::uint32_t>(triangles.size()));
      for (const auto &t : triangles)
        {
          for (unsigned int d = 0; d < 3; ++d)
            put(0.f);
          for (const auto &corner : t)
            for (unsigned int d = 0; d < 3; ++d)
              put(static_cast<float>(corner[d]));
          put(static_cast<std::uint16_t>(0));
        }
    }

    void
    write(const std::string &content) const
    {
      std::ofstream(name) << content;
    }

    // The message with which the file is refused.
    std::string
    refusal(const double scale = 1.) const
    {
      try
        {
          SurfaceMesh::read_stl(name, scale);
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "";
    }

    void
    expect_refusal(const std::string &part, const double scale = 1.) const
    {
      const std::string message = refusal(scale);
      EXPECT_NE(message.find(name), std::string::npos) << message;
      EXPECT_NE(message.find(part), std::string::npos) << message;
    }

    const std::string name;
  };

  // What was written is read, times the scale: a box of 25 mm. Its corners are
  // exact in single precision and in text.
  TEST_F(StlFile, RoundTripInBothFormats)
  {
    auto box = unit_box(4);
    for (auto &t : box)
      for (auto &corner : t)
        corner *= 25.;
    for (const bool binary : {false, true})
      {
        binary ? write_binary(box) : write_text(box);
        const auto mesh = SurfaceMesh::read_stl(name, 1e-3);
        EXPECT_EQ(mesh.n_triangles(), 6u * 32u);
        EXPECT_EQ(mesh.n_facets(), 6u);
        EXPECT_EQ(mesh.n_free_edges(), 0u);
        EXPECT_NEAR(mesh.bounding_box().get_boundary_points().second.distance(
                      Point<3>(0.025, 0.025, 0.025)),
                    0.,
                    1e-17);
        const auto t = touches(mesh, Point<3>(0.001, 0.0107, 0.0103), 0.002);
        ASSERT_EQ(t.size(), 1u);
        EXPECT_NEAR(t[0].distance, 0.001, 1e-17);
      }
  }

  // Rounding of the file makes no edges: a plate askew is one facet, with one
  // contact everywhere; its place is off by what the rounding moves corners.
  TEST_F(StlFile, FlatInSinglePrecisionAndSixDigits)
  {
    const Tensor<1, 3> a({std::cos(1.), std::sin(1.), 0.});
    const Tensor<1, 3> b(
      {-std::sin(1.) * std::cos(0.7), std::cos(1.) * std::cos(0.7), std::sin(0.7)});
    const auto     normal = dealii::cross_product_3d(a, b);
    const Point<3> origin(1.3, -0.2, 0.1);
    const auto     triangles = plate(origin, a, b, 50);
    for (const bool binary : {true, false})
      {
        binary ? write_binary(triangles) : write_text(triangles);
        const auto mesh = SurfaceMesh::read_stl(name, 1.);
        EXPECT_EQ(mesh.n_facets(), 1u);
        EXPECT_EQ(mesh.n_free_edges(), 200u);
        std::mt19937                           random(6);
        std::uniform_real_distribution<double> place(0., 1.);
        double                                 worst = 0.;
        for (unsigned int k = 0; k < 5000; ++k)
          {
            const auto c = origin + place(random) * a + place(random) * b + 0.02 * normal;
            const auto t = touches(mesh, c, 0.021);
            ASSERT_EQ(t.size(), 1u);
            worst = std::max(worst, std::abs(t[0].distance - 0.02));
          }
        // Half a unit in the last digit of 1.0 to 1.9, in three coordinates.
        const double limit = std::sqrt(3.) * (binary ? std::pow(2., -24.) : 5e-6);
        std::cout << (binary ? "single precision" : "six digits")
                  << ": distance off by up to " << worst << " m, limit " << limit << " m"
                  << std::endl;
        EXPECT_LE(worst, limit);
        EXPECT_GT(worst, 0.1 * limit);
      }
  }

  // Nor does it count contacts twice at the edges of a box askew: one from
  // outside, one a face within reach from inside.
  TEST_F(StlFile, RoundedBoxHasNoDoubleContacts)
  {
    const Tensor<1, 3> a({std::cos(1.), std::sin(1.), 0.});
    const Tensor<1, 3> b(
      {-std::sin(1.) * std::cos(0.7), std::cos(1.) * std::cos(0.7), std::sin(0.7)});
    const auto c      = dealii::cross_product_3d(a, b);
    const auto turned = [&](const Point<3> &p) {
      return Point<3>(p[0] * a + p[1] * b + p[2] * c);
    };
    auto triangles = unit_box(20);
    for (auto &t : triangles)
      for (auto &corner : t)
        corner = turned(corner);
    write_binary(triangles);
    const auto mesh = SurfaceMesh::read_stl(name, 1.);
    EXPECT_EQ(mesh.n_facets(), 6u);
    EXPECT_EQ(mesh.n_free_edges(), 0u);

    std::mt19937                           random(7);
    std::uniform_real_distribution<double> place(-0.1, 1.1), aside(-1e-6, 1e-6);
    const double                           reach    = 0.2;
    unsigned int                           n_inside = 0;
    for (unsigned int k = 0; k < 20000; ++k)
      {
        // Half of them right above the joints and edges, to within the rounding.
        Point<3> p(place(random), place(random), place(random));
        if (k % 2)
          for (unsigned int d = 0; d < 3; ++d)
            p[d] = 0.05 * std::round(20. * p[d]) + aside(random);
        unsigned int n_outside = 0, n_faces = 0;
        bool         in_doubt = false;
        for (unsigned int d = 0; d < 3; ++d)
          for (const double distance : {p[d], 1. - p[d]})
            {
              n_outside += distance < -1e-5;
              n_faces += distance < reach;
              in_doubt = in_doubt || std::abs(distance) < 1e-3 ||
                         std::abs(distance - reach) < 1e-5;
            }
        if (n_outside == 0 && in_doubt)
          continue;
        n_inside += n_outside == 0;
        ASSERT_EQ(touches(mesh, turned(p), reach).size(), n_outside > 0 ? 1 : n_faces)
          << p;
      }
    std::cout << n_inside << " of 20000 places inside" << std::endl;
    EXPECT_GT(n_inside, 5000u);
  }

  TEST_F(StlFile, BadFilesAreRefused)
  {
    const double                  nan  = std::numeric_limits<double>::quiet_NaN();
    const std::array<Point<3>, 3> good = {{Point<3>(), Point<3>(x), Point<3>(y)}};

    expect_refusal("cannot be opened");
    write("");
    expect_refusal("no triangles");
    write("no solid at all, but a letter of some length to someone who may care");
    expect_refusal("");
    write_text({});
    expect_refusal("no triangles");
    write_text({good, good});
    std::filesystem::resize_file(name, 190);
    expect_refusal("not a whole STL file");
    write_text({good, {{Point<3>(), Point<3>(0., nan, 0.), Point<3>(y)}}});
    expect_refusal("not a number");
    // A NaN where another corner has the same other coordinates.
    write_binary({good, {{Point<3>(0., nan, 0.), Point<3>(x + y), Point<3>(y)}}});
    expect_refusal("triangle 2 ");
    expect_refusal("not a finite number");
    write_binary({good, good, {{Point<3>(), Point<3>(x), Point<3>(2. * x)}}});
    expect_refusal("triangle 3 ");
    expect_refusal("no area");
    write_binary({good, {{Point<3>(), Point<3>(x), Point<3>()}}});
    expect_refusal("no area");
    write_binary({good, good});
    std::filesystem::resize_file(name, 84 + 70);
    expect_refusal("not a whole STL file");
    write_binary({good});
    EXPECT_EQ(refusal(), "");
    for (const double scale : {0., -1., nan, 1. / 0.})
      expect_refusal("scale", scale);
  }
} // namespace
