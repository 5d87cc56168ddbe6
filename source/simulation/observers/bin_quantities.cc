// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/observers/bin_averages.h>

namespace graupel
{
  namespace
  {
    using Function = std::function<Value(const BinView &)>;

    Function
    place(const unsigned int direction)
    {
      return [direction](const BinView &view) {
        return view.grid.middle_of(view.bin)[direction];
      };
    }

    // From the corner, along a side; nothing where the bins do not follow each other.
    Function
    along(const unsigned int axis)
    {
      return [axis](const BinView &view) -> Value {
        if (axis > 0 && view.grid.counts[axis] == 1)
          return {};
        return (view.grid.places(view.bin)[axis] + 0.5) * view.grid.width(axis);
      };
    }

    Value
    mean_of(const Moments &moments)
    {
      return moments.weight > 0. ? Value(moments.mean) : Value();
    }

    Value
    rms_of(const Moments &moments)
    {
      return moments.weight > 0. ? Value(moments.rms()) : Value();
    }

    // Of a quantity that has a value at every look.
    Function
    mean(Moments BinSums::*member)
    {
      return [member](const BinView &view) { return mean_of(view.sums.*member); };
    }

    Function
    rms(Moments BinSums::*member)
    {
      return [member](const BinView &view) { return rms_of(view.sums.*member); };
    }

    Function
    flux(const unsigned int i)
    {
      return [i](const BinView &view) { return mean_of(view.sums.flux[i]); };
    }

    Value
    volume(const BinView &view)
    {
      return view.volume;
    }

    template <typename Number>
    Function
    count(Number BinSums::*member)
    {
      return [member](const BinView &view) -> Value {
        return static_cast<double>(view.sums.*member);
      };
    }

    Value
    particles(const BinView &view)
    {
      return view.sums.time > 0. ? Value(view.sums.particles / view.sums.time) : Value();
    }

    Function
    mean_velocity(const unsigned int i)
    {
      return [i](const BinView &view) -> Value {
        if (!(view.sums.particles > 0.))
          return {};
        return view.sums.velocity[i] / view.sums.particles;
      };
    }

    Function
    velocity_error(const unsigned int i)
    {
      return
        [i](const BinView &view) { return view.sums.velocity_blocks[i].error_of_mean(); };
    }

    Value
    solid_fraction_error(const BinView &view)
    {
      return view.sums.solid_fraction_blocks.error_of_mean();
    }

    Function
    velocity_rms(const unsigned int i)
    {
      return [i](const BinView &view) -> Value {
        const BinSums &sums = view.sums;
        if (!(sums.particles > 0.))
          return {};
        const double mean = sums.velocity[i] / sums.particles;
        return std::sqrt(std::max(0., sums.squares[i] / sums.particles - mean * mean));
      };
    }

    Value
    granular_temperature(const BinView &view)
    {
      if (!(view.sums.freedom > 0.))
        return {};
      return view.sums.agitation / view.sums.freedom / 3.;
    }

    Function
    solid_flux(const unsigned int i)
    {
      return [i](const BinView &view) -> Value {
        if (!(view.volume > 0. && view.sums.time > 0.))
          return {};
        return view.sums.transport[i] / view.sums.time / view.volume;
      };
    }
  } // namespace

  const std::vector<Quantity<BinView>> &
  bin_quantities()
  {
    static const std::vector<Quantity<BinView>> table{
      {"x", "m", "place of the bin's middle", place(0)},
      {"y", "m", "the same", place(1)},
      {"z", "m", "the same", place(2)},
      {"along", "m", "its distance from the beginning of the line or side", along(0)},
      {"across", "m", "the same along the other side of a plane", along(1)},
      {"volume", "m^3", "volume of the bin as far as it lies in the vessel", volume},
      {"samples", "-", "how often the bin was looked at", count(&BinSums::samples)},
      {"seen", "-", "how often with a particle in it", count(&BinSums::seen)},
      {"particles", "-", "mean number of particles with their center in it", particles},
      {"solid_fraction",
       "-",
       "mean volume of solid in the bin, spheres cut by its faces, over its volume",
       mean(&BinSums::solid_fraction)},
      {"solid_fraction_rms",
       "-",
       "rms of the same about its mean",
       rms(&BinSums::solid_fraction)},
      {"solid_fraction_error",
       "-",
       "standard error of that mean, by blocks of looks; empty where the time was too "
       "short for one",
       solid_fraction_error},
      {"velocity_x",
       "m/s",
       "mean velocity of the particles with their center in the bin",
       mean_velocity(0)},
      {"velocity_y", "m/s", "the same", mean_velocity(1)},
      {"velocity_z", "m/s", "the same", mean_velocity(2)},
      {"velocity_error_x",
       "m/s",
       "standard error of that mean, as of the solid fraction",
       velocity_error(0)},
      {"velocity_error_y", "m/s", "the same", velocity_error(1)},
      {"velocity_error_z", "m/s", "the same", velocity_error(2)},
      {"velocity_rms_x",
       "m/s",
       "rms of the particles' velocities about that mean, over particles and time",
       velocity_rms(0)},
      {"velocity_rms_y", "m/s", "the same", velocity_rms(1)},
      {"velocity_rms_z", "m/s", "the same", velocity_rms(2)},
      {"granular_temperature",
       "m^2/s^2",
       "a third of the variance of the velocities of the particles that are in the bin "
       "at "
       "the same moment, mean over time; empty if there were never two",
       granular_temperature},
      {"solid_flux_x",
       "m/s",
       "mean volume of particles times their velocity, over the bin's volume",
       solid_flux(0)},
      {"solid_flux_y", "m/s", "the same", solid_flux(1)},
      {"solid_flux_z", "m/s", "the same", solid_flux(2)},
      {"void_fraction",
       "-",
       "mean of the fluid's void fraction over the bin",
       mean(&BinSums::void_fraction)},
      {"void_fraction_rms",
       "-",
       "rms of the same about its mean",
       rms(&BinSums::void_fraction)},
      {"flux_x",
       "m/s",
       "mean volumetric flux of the fluid: void fraction times velocity",
       flux(0)},
      {"flux_y", "m/s", "the same", flux(1)},
      {"flux_z", "m/s", "the same", flux(2)},
      {"pressure", "Pa", "mean pressure", mean(&BinSums::pressure)},
      {"pressure_rms", "Pa", "rms of the same about its mean", rms(&BinSums::pressure)}};
    return table;
  }
} // namespace graupel
