#ifndef graupel_dem_spring_table_h
#define graupel_dem_spring_table_h

#include <graupel/dem/contact_laws.h>

#include <cstdint>
#include <vector>

namespace graupel
{
  /**
   * The springs of all touching contacts of each own particle, by the id of the
   * partner: the one format in which springs outlive the numbering of rows,
   * travel to another rank, and rest in a checkpoint. Both partners hold a copy,
   * as it is in the contact's own orientation (from the lower id to the higher;
   * from the particle to the wall), so either side alone can restore the contact.
   */
  class SpringTable
  {
  public:
    /** A contact of a particle. */
    struct Entry
    {
      /** Id of the other particle, or a negative wall_id(). */
      std::int64_t    partner;
      Springs<double> springs;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &partner &springs.tangential.x &springs.tangential.y &springs.tangential
          .z &springs.rolling.x &springs.rolling.y &springs.rolling.z;
      }
    };

    /** Makes the table empty. */
    void
    clear()
    {
      starts.assign(1, 0);
      entries.clear();
    }

    /** Adds the next row. */
    template <class Iterator>
    void
    add_row(const Iterator begin, const Iterator end)
    {
      entries.insert(entries.end(), begin, end);
      starts.push_back(entries.size());
    }

    /**
     * Makes a table of @p n_rows rows from entries in any order: a counting
     * sort. @p visit is called twice with a function (row, entry) to be called
     * for each entry.
     */
    template <class Visit>
    void
    fill(const unsigned int n_rows, const Visit &visit)
    {
      starts.assign(n_rows + 1, 0);
      visit([&](const unsigned int row, const Entry &) { ++starts[row + 1]; });
      for (unsigned int row = 0; row < n_rows; ++row)
        starts[row + 1] += starts[row];
      entries.resize(starts.back());
      std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
      visit([&](const unsigned int row, const Entry &entry) {
        entries[next[row]++] = entry;
      });
    }

    unsigned int
    n_rows() const
    {
      return starts.size() - 1;
    }

    const Entry *
    begin(const unsigned int row) const
    {
      return entries.data() + starts[row];
    }

    const Entry *
    end(const unsigned int row) const
    {
      return entries.data() + starts[row + 1];
    }

  private:
    std::vector<std::size_t> starts{0};
    std::vector<Entry>       entries;
  };
} // namespace graupel

#endif
