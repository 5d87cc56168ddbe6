// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include "small_column.h"

#include <graupel/base/parameter_entries.h>
#include <graupel/base/parameters.h>
#include <graupel/dem/bed/bed_observables.h>
#include <graupel/dem/packing/filling.h>
#include <graupel/dem/packing/settling.h>
#include <graupel/dem/particles/dem_error.h>

namespace
{
  using namespace graupel;
  using dealii::Point;
  using dealii::numbers::PI;

  // Spheres on a simple cubic lattice of their diameter, shared out among the
  // ranks, in a cylinder of the cross-section that the lattice has.
  class Lattice : public testing::Test
  {
  protected:
    Lattice()
    {
      cylinder.diameter        = std::sqrt(4. / PI * n * n) * d;
      cylinder.height          = 60. * d;
      const unsigned int me    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      for (unsigned int k = 0; k < n * n * layers; ++k)
        if (k % ranks == me)
          add(Point<3>((k % n) * d, (k / n % n) * d, (k / (n * n) + 0.5) * d));
    }

    void
    add(const Point<3> &x)
    {
      particles.resize(++particles.n_owned);
      particles.body.back().radius   = d / 2.;
      particles.body.back().position = x;
    }

    static constexpr unsigned int n = 5, layers = 40;
    static constexpr double       d = 2e-3;
    ParticleArrays                particles;
    Cylinder                      cylinder;
  };

  // Spherical segments: half, whole, nothing, and a quarter of the height
  // (5/32 of the volume), by hand. Rounding.
  TEST(BedObservables, SphereBelowAPlane)
  {
    const double V = sphere_volume(2.);
    EXPECT_NEAR(V, 32. / 3. * PI, 1e-13 * V);
    EXPECT_NEAR(sphere_volume_below(2., 2.), V / 2., 1e-13 * V);
    EXPECT_NEAR(sphere_volume_below(2., 1.), V * 5. / 32., 1e-13 * V);
    EXPECT_EQ(sphere_volume_below(2., -1.), 0.);
    EXPECT_NEAR(sphere_volume_below(2., 5.), V, 1e-13 * V);
  }

  // A cubic lattice has solid fraction pi/6 in every slab of one diameter, so
  // it falls to half of that where the slab is half out: at the lattice's top.
  // Limits: the quanta of the sums, the bisection.
  TEST_F(Lattice, HeightAndVoidFraction)
  {
    const Vessel         vessel(cylinder);
    const BedObservables observables(particles, vessel, MPI_COMM_WORLD);
    const auto           bed = observables.bed();
    EXPECT_NEAR(bed.bulk_solid_fraction, PI / 6., 1e-7);
    EXPECT_NEAR(bed.height, layers * d, 1e-6 * d);
    EXPECT_NEAR(bed.mean_void_fraction, 1. - PI / 6., 1e-7);
    EXPECT_NEAR(observables.solid_volume_between(0., 10.5 * d),
                10.5 * n * n * sphere_volume(d / 2.),
                1e-9 * cylinder.cross_section() * d);
    const auto fractions = observables.solid_fractions({0., d, 3. * d, 50. * d, 55. * d});
    EXPECT_NEAR(fractions[0], PI / 6., 1e-9);
    EXPECT_NEAR(fractions[1], PI / 6., 1e-9);
    EXPECT_EQ(fractions[3], 0.);
  }

  // Spheres that fall from above are not the bed.
  TEST_F(Lattice, FallingParticlesDoNotCount)
  {
    const auto resting =
      BedObservables(particles, Vessel(cylinder), MPI_COMM_WORLD).bed();
    add(Point<3>(0., 0., 50. * d));
    add(Point<3>(2. * d, 0., 55. * d));
    const auto raining =
      BedObservables(particles, Vessel(cylinder), MPI_COMM_WORLD).bed();
    EXPECT_NEAR(raining.height, resting.height, 1e-6 * d);
  }

  TEST(BedObservables, NoParticlesNoBed)
  {
    const ParticleArrays nothing;
    const auto           bed =
      BedObservables(nothing, Vessel(SmallColumn::vessel()), MPI_COMM_WORLD).bed();
    EXPECT_EQ(bed.height, 0.);
    EXPECT_EQ(bed.mean_void_fraction, 1.);
  }

  FillingParameters
  by_count(const unsigned int count)
  {
    FillingParameters filling;
    filling.count      = count;
    filling.bed_height = 0.;
    return filling;
  }

  // Law: a bed at rest is carried by bottom and wall, to the accelerations that
  // the criterion of rest leaves: 0.5 % of the weight. Nothing is lost, nothing
  // overlaps much, the void fraction is that of a narrow random bed.
  TEST(Bed, SettledBedWeighsOnBottomAndWall)
  {
    SmallColumn column(SmallColumn::parameters());
    Filling     filling(by_count(150), column.dem);
    while (filling.step())
      {
      }
    EXPECT_EQ(column.dem.n_global(), 150u);
    SettlingParameters rest;
    rest.kinetic_energy = 1e-13;
    rest.speed          = 1e-3;
    Settling settling(rest, column.dem);
    while (settling.step())
      {
      }
    column.dem.advance(0.02);

    const double weight = column.dem.weight();
    EXPECT_NEAR(
      column.dem.bottom_force() + column.dem.wall_force(), weight, 5e-3 * weight);
    EXPECT_GE(column.dem.bottom_force(), 0.3 * weight);
    EXPECT_GE(column.dem.coordination_number(), 3.5);
    const auto bed =
      BedObservables(column.dem.particles(), column.dem.vessel_shape(), MPI_COMM_WORLD)
        .bed();
    EXPECT_GE(bed.mean_void_fraction, 0.40);
    EXPECT_LE(bed.mean_void_fraction, 0.52);
  }

  // Filling by mass and by height: the number of particles that the mass makes;
  // the height to 1.5 diameters, since the bed is measured in motion.
  TEST(Bed, FilledByMassAndByHeight)
  {
    FillingParameters by_mass = by_count(0);
    SmallColumn       column(SmallColumn::parameters());
    by_mass.mass = 40.2 * column.dem.parameters().particles.simulated_mass();
    Filling filling(by_mass, column.dem);
    while (filling.step())
      {
      }
    EXPECT_EQ(column.dem.n_global(), 40u);

    FillingParameters to_height = by_count(0);
    to_height.bed_height        = 0.02;
    SmallColumn high(SmallColumn::parameters());
    Filling     rising(to_height, high.dem);
    while (rising.step())
      {
      }
    Settling settling(SettlingParameters(), high.dem);
    while (settling.step())
      {
      }
    EXPECT_NEAR(
      BedObservables(high.dem.particles(), high.dem.vessel_shape(), MPI_COMM_WORLD)
        .bed()
        .height,
      0.02,
      1.5 * 2e-3);
  }

  // The bed of so many spheres in the column with these planes, at rest.
  BedObservables::Bed
  settled_bed(const std::string &planes, const FillingParameters &fill)
  {
    DemParameters parameters = SmallColumn::parameters();
    parameters.walls.planes  = planes;
    SmallColumn column(parameters);
    Filling     filling(fill, column.dem);
    while (filling.step())
      {
      }
    Settling settling(SettlingParameters(), column.dem);
    while (settling.step())
      {
      }
    const auto bed =
      BedObservables(column.dem.particles(), column.dem.vessel_shape(), MPI_COMM_WORLD)
        .bed();
    std::cout << "bed from " << bed.bottom << " m, height " << bed.height
              << " m, expanded " << bed.expanded_height << " m, void fraction "
              << bed.mean_void_fraction << '\n';
    return bed;
  }

  // In a column, on a raised floor, in a duct and in a funnel: a bed has the void
  // fraction of spheres, begins at the floor, and both of its heights agree to 0.1 d.
  TEST(Bed, AtRestInVesselsThatPlanesMake)
  {
    const std::string raised = "0 0 0.003 0 0 -1",
                      duct = "0.0032 0 0 1 0 0, -0.0032 0 0 -1 0 0, 0 0.0032 0 0 1 0, 0 "
                             "-0.0032 0 0 -1 0",
                      funnel = "0.003 0 0 0.98 0 -0.2, -0.003 0 0 -0.98 0 -0.2";
    double in_column         = 0.;
    for (const std::string &planes : {std::string(), raised, duct, funnel})
      {
        const auto bed = settled_bed(planes, by_count(planes == duct ? 60 : 110));
        EXPECT_TRUE(bed.exists);
        EXPECT_EQ(bed.bottom, planes == raised ? 0.003 : 0.);
        EXPECT_NEAR(bed.expanded_height, bed.height, 0.1 * 2e-3);
        EXPECT_GT(bed.mean_void_fraction, 0.4);
        EXPECT_LT(bed.mean_void_fraction, 0.58);
        if (planes.empty())
          in_column = bed.height;
        if (planes == raised)
          {
            EXPECT_NEAR(bed.height, in_column, 0.5 * 2e-3);
          }
      }
  }

  // Half of the column has half of the room.
  TEST(Bed, FilledToAHeightInHalfOfTheColumnAndOnARaisedFloor)
  {
    FillingParameters to_height = by_count(0);
    to_height.bed_height        = 0.014;
    to_height.method            = "packing";
    for (const std::string planes : {"0.0005 0 0 1 0 0", "0 0 0.006 0 0 -1"})
      EXPECT_NEAR(settled_bed(planes, to_height).height, 0.014, 1.5 * 2e-3);
  }

  // A bed that is too loose is tapped to its target, and not far beyond: one
  // particle's share in a small bed, 0.01.
  TEST(Bed, TappedToATarget)
  {
    SmallColumn column(SmallColumn::parameters());
    Filling     filling(by_count(150), column.dem);
    while (filling.step())
      {
      }
    const BedObservables observables(
      column.dem.particles(), column.dem.vessel_shape(), MPI_COMM_WORLD);
    Settling first(SettlingParameters(), column.dem);
    while (first.step())
      {
      }
    const double loose = observables.bed().mean_void_fraction;

    SettlingParameters denser;
    denser.target_void_fraction = loose - 0.004;
    Settling second(denser, column.dem);
    while (second.step())
      {
      }
    EXPECT_GE(second.n_taps(), 1u);
    EXPECT_LE(observables.bed().mean_void_fraction, denser.target_void_fraction + 5e-4);
    EXPECT_GE(observables.bed().mean_void_fraction, denser.target_void_fraction - 0.01);
  }

  TEST(Bed, FullColumnIsAnError)
  {
    SmallColumn column(SmallColumn::parameters());
    Filling     filling(by_count(1000), column.dem);
    try
      {
        while (filling.step())
          {
          }
        FAIL() << "no exception";
      }
    catch (const DemError &error)
      {
        EXPECT_NE(std::string(error.what()).find("column is full"), std::string::npos);
      }
  }

  TEST(Bed, UnsettledBedIsAnError)
  {
    SmallColumn column(SmallColumn::parameters());
    column.dem.insert({Point<3>(0., 0., 0.02)});
    SettlingParameters impatient;
    impatient.maximum_time = 0.02;
    Settling settling(impatient, column.dem);
    EXPECT_THROW(while (settling.step()){}, DemError);
  }

  std::string
  offender(const std::function<void()> &check)
  {
    try
      {
        check();
      }
    catch (const InputError &error)
      {
        return error.parameter;
      }
    return "";
  }

  // Contradictions are found before anything is built, and name their line.
  TEST(Parameters, ContradictionsAreFound)
  {
    const Cylinder cylinder = SmallColumn::vessel();
    DemParameters  dem      = SmallColumn::parameters();
    EXPECT_EQ(offender([&] { dem.check(cylinder); }), "");
    dem.particles.diameter = 6e-3;
    EXPECT_EQ(offender([&] { dem.check(cylinder); }), "Particles/diameter");
    dem                 = SmallColumn::parameters();
    dem.particles.scale = 0.5;
    EXPECT_EQ(offender([&] { dem.check(cylinder); }), "Particles/scale");
    dem                 = SmallColumn::parameters();
    dem.contact.substep = 0.41 * dem.characteristic_time();
    EXPECT_EQ(offender([&] { dem.check(cylinder); }), "Contact/substep");
    dem.contact.substep = std::nan("");
    EXPECT_EQ(offender([&] { dem.check(cylinder); }), "Contact/substep");
    dem.contact                          = ContactParameters();
    dem.contact.wall_surface.restitution = 1.1;
    EXPECT_EQ(offender([&] { dem.check(cylinder); }), "Contact/wall restitution");

    const DemParameters spheres = SmallColumn::parameters();
    FillingParameters   filling;
    EXPECT_EQ(offender([&] { filling.check(cylinder, spheres); }), "Filling/bed height");
    filling = by_count(5);
    EXPECT_EQ(offender([&] { filling.check(cylinder, spheres); }), "");
    filling.mass = 1.;
    EXPECT_EQ(offender([&] { filling.check(cylinder, spheres); }), "Filling/bed height");
    filling = by_count(100000);
    EXPECT_EQ(offender([&] { filling.check(cylinder, spheres); }), "Filling/count");

    SettlingParameters settling;
    EXPECT_EQ(offender([&] { settling.check(); }), "");
    settling.target_void_fraction = 0.2;
    EXPECT_EQ(offender([&] { settling.check(); }), "Settling/target void fraction");
  }

  TEST(Parameters, EveryNumberHasAUnit)
  {
    dealii::ParameterHandler prm;
    DemParameters            dem;
    FillingParameters        filling;
    SettlingParameters       settling;
    dem.declare(prm);
    filling.declare(prm);
    settling.declare(prm);
    EXPECT_EQ(entries_without_unit(prm), std::vector<std::string>());
    EXPECT_GT(parameter_entries(prm).size(), 30u);
  }
} // namespace
