#include <graupel/dem/spring_table.h>

namespace graupel
{
  void
  SpringTable::reset(const unsigned int n_rows)
  {
    used.assign(n_rows, 0);
    partners.resize(n_rows);
    springs.resize(n_rows);
  }

  bool
  SpringTable::add(const unsigned int row,
                   const std::int64_t partner,
                   const Springs     &contact)
  {
    const unsigned int slot = used[row];
    if (slot == n_slots)
      return false;
    partners[row][slot] = partner;
    springs[row][slot]  = contact;
    used[row]           = slot + 1;
    return true;
  }

  const Springs *
  SpringTable::find(const unsigned int row, const std::int64_t partner) const
  {
    for (unsigned int slot = 0; slot < used[row]; ++slot)
      if (partners[row][slot] == partner)
        return &springs[row][slot];
    return nullptr;
  }

  unsigned int
  SpringTable::n_particle_contacts(const unsigned int row) const
  {
    return std::count_if(partners[row].begin(),
                         partners[row].begin() + used[row],
                         [](const std::int64_t partner) { return partner >= 0; });
  }

  void
  SpringTable::pack(const unsigned int row, double *numbers) const
  {
    std::fill_n(numbers, n_numbers, 0.);
    for (unsigned int slot = 0; slot < used[row]; ++slot, numbers += 7)
      {
        const std::int64_t partner = partners[row][slot];
        numbers[0]                 = partner < 0 ? partner : partner + 1;
        for (unsigned int d = 0; d < 3; ++d)
          {
            numbers[1 + d] = springs[row][slot].tangential[d];
            numbers[4 + d] = springs[row][slot].rolling[d];
          }
      }
  }

  void
  SpringTable::unpack(const unsigned int row, const double *numbers)
  {
    used[row] = 0;
    for (unsigned int slot = 0; slot < n_slots && numbers[0] != 0.; ++slot, numbers += 7)
      {
        const auto stored = static_cast<std::int64_t>(numbers[0]);
        Springs    contact;
        for (unsigned int d = 0; d < 3; ++d)
          {
            contact.tangential[d] = numbers[1 + d];
            contact.rolling[d]    = numbers[4 + d];
          }
        add(row, stored < 0 ? stored : stored - 1, contact);
      }
  }
} // namespace graupel
