// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "shapes.h"

#include <graupel/base/parameters.h>
#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/vessel/mesh_planes.h>

#include <gtest/gtest.h>

#include <random>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using dealii::numbers::PI;

  const std::string duct = GRAUPEL_SOURCE_DIR "/prm/vessels/side-inlet.msh";
  const Cylinder    around_duct{0.022628, 0.06};

  TEST(VesselShape, AFullCylinderIsItsCircleToTheLastBit)
  {
    const Cylinder tube{0.0251, 0.169};
    const Vessel   vessel(tube, vessel_walls(tube));
    EXPECT_EQ(vessel.cross_section(0.03), tube.cross_section());
    EXPECT_EQ(vessel.volume(0.01, 0.04), tube.cross_section() * (0.04 - 0.01));
    EXPECT_EQ(vessel.depth_of(1e-5, 0.6), 1e-5 / (0.6 * tube.cross_section()));
    EXPECT_EQ(vessel.floor(), 0.);
    EXPECT_EQ(vessel.ceiling(), tube.height);
    EXPECT_TRUE(vessel.is_tube());
    EXPECT_EQ(*vessel.hydraulic_diameter(), tube.diameter);
    EXPECT_EQ(vessel.walls(), (std::vector<std::string>{"wall", "bottom", "top"}));
    EXPECT_TRUE(vessel.is_floor(bottom_wall));
    EXPECT_FALSE(vessel.is_floor(lateral_wall));
  }

  // Exact for planes; for the cone of triangles to the strips of its lines.
  TEST(VesselShape, SectionsAndVolumesOfFiveShapes)
  {
    for (const Shape &shape : shapes())
      {
        const Vessel &vessel = shape.vessel;
        double        volume = 0., worst = 0.;
        const double  low = 0.0071, high = 0.0213, step = 1e-5;
        for (double z = low + step / 2.; z < high; z += step)
          {
            volume += step * shape.area(z);
            worst =
              std::max(worst, std::abs(vessel.cross_section(z) / shape.area(z) - 1.));
          }
        const double relative = vessel.volume(low, high) / volume - 1.;
        std::cout << shape.name << ": section off by " << worst << ", volume by "
                  << relative << '\n';
        EXPECT_LT(worst, 2e-5) << shape.name;
        EXPECT_NEAR(relative, 0., 2e-5) << shape.name;
      }
  }

  TEST(VesselShape, FloorAndCeiling)
  {
    const auto all = shapes();
    for (const unsigned int k : {0, 1, 2})
      {
        EXPECT_EQ(all[k].vessel.floor(), 0.);
        EXPECT_EQ(all[k].vessel.ceiling(), 0.06);
        EXPECT_TRUE(all[k].vessel.is_straight());
      }
    EXPECT_EQ(all[3].vessel.floor(), 0.006);
    EXPECT_EQ(all[3].vessel.ceiling(), 0.022);
    EXPECT_NEAR(all[4].vessel.floor(), 0.004, 1e-6);
    EXPECT_EQ(all[4].vessel.ceiling(), 0.04);
    EXPECT_NEAR(*all[1].vessel.hydraulic_diameter(), 0.016, 1e-12);
    EXPECT_NEAR(*all[2].vessel.hydraulic_diameter(), 4. * 440. / 108e3, 1e-12);
    EXPECT_FALSE(all[3].vessel.hydraulic_diameter());
    EXPECT_FALSE(all[4].vessel.hydraulic_diameter());

    // A level plane raises the floor, another one is a lid.
    const Vessel between(Cylinder{0.012, 0.02},
                         {{Point<3>(0., 0., 0.003), dealii::Tensor<1, 3>({0., 0., -1.})},
                          {Point<3>(0., 0., 0.017), dealii::Tensor<1, 3>({0., 0., 1.})}});
    EXPECT_EQ(between.floor(), 0.003);
    EXPECT_EQ(between.ceiling(), 0.017);
    EXPECT_TRUE(between.is_tube());
    EXPECT_EQ(between.volume(0., 0.004),
              (Cylinder{0.012, 0.02}.cross_section() * (0.004 - 0.003)));
    EXPECT_EQ(between.cross_section(0.002), 0.);
  }

  // A disc that oblique planes cut, containers and bodies that meet and overlap, against
  // points thrown at random: five standard deviations.
  TEST(VesselShape, SectionsAgainstRandomPoints)
  {
    const double           radius = 0.01;
    std::vector<HalfSpace> spaces;
    for (const auto &[x, y, z] : {std::array<double, 3>{{0.6, 0.3, -0.2}},
                                  {{-0.2, 0.9, 0.3}},
                                  {{-1., -0.6, 0.1}}})
      {
        const dealii::Tensor<1, 3> n({x, y, z});
        spaces.push_back({Point<3>(0.006 * n / n.norm()), n / n.norm()});
      }
    // A container wider than the disc at the top, two bodies of which one reaches out.
    std::vector<ClosedBody> bodies{{frustum(0.007, 0.001, 0.013, 0.02, 40), true},
                                   {frustum(0.003, 0.002, 0.001, 0.018, 5), false},
                                   {frustum(0.004, 0.004, 0.004, 0.015, 7), false}};
    for (auto &triangle : bodies[2].triangles)
      for (auto &corner : triangle)
        corner += dealii::Tensor<1, 3>({0.004, -0.002, 0.});
    const Vessel vessel(Cylinder{2. * radius, 0.02}, spaces, bodies);

    const auto in_frustum = [](const Point<3> &x,
                               const double    r,
                               const double    z,
                               const double    R,
                               const double    Z,
                               const int       n) {
      if (x[2] < z || x[2] > Z)
        return false;
      const double outer = r + (x[2] - z) / (Z - z) * (R - r);
      for (int k = 0; k < n; ++k)
        {
          const double angle = 2. * PI * (k + 0.5) / n;
          if (x[0] * std::cos(angle) + x[1] * std::sin(angle) > outer * std::cos(PI / n))
            return false;
        }
      return true;
    };
    std::mt19937_64                  generator(3);
    std::uniform_real_distribution<> random(-radius, radius);
    constexpr unsigned int           n_points = 200000;
    for (const double z : {0.0005, 0.0015, 0.003, 0.008, 0.014, 0.019})
      {
        unsigned int hits = 0;
        for (unsigned int n = 0; n < n_points; ++n)
          {
            const Point<3> x(random(generator), random(generator), z);
            bool           inside = std::hypot(x[0], x[1]) < radius;
            for (const HalfSpace &space : spaces)
              inside = inside && (x - space.point) * space.normal < 0.;
            inside = inside && in_frustum(x, 0.007, 0.001, 0.013, 0.02, 40) &&
                     !in_frustum(x, 0.003, 0.002, 0.001, 0.018, 5) &&
                     !in_frustum(x - dealii::Tensor<1, 3>({0.004, -0.002, 0.}),
                                 0.004,
                                 0.004,
                                 0.004,
                                 0.015,
                                 7);
            hits += inside;
          }
        const double square = 4. * radius * radius, part = hits / double(n_points);
        const double deviation = std::sqrt(part * (1. - part) / n_points) * square;
        const double area      = section_area(radius, spaces, bodies, z);
        std::cout << "z = " << z << ": " << area << ", random points " << part * square
                  << " +- " << deviation << '\n';
        EXPECT_NEAR(area, part * square, 5. * deviation) << z;
        EXPECT_NEAR(vessel.cross_section(z), area, 1e-3 * area) << z;
        // Without the bodies the same by both ways.
        EXPECT_NEAR(section_area(radius, spaces, {}, z),
                    disc_section(radius, spaces, z).area,
                    2e-6 * square);
      }
  }

  // Points of a shape, one at random in each cube of a grid.
  struct Count
  {
    // Between bottom and top of the bed [m^3].
    double space = 0.;
    // Between two heights, all and those in spheres.
    double points = 0., in_spheres = 0.;
  };

  // Of the spheres of lattice_in().
  Count
  count_points(const Shape               &shape,
               const double               d,
               const double               lowest,
               const BedObservables::Bed &bed,
               const double               low,
               const double               high)
  {
    std::mt19937_64                  generator(7);
    std::uniform_real_distribution<> random(0., 1.);
    const double                     half = shape.vessel.cylinder().diameter / 2.;
    const double                     h    = bed.height / std::round(bed.height / 1.5e-4);
    Count                            count;
    for (double z = bed.bottom; z < bed.top - h / 2.; z += h)
      for (double y = -half; y < half; y += h)
        for (double x = -half; x < half; x += h)
          {
            const Point<3> p(x + h * random(generator),
                             y + h * random(generator),
                             z + h * random(generator));
            if (!shape.is_inside(p, 0.))
              continue;
            count.space += h * h * h;
            if (p[2] < low || p[2] > high)
              continue;
            const Point<3> center(d * std::round(p[0] / d),
                                  d * std::round(p[1] / d),
                                  lowest + d * (std::floor((p[2] - lowest) / d) + 0.5));
            count.points += 1.;
            count.in_spheres += center.distance(p) < d / 2. &&
                                shape.is_inside(center, d / 2. * (1. - 1e-9));
          }
    return count;
  }

  // What a bed in it says against counting points: 1e-3; and its own definition, of all
  // solid over the space from bottom to top. The expanded height is the height to 0.1 d,
  // but for the tip of the pyramid, where spheres are few. The same bits on any number
  // of ranks.
  TEST(VesselShape, VoidFractionsAgainstADirectCount)
  {
    const double d = 1.6e-3;
    for (const Shape &shape : shapes())
      {
        const double         lowest = shape.vessel.floor(), upper = lowest + 0.0155;
        const auto           mine = lattice_in(shape, d, lowest, upper, true);
        const auto           all  = lattice_in(shape, d, lowest, upper, false);
        const BedObservables observables(mine, shape.vessel, MPI_COMM_WORLD);
        const auto           bed = observables.bed();
        const auto alone         = BedObservables(all, shape.vessel, MPI_COMM_SELF).bed();
        EXPECT_TRUE(bed.exists) << shape.name;
        EXPECT_EQ(bed.height, alone.height);
        EXPECT_EQ(bed.expanded_height, alone.expanded_height);
        EXPECT_EQ(bed.mean_void_fraction, alone.mean_void_fraction);

        const double low = lowest + 0.0051, high = lowest + 0.0121;
        const Count  count   = count_points(shape, d, lowest, bed, low, high);
        const double counted = 1. - count.in_spheres / count.points;
        const double found   = 1. - observables.solid_fractions({low, high})[0];
        const double mean =
          1. -
          observables.solid_volume_between(bed.bottom - d, bed.top + d) / count.space;
        std::cout << shape.name << ": " << all.n_owned << " spheres, void fraction "
                  << found << ", counted " << counted << "; bed of " << bed.height
                  << " m (" << bed.expanded_height << "), " << bed.mean_void_fraction
                  << ", counted " << mean << '\n';
        EXPECT_NEAR(found, counted, 1e-3) << shape.name;
        EXPECT_NEAR(bed.mean_void_fraction, mean, 1e-3) << shape.name;
        if (shape.name != "pyramid")
          {
            EXPECT_NEAR(bed.expanded_height, bed.height, 0.1 * d) << shape.name;
          }
      }
  }

  TEST(VesselShape, FollowsItsWalls)
  {
    const Cylinder tube{0.012, 0.02};
    auto           walls = vessel_walls(tube);
    Vessel         vessel(tube, walls);
    Wall           piston;
    piston.name  = "piston";
    piston.shape = PlaneWall{{0., 0., 0.004}, {0., 0., -1.}};
    walls.push_back(piston);
    vessel.follow(walls);
    EXPECT_EQ(vessel.floor(), 0.004);
    EXPECT_TRUE(vessel.is_floor(3));
    std::get<PlaneWall>(walls[3].shape).point.z = 0.005;
    vessel.follow(walls);
    EXPECT_EQ(vessel.floor(), 0.005);
    walls[3].shape = NoWall{};
    vessel.follow(walls);
    EXPECT_EQ(vessel.floor(), 0.);
    EXPECT_EQ(vessel.cross_section(0.001), tube.cross_section());
  }

  TEST(VesselShape, FluidAndParticlesAreCompared)
  {
    const VesselMesh mesh(around_duct, {4e-3, 0., duct}, MPI_COMM_WORLD);
    const Vessel     without(mesh, vessel_walls(around_duct));
    EXPECT_EQ(without.fluid_boundaries(),
              (std::vector<std::string>{"bottom", "side", "top", "wall"}));
    EXPECT_NEAR(without.fluid_cross_section(0.03), 256e-6, 1e-12);
    const std::string warning = without.difference();
    EXPECT_NE(warning.find("256 mm2"), std::string::npos) << warning;
    EXPECT_NE(warning.find("402.1 mm2"), std::string::npos) << warning;
    EXPECT_NE(warning.find("Walls/from mesh"), std::string::npos) << warning;
    EXPECT_EQ(Vessel(mesh, all_walls({}, mesh)).difference(), warning);

    WallParameters from_mesh;
    from_mesh.from_mesh = true;
    const auto   walls  = all_walls(from_mesh, mesh);
    const Vessel with(mesh, walls);
    EXPECT_EQ(with.difference(), "");
    EXPECT_NEAR(with.cross_section(0.03), 256e-6, 1e-12);
    EXPECT_NEAR(*with.hydraulic_diameter(), 0.016, 1e-10);
    // The side with the inlet has more of the boundary "wall" than of "side".
    EXPECT_EQ(with.walls(),
              (std::vector<std::string>{
                "wall", "bottom", "top", "wall 1", "wall 2", "wall 3", "wall 4"}));

    // A plane too many takes space from the particles.
    auto narrow     = walls;
    narrow[3].shape = PlaneWall{{0., 0., 0.}, {1., 0., 0.}};
    EXPECT_NE(Vessel(mesh, narrow).difference().find("no particle can be"),
              std::string::npos);

    from_mesh.from_mesh = true;
    const VesselMesh tube(around_duct, {4e-3, 0., ""}, MPI_COMM_WORLD);
    EXPECT_THROW(all_walls(from_mesh, tube), InputError);
    EXPECT_EQ(Vessel(tube, vessel_walls(around_duct)).difference(), "");
  }
} // namespace
