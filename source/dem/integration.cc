// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/dem/integration.h>

#include <limits>

namespace graupel
{
  namespace
  {
    // Force and torque over mass and inertia, times half a step: what velocity
    // and spin change by in each half of a substep.
    struct HalfKick
    {
      Triple<Lanes> velocity, spin;
    };

    Lanes
    as_real(const Lanes &bits)
    {
      WholeLanes number;
      static_assert(sizeof(number) == sizeof(bits));
      std::memcpy(static_cast<void *>(&number), &bits, sizeof(bits));
      return std::experimental::static_simd_cast<Lanes>(number);
    }

    [[gnu::always_inline]] inline Triple<Lanes>
    from_outside(const std::vector<dealii::Tensor<1, 3>> &x, const std::uint32_t *rows)
    {
      const auto component = [&](const unsigned int d) {
        return Lanes([&](auto l) { return x[rows[l]][d]; });
      };
      return {component(0), component(1), component(2)};
    }

    [[gnu::always_inline]] inline HalfKick
    half_kick(const ParticleArrays &p,
              const std::uint32_t  *rows,
              const Lanes          &radius,
              const Integration    &in)
    {
      Lanes load[8];
      load_records<8>(p.load.data(), rows, 0, load);
      for (auto &number : load)
        number = as_real(number);
      const Lanes mass([&](auto l) { return p.mass[rows[l]]; });
      const Lanes by_mass    = (0.5 * in.step) / mass;
      const Lanes by_inertia = by_mass / (0.4 * radius * radius);

      Triple<Lanes> force{
        in.quanta.force * load[0], in.quanta.force * load[1], in.quanta.force * load[2]};
      if (in.external_forces)
        force += from_outside(p.external_force, rows);
      const double  h = 0.5 * in.step;
      Triple<Lanes> spin =
        (by_inertia * in.quanta.torque) * Triple<Lanes>{load[3], load[4], load[5]};
      if (in.external_torques)
        spin += by_inertia * from_outside(p.external_torque, rows);
      return {by_mass * force +
                Triple<Lanes>{h * in.gravity[0], h * in.gravity[1], h * in.gravity[2]},
              spin};
    }

    template <bool kicks, bool drifts>
    double
    pass(ParticleArrays &p, const Integration &in)
    {
      Lanes                     largest = 0.;
      LaneMask                  sound(true);
      const std::uint32_t       n = p.n_owned;
      alignas(64) std::uint32_t rows[n_lanes];
      for (std::uint32_t i = 0; i < n; i += n_lanes)
        {
          // At the end the last row is done more than once, with the same result.
          for (unsigned int l = 0; l < n_lanes; ++l)
            rows[l] = std::min(i + l, n - 1);
          Lanes b[16];
          load_records<16>(p.body.data(), rows, 0, b);
          const HalfKick half = half_kick(p, rows, b[3], in);

          Triple<Lanes> velocity{b[4], b[5], b[6]}, spin{b[7], b[8], b[9]};
          Triple<Lanes> drift{b[10], b[11], b[12]}, spin_drift{b[13], b[14], b[15]};
          if constexpr (kicks)
            {
              velocity = drift + half.velocity;
              spin     = spin_drift + half.spin;
            }
          if constexpr (drifts)
            {
              drift      = velocity + half.velocity;
              spin_drift = spin + half.spin;
              velocity   = drift + half.velocity;
              spin       = spin_drift + half.spin;
              b[0] += in.step * drift.x;
              b[1] += in.step * drift.y;
              b[2]                     = in.period.rounded(b[2] + in.step * drift.z);
              const Lanes speed_square = drift.norm_square();
              largest                  = max(largest, speed_square);
              sound = sound && speed_square < std::numeric_limits<double>::max();
            }
          const Lanes after[16] = {b[0],
                                   b[1],
                                   b[2],
                                   b[3],
                                   velocity.x,
                                   velocity.y,
                                   velocity.z,
                                   spin.x,
                                   spin.y,
                                   spin.z,
                                   drift.x,
                                   drift.y,
                                   drift.z,
                                   spin_drift.x,
                                   spin_drift.y,
                                   spin_drift.z};
          store_records<16>(p.body.data(), rows, 0, after);
          if constexpr (drifts)
            for (const std::uint32_t row : rows)
              p.load[row] = Load{};
        }
      return std::experimental::all_of(sound) ? largest_lane(largest)
                                              : std::numeric_limits<double>::infinity();
    }
  } // namespace

  void
  kick(ParticleArrays &particles, const Integration &integration)
  {
    pass<true, false>(particles, integration);
  }

  double
  drift(ParticleArrays &particles, const Integration &integration)
  {
    return pass<false, true>(particles, integration);
  }

  double
  kick_and_drift(ParticleArrays &particles, const Integration &integration)
  {
    return pass<true, true>(particles, integration);
  }
} // namespace graupel
