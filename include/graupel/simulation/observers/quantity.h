// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_simulation_observers_quantity_h
#define graupel_simulation_observers_quantity_h

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace graupel
{
  /** A number that a run reports, or nothing where there is none. */
  using Value = std::optional<double>;

  /**
   * A quantity that a run reports: the name of its column, its unit, what it means, and
   * the function that finds it in @p Seen. A table of these is all that monitors.csv,
   * cases.csv, summary.json, the log and doc/output-files.md know of it.
   */
  template <class Seen>
  struct Quantity
  {
    /** Column and key. */
    std::string name;
    /** "m", "Pa", "-", or "flag" for true and false. */
    std::string unit;
    /** A phrase without a full stop. */
    std::string meaning;
    /** Collective; the same on every rank. */
    std::function<Value(const Seen &)> value;
    /** How the log calls it, and the factor and unit there; empty: not told. */
    std::string told        = {};
    std::string told_unit   = {};
    double      told_factor = 1.;
  };

  /** The values of a table's quantities at one moment, in the table's order. */
  class Values
  {
  public:
    Values() = default;

    template <class Seen>
    Values(const std::vector<Quantity<Seen>> &table, const Seen &seen)
    {
      for (const auto &quantity : table)
        values.push_back(quantity.value(seen));
    }

    const Value &
    operator[](const std::size_t n) const
    {
      return values[n];
    }

    std::size_t
    size() const
    {
      return values.size();
    }

    /** For checkpoints: nothing is NaN. */
    std::vector<double> numbers() const;
    static Values       of_numbers(const std::vector<double> &numbers);

  private:
    std::vector<Value> values;
  };

  /** Place of the quantity @p name in @p table. Throws std::invalid_argument. */
  template <class Seen>
  std::size_t
  place_of(const std::string &name, const std::vector<Quantity<Seen>> &table)
  {
    for (std::size_t n = 0; n < table.size(); ++n)
      if (table[n].name == name)
        return n;
    throw std::invalid_argument("there is no quantity " + name);
  }

  /** A cell of a CSV file: empty without a value, true or false for a flag. */
  std::string cell_text(const Value &value, const std::string &unit);

  /** The header of a CSV file, without the end of the line. */
  template <class Seen>
  std::string
  header(const std::vector<Quantity<Seen>> &table)
  {
    std::string text;
    for (const auto &quantity : table)
      text += (text.empty() ? "" : ",") + quantity.name;
    return text;
  }

  /** A row of a CSV file, without the end of the line. */
  template <class Seen>
  std::string
  csv_row(const std::vector<Quantity<Seen>> &table, const Values &values)
  {
    std::string text;
    for (std::size_t n = 0; n < table.size(); ++n)
      text += (n == 0 ? "" : ",") + cell_text(values[n], table[n].unit);
    return text;
  }

  /** The rows of a table in doc/output-files.md. */
  template <class Seen>
  std::string
  documentation(const std::vector<Quantity<Seen>> &table)
  {
    std::string text = "| column | unit | meaning |\n| --- | --- | --- |\n";
    for (const auto &quantity : table)
      text += "| `" + quantity.name + "` | " + quantity.unit + " | " + quantity.meaning +
              " |\n";
    return text;
  }

  /** A quantity as the log tells it: "pressure drop 12.3 Pa"; empty without a value. */
  std::string told_text(const std::string &told,
                        const Value       &value,
                        const double       factor,
                        const std::string &unit);

  /** What the log tells of @p values, with commas between. */
  template <class Seen>
  std::string
  told(const std::vector<Quantity<Seen>> &table, const Values &values)
  {
    std::string text;
    for (std::size_t n = 0; n < table.size(); ++n)
      if (const auto &q = table[n]; !q.told.empty())
        if (const auto piece = told_text(q.told, values[n], q.told_factor, q.told_unit);
            !piece.empty())
          text += (text.empty() ? "" : ", ") + piece;
    return text;
  }
} // namespace graupel

#endif
