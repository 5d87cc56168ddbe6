#ifndef graupel_dem_spring_table_h
#define graupel_dem_spring_table_h

#include <graupel/dem/contact_laws.h>

#include <array>
#include <cstdint>
#include <vector>

namespace graupel
{
  /**
   * The springs of all touching contacts of each own particle, by the id of the
   * partner: the one format in which springs outlive a neighbour list, travel
   * to another rank, and rest in a checkpoint. Both partners hold a copy, as it
   * is in the contact's own orientation (from the lower id to the higher; from
   * the particle to the wall), so either side alone can restore the contact.
   */
  class SpringTable
  {
  public:
    /** Contacts that one particle can have. */
    static constexpr unsigned int n_slots = 16;
    /** Numbers of one particle in pack() and unpack(). */
    static constexpr unsigned int n_numbers = 7 * n_slots;

    /** Makes the table empty, with @p n_rows rows. */
    void reset(const unsigned int n_rows);

    /**
     * Adds a contact to a row. Returns false, and adds nothing, if all slots
     * are taken.
     */
    bool add(const unsigned int row, const std::int64_t partner, const Springs &springs);

    /** The springs of @p row with @p partner; nullptr if they do not touch. */
    const Springs *find(const unsigned int row, const std::int64_t partner) const;

    /** Contacts of a row with other particles. */
    unsigned int n_particle_contacts(const unsigned int row) const;

    /**
     * Writes a row to n_numbers doubles. Slot: partner + 1 if a particle,
     * partner if a wall, 0 if empty; then the two springs.
     */
    void pack(const unsigned int row, double *numbers) const;
    /** Reads a row as pack() wrote it. */
    void unpack(const unsigned int row, const double *numbers);

  private:
    std::vector<unsigned char>                     used;
    std::vector<std::array<std::int64_t, n_slots>> partners;
    std::vector<std::array<Springs, n_slots>>      springs;
  };
} // namespace graupel

#endif
