// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

#include <graupel/base/parameters.h>
#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/particles/dem_error.h>
#include <graupel/dem/particles/particle_list.h>

#include <fstream>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using Vector = dealii::Tensor<1, 3>;

  struct Random
  {
    std::mt19937_64 generator{5};

    double
    operator()()
    {
      return static_cast<double>(generator() >> 11) * 0x1p-53;
    }
  };

  struct Moments
  {
    double mean, deviation;
  };

  // Mean and deviation of the diameter by mass, of many drawn by number.
  Moments
  moments_by_mass(const SizeDistribution &sizes, const double diameter)
  {
    Random random;
    double mass = 0., first = 0., second = 0.;
    for (unsigned int k = 0; k < 10000; ++k)
      {
        const double d = sizes.draw(diameter, random), m = d * d * d;
        mass += m;
        first += m * d;
        second += m * d * d;
      }
    first /= mass;
    return {first, std::sqrt(second / mass - first * first)};
  }

  // Law: a distribution by mass has these moments when weighed by mass. Limit 2 %:
  // four standard errors of 10,000 draws are 1 %; drawn by number and not by
  // mass, the means would be off by 10 % and more.
  TEST(SizeDistribution, MomentsByMass)
  {
    SizeDistribution uniform;
    uniform.kind     = "uniform";
    uniform.smallest = 1e-3;
    uniform.largest  = 2e-3;
    SizeDistribution normal;
    normal.kind      = "normal";
    normal.deviation = 0.3e-3;
    SizeDistribution logarithmic;
    logarithmic.kind      = "log-normal";
    logarithmic.deviation = 0.25;
    logarithmic.smallest  = 0.2e-3;
    logarithmic.largest   = 1e-2;
    SizeDistribution list;
    list.kind = "list";
    list.list = "1e-3: 1, 2e-3: 3";

    // The normal one is cut at three deviations: 0.9733 of the variance is left.
    const double median = 1.6e-3, mean = median * std::exp(0.5 * 0.0625);
    const std::vector<std::tuple<const char *, SizeDistribution, double, double>> cases{
      {"uniform", uniform, 1.5e-3, 1e-3 / std::sqrt(12.)},
      {"normal", normal, 1.6e-3, 0.3e-3 * std::sqrt(0.9733)},
      {"log-normal", logarithmic, mean, mean * std::sqrt(std::exp(0.0625) - 1.)},
      {"list", list, 1.75e-3, 1e-3 * std::sqrt(0.1875)}};
    for (const auto &[name, sizes, expected_mean, expected_deviation] : cases)
      {
        sizes.check(median, "Particles");
        const auto measured = moments_by_mass(sizes, median);
        std::cout << name << ": mean " << measured.mean << " m, expected "
                  << expected_mean << "; deviation " << measured.deviation << ", "
                  << expected_deviation << std::endl;
        EXPECT_NEAR(measured.mean, expected_mean, 0.02 * expected_mean);
        EXPECT_NEAR(measured.deviation, expected_deviation, 0.04 * expected_deviation);
      }
  }

  TEST(SizeDistribution, WhatCannotBe)
  {
    SizeDistribution sizes;
    sizes.kind = "normal";
    EXPECT_THROW(sizes.check(1e-3, "Particles"), InputError);
    sizes.deviation = 0.4e-3;
    EXPECT_THROW(sizes.check(1e-3, "Particles"), InputError);
    sizes.deviation = 0.1e-3;
    EXPECT_NO_THROW(sizes.check(1e-3, "Particles"));
    sizes.kind = "list";
    EXPECT_THROW(sizes.check(1e-3, "Particles"), InputError);
    sizes.list = "1e-3";
    EXPECT_THROW(sizes.check(1e-3, "Particles"), InputError);
  }

  // Two types by mass, with sizes: the shares of the mass are met, and all settle.
  TEST(Insertion, TypesByMassFraction)
  {
    DemParameters p            = SmallColumn::parameters();
    p.particles.diameter       = 1e-3;
    p.particles.sizes.kind     = "uniform";
    p.particles.sizes.smallest = 0.8e-3;
    p.particles.sizes.largest  = 1.2e-3;
    auto &second               = p.particles.further_types[0];
    second.mass_fraction       = 0.6;
    second.diameter            = 1.4e-3;
    second.density             = 5000.;
    second.elasticity          = {2e7, 0.25};
    p.contact.pairs            = "1-2 friction 0.2, 2-bottom restitution 0.3";
    p.check(SmallColumn::vessel());

    SmallColumn       column(p);
    FillingParameters filling;
    filling.method     = "volume";
    filling.bed_height = 0.;
    filling.count      = 400;
    filling.upper      = 0.028;
    filling.check(SmallColumn::vessel(), p);
    Filling phase(filling, column.dem);
    while (phase.step())
      {
      }
    EXPECT_EQ(column.dem.n_global(), 400u);
    double      of_second = 0.;
    const auto &rows      = column.dem.particles();
    for (unsigned int i = 0; i < rows.n_owned; ++i)
      {
        if (rows.type[i] == 1)
          of_second += rows.mass[i];
        const double d = 2. * rows.body[i].radius;
        EXPECT_TRUE(rows.type[i] == 1 ? d == 1.4e-3 : d >= 0.8e-3 && d <= 1.2e-3);
        EXPECT_NEAR(rows.mass[i],
                    (rows.type[i] == 1 ? 5000. : 2700.) * sphere_volume(d / 2.),
                    1e-12 * rows.mass[i]);
      }
    of_second = dealii::Utilities::MPI::sum(of_second, MPI_COMM_WORLD);
    // 400 draws: a standard error of 0.03.
    EXPECT_NEAR(of_second / column.dem.solid_mass(), 0.6, 0.1);
    column.dem.advance(0.15);
    column.dem.advance(0.01);
    EXPECT_EQ(column.dem.n_global(), 400u);
    EXPECT_NEAR(column.dem.bottom_force() + column.dem.wall_force(),
                column.dem.weight(),
                0.05 * column.dem.weight());
  }

  // Pairs have the materials that the prm says: an impact on the bottom returns the
  // overriding restitution of the second type. Limit: time error of the impact.
  TEST(Insertion, PairsOverride)
  {
    DemParameters p                            = SmallColumn::parameters();
    p.particles.gravity                        = 0.;
    p.contact.time_fraction                    = 0.05;
    p.particles.further_types[0].mass_fraction = 0.5;
    p.particles.further_types[0].diameter      = 2e-3;
    p.contact.pairs                            = "2-bottom restitution 0.9";
    SmallColumn column(p);
    column.dem.insert(
      {NewParticle{Point<3>(-2e-3, 0., 2e-3), 1e-3, Vector({0., 0., -0.3}), {}, 0},
       NewParticle{Point<3>(2e-3, 0., 2e-3), 1e-3, Vector({0., 0., -0.3}), {}, 1}});
    column.dem.advance(8e-3);
    EXPECT_NEAR(column.velocity(0)[2], 0.15, 0.003);
    EXPECT_NEAR(column.velocity(1)[2], 0.27, 0.003);
    p.contact.pairs = "1-7 friction 0.3";
    EXPECT_THROW(p.check(SmallColumn::vessel()), InputError);
    p.contact.pairs = "1-2 fiction 0.3";
    EXPECT_THROW(p.check(SmallColumn::vessel()), InputError);
  }

  // Law: d32 = sum n d^3 / sum n d^2 over the original particles, of which a simulated
  // one of scale s stands for s^3. Here 8 of 1 mm and 27 of 2 mm, simulated by one each.
  TEST(Insertion, SauterMeanOfTheOriginalParticles)
  {
    DemParameters p;
    p.particles.diameter                       = 1e-3;
    p.particles.scale                          = 2.;
    p.particles.further_types[0].mass_fraction = 0.5;
    p.particles.further_types[0].diameter      = 2e-3;
    p.particles.further_types[0].scale         = 3.;
    SmallColumn column(p);
    column.dem.insert({NewParticle{Point<3>(-3e-3, 0., 6e-3), 1e-3, Vector(), {}, 0},
                       NewParticle{Point<3>(1.5e-3, 0., 6e-3), 3e-3, Vector(), {}, 1}});
    EXPECT_NEAR(column.dem.original_sauter_diameter(),
                (8. * 1. + 27. * 8.) / (8. * 1. + 27. * 4.) * 1e-3,
                1e-3 * 0x1p-34)
      << "to the quantum of an exact sum";
  }

  // Law (JKR): two spheres stick; a pull of 0.95 of 3/2 pi w R* does not part them, one
  // of 1.05 does.
  TEST(Insertion, AdhesionHoldsUpToThePullOff)
  {
    for (const double pull : {0.95, 1.05})
      {
        DemParameters p                     = SmallColumn::parameters();
        p.particles.gravity                 = 0.;
        p.contact.model                     = "jkr";
        p.contact.particle_surface.adhesion = 0.5;
        SmallColumn column(p);
        column.dem.insert({Point<3>(0., 0., 0.0140), Point<3>(0., 0., 0.015997)});
        const double force = pull * 1.5 * dealii::numbers::PI * 0.5 * 0.5e-3;
        for (unsigned int n = 0; n < 100; ++n)
          {
            // Slowly, so that no swing adds to it.
            for (const int id : {0, 1})
              if (column.row(id) >= 0)
                column.dem.particles().external_force[column.row(id)] =
                  Vector({0., 0., (id == 0 ? -1. : 1.) * force * std::min(1., n / 80.)});
            column.dem.advance(5e-4);
            if (column.dem.coordination_number() == 0.)
              break;
          }
        EXPECT_EQ(column.dem.coordination_number(), pull < 1. ? 1. : 0.) << pull;
      }
  }

  // Fast packing and rain end in the same kind of bed; limits as asked of the large
  // bed, doubled for one of 500 spheres.
  TEST(Insertion, PackingIsLikeRain)
  {
    double void_fraction[2], coordination[2], time[2];
    for (const unsigned int k : {0, 1})
      {
        DemParameters p      = SmallColumn::parameters();
        p.particles.diameter = 1.2e-3;
        SmallColumn       column(p);
        FillingParameters filling;
        filling.method     = k == 0 ? "rain" : "packing";
        filling.count      = 800;
        filling.bed_height = 0.;
        Filling phase(filling, column.dem);
        while (phase.step())
          {
          }
        for (unsigned int n = 0; n < 40; ++n)
          column.dem.advance(5e-3);
        const auto bed = BedObservables(column.dem.particles(),
                                        column.dem.vessel_shape(),
                                        MPI_COMM_WORLD)
                           .bed();
        void_fraction[k] = bed.mean_void_fraction;
        coordination[k]  = column.dem.coordination_number();
        time[k]          = phase.time();
      }
    EXPECT_NEAR(void_fraction[0], void_fraction[1], 0.01);
    EXPECT_NEAR(coordination[0], coordination[1], 0.4);
    EXPECT_LT(time[1], 0.8 * time[0]);
  }

  std::string
  write_list(const std::string &text)
  {
    const std::string name =
      testing::TempDir() + "particles" +
      std::to_string(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) + ".csv";
    std::ofstream(name) << text;
    return name;
  }

  TEST(Insertion, ListFromAFile)
  {
    const auto               file = write_list("# two spheres\n"
                                               "diameter, z, y, x, vz, wy, type\n"
                                               "2e-3, 0.01, 0, 1e-3, -0.5, 7, 1\n\n"
                                               "1e-3, 0.02, 1e-3, 0, 0, 0, 2 # small\n");
    std::vector<NewParticle> read;
    read_particle_list(file, 2, [&](const NewParticle &p) { read.push_back(p); });
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].position, Point<3>(1e-3, 0., 0.01));
    EXPECT_EQ(read[0].radius, 1e-3);
    EXPECT_EQ(read[0].velocity, Vector({0., 0., -0.5}));
    EXPECT_EQ(read[0].spin, Vector({0., 7., 0.}));
    EXPECT_EQ(read[1].type, 1);

    SmallColumn       column(SmallColumn::parameters());
    FillingParameters filling;
    filling.method     = "list";
    filling.file       = write_list("x,y,z,diameter\n0,0,0.01,2e-3\n");
    filling.bed_height = 0.;
    Filling phase(filling, column.dem);
    EXPECT_FALSE(phase.step());
    EXPECT_EQ(column.dem.n_global(), 1u);

    const auto message = [](const std::string &text) {
      try
        {
          read_particle_list(write_list(text), 1, [](const NewParticle &) {});
        }
      catch (const InputError &error)
        {
          return std::string(error.what());
        }
      return std::string();
    };
    EXPECT_NE(message("x,y,z\n0,0,0\n").find("diameter"), std::string::npos);
    EXPECT_NE(message("x,y,z,diameter\n0,0,0,1e-3\n0,0,a,1e-3\n").find("line 3"),
              std::string::npos);
    EXPECT_NE(message("x,y,z,diameter\n0,0,0\n").find("3 values"), std::string::npos);
    EXPECT_NE(message("x,y,z,diameter,type\n0,0,0,1,2\n").find("types go"),
              std::string::npos);
    EXPECT_NE(message("x,y,z,diameter\n").find("no particles"), std::string::npos);
  }

  // A section without room says so, and random places keep their distance.
  TEST(Insertion, VolumeKeepsDistanceOrSaysThatItIsFull)
  {
    SmallColumn       column(SmallColumn::parameters());
    FillingParameters filling;
    filling.method     = "volume";
    filling.bed_height = 0.;
    filling.count      = 60;
    filling.lower      = 0.01;
    filling.upper      = 0.025;
    Filling phase(filling, column.dem);
    EXPECT_FALSE(phase.step());
    EXPECT_EQ(column.dem.coordination_number(), 0.);
    const auto &p = column.dem.particles();
    for (unsigned int i = 0; i < p.n_owned; ++i)
      {
        EXPECT_GE(p.body[i].position[2], 0.011);
        EXPECT_LE(p.body[i].position[2], 0.024);
      }
    column.dem.advance(1e-4);
    EXPECT_EQ(column.dem.coordination_number(), 0.);

    filling.count = 400;
    Filling too_many(filling, column.dem);
    EXPECT_THROW(too_many.step(), DemError);
  }
} // namespace
