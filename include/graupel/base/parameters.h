// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#ifndef graupel_base_parameters_h
#define graupel_base_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <iosfwd>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace graupel
{
  /**
   * A value of the user's that cannot be. Names the parameter by its path
   * ("Geometry/diameter") and says why it cannot be and what to try; where the
   * value was set is added by ParameterFile::explain(), which knows.
   */
  class InputError : public std::runtime_error
  {
  public:
    InputError(const std::string &parameter, const std::string &reason);

    /**
     * Path of the parameter, "Section/name". Empty when the text of a file or
     * of an override is at fault: what() is then the whole sentence already.
     */
    const std::string parameter;
  };

  /**
   * Throws InputError(parameter, reason) unless @p condition holds. Written so
   * that a NaN fails: pass the condition that must hold, not its opposite.
   */
  void require(const bool         condition,
               const std::string &parameter,
               const std::string &reason);

  /**
   * The number that @p text, the value of @p parameter, is (number_in()); nothing where
   * it is one of @p words. Throws InputError for any other text.
   */
  std::optional<double> number_or_word(const std::string              &parameter,
                                       const std::string              &text,
                                       const std::vector<std::string> &words);

  /**
   * Reads parameter files and --set overrides into a ParameterHandler whose
   * entries the rooms have declared, and remembers where each value came from.
   *
   * The text format is deal.II's: `subsection NAME`, `set name = value`, `end`,
   * `include FILE` (relative to the including file), comments, and a backslash at the end
   * of a line to continue it. A comment begins at a `#` that is first in its line or
   * behind a blank ("run#1" is a name); a backslash within it continues nothing. Of two
   * settings of one entry the later counts. A value that no file can hold is refused, so
   * that what the handler prints is read back to the same values.
   */
  class ParameterFile
  {
  public:
    /** @p handler must outlive this object, with all entries declared. */
    explicit ParameterFile(dealii::ParameterHandler &handler);

    /**
     * Reads a whole file; one whose name ends in .json or .xml as deal.II writes these
     * (values by section and name, in its long or its short form). Throws InputError for
     * an unknown section or entry (naming the nearest known one), for a value that does
     * not fit its entry's pattern, and for a file that cannot be read (or is no file, as
     * /dev/zero), that includes itself or is not closed.
     */
    void read(const std::string &file_name);

    /** The same from a stream; @p name stands for the file in messages. */
    void read(std::istream &stream, const std::string &name);

    /** Applies one override of the form "Section/name=value". */
    void set(const std::string &assignment);

    /**
     * The sentence for the user: where the value was set (file and line, the
     * command line, or the default), parameter, value, reason. An error that
     * names no declared parameter is its own sentence.
     */
    std::string explain(const InputError &error) const;

    /** The value of every declared entry as text, by its path "Section/name". */
    std::map<std::string, std::string> texts() const;

    /** Paths "Section/name" of every declared entry, sorted. */
    const std::vector<std::string> &known_parameters() const;

  private:
    void read_tree(const std::string &file_name, const bool is_json);
    void assign(const std::string &path,
                const std::string &value,
                const std::string &origin);

    dealii::ParameterHandler          &handler;
    std::vector<std::string>           known, patterns; // of each entry
    std::map<std::string, std::string> origins;
  };

  /** The element of @p known with the least edit distance to @p name. */
  std::string nearest_name(const std::string              &name,
                           const std::vector<std::string> &known);
} // namespace graupel

#endif
