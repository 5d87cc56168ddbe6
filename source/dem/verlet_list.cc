#include <graupel/dem/verlet_list.h>

#include <numeric>

namespace graupel
{
  namespace
  {
    // More bins than this many per particle cost more to walk than they save;
    // the box of a rank with a few stray particles could have millions.
    constexpr double bins_per_particle = 8.;
  } // namespace

  VerletList::VerletList(const double skin)
    : skin(skin)
  {
  }

  void
  VerletList::build(const ParticleArrays &particles, const std::vector<Wall> &walls)
  {
    pairs.clear();
    wall_rows.assign(walls.size(), {});
    if (particles.n_owned == 0)
      return;

    const double largest =
      *std::max_element(particles.radius.begin(), particles.radius.end());
    sort_into_bins(particles, 2. * largest + skin);
    find_pairs(particles);

    for (unsigned int w = 0; w < walls.size(); ++w)
      std::visit(
        [&](const auto &surface) {
          for (unsigned int i = 0; i < particles.n_owned; ++i)
            if (surface.at(particles.position[i]).distance < particles.radius[i] + skin)
              wall_rows[w].push_back(i);
        },
        walls[w].shape);
  }

  void
  VerletList::sort_into_bins(const ParticleArrays &particles, const double bin_size)
  {
    const unsigned int n   = particles.n_rows();
    dealii::Point<3>   low = particles.position[0], high = low;
    for (const auto &x : particles.position)
      for (unsigned int d = 0; d < 3; ++d)
        {
          low[d]  = std::min(low[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }

    const auto extent = high - low;
    double     size   = bin_size;
    const auto count  = [&](const unsigned int d) {
      return 1. + std::floor(extent[d] / size);
    };
    while (count(0) * count(1) * count(2) > 64. + bins_per_particle * n)
      size *= 1.25;
    for (unsigned int d = 0; d < 3; ++d)
      n_bins[d] = static_cast<int>(count(d));

    bin_of_row.resize(n);
    begin.assign(n_bins[0] * n_bins[1] * n_bins[2] + 1, 0);
    for (unsigned int i = 0; i < n; ++i)
      {
        std::array<int, 3> b;
        for (unsigned int d = 0; d < 3; ++d)
          b[d] = std::min(static_cast<int>((particles.position[i][d] - low[d]) / size),
                          n_bins[d] - 1);
        bin_of_row[i] = (b[2] * n_bins[1] + b[1]) * n_bins[0] + b[0];
        ++begin[bin_of_row[i] + 1];
      }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());

    rows.resize(n);
    std::vector<unsigned int> next(begin.begin(), begin.end() - 1);
    for (unsigned int i = 0; i < n; ++i)
      rows[next[bin_of_row[i]]++] = i;
  }

  void
  VerletList::find_pairs(const ParticleArrays &particles)
  {
    // Both partners see each other; the lower row keeps the pair. Own rows come
    // before ghosts, so a pair of two ghosts never starts here.
    for (unsigned int i = 0; i < particles.n_owned; ++i)
      {
        const int x       = bin_of_row[i] % n_bins[0];
        const int y       = bin_of_row[i] / n_bins[0] % n_bins[1];
        const int z       = bin_of_row[i] / (n_bins[0] * n_bins[1]);
        const int first_x = std::max(x - 1, 0), last_x = std::min(x + 1, n_bins[0] - 1);

        for (int c = std::max(z - 1, 0); c <= std::min(z + 1, n_bins[2] - 1); ++c)
          for (int b = std::max(y - 1, 0); b <= std::min(y + 1, n_bins[1] - 1); ++b)
            {
              // Three bins in a row along x are contiguous.
              const int line = (c * n_bins[1] + b) * n_bins[0];
              for (unsigned int k = begin[line + first_x]; k < begin[line + last_x + 1];
                   ++k)
                {
                  const unsigned int j = rows[k];
                  if (j <= i)
                    continue;
                  const double reach = particles.radius[i] + particles.radius[j] + skin;
                  if ((particles.position[j] - particles.position[i]).norm_square() >=
                      reach * reach)
                    continue;
                  if (particles.id[i] < particles.id[j])
                    pairs.push_back({i, j});
                  else
                    pairs.push_back({j, i});
                }
            }
      }
  }
} // namespace graupel
