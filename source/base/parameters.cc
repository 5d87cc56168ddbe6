// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameter_entries.h>
#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>

#include <deal.II/base/exceptions.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>

namespace graupel
{
  namespace
  {
    // Something is wrong with the text itself; there is no value to explain.
    [[noreturn]] void
    refuse(const std::string &origin, const std::string &reason)
    {
      throw InputError("", origin + ": " + reason);
    }

    // The file that the user named, in messages.
    constexpr const char *this_file = "this parameter file";

    std::string
    in_quotes(const std::string &text)
    {
      return '"' + text + '"';
    }

    std::string
    trimmed(const std::string &text)
    {
      const char *const blanks = " \t\r\n";
      const auto        first  = text.find_first_not_of(blanks);
      if (first == std::string::npos)
        return "";
      return text.substr(first, text.find_last_not_of(blanks) - first + 1);
    }

    // "A/B/name" as the sections {A, B} and the name.
    std::pair<std::vector<std::string>, std::string>
    split_path(const std::string &path)
    {
      std::vector<std::string> sections;
      std::size_t              begin = 0;
      for (std::size_t slash; (slash = path.find('/', begin)) != std::string::npos;
           begin = slash + 1)
        sections.push_back(path.substr(begin, slash - begin));
      return {sections, path.substr(begin)};
    }

    // A path as seen from the file that names it ("FILE:LINE").
    std::string
    absolute_path(const std::string &path, const std::string &origin)
    {
      const auto                  colon = origin.rfind(':');
      const std::filesystem::path folder =
        colon == std::string::npos
          ? ""
          : std::filesystem::path(origin.substr(0, colon)).parent_path();
      return std::filesystem::absolute(folder / path).lexically_normal().string();
    }

    // The same for a list of "NAME: PATH"; a path without a name gets itself for one.
    std::string
    absolute_paths(const std::string &list, const std::string &origin)
    {
      std::string        result;
      std::istringstream entries(list);
      for (std::string entry; std::getline(entries, entry, ',');)
        {
          const auto colon = entry.find(':');
          const auto name  = trimmed(entry.substr(0, colon));
          const auto path =
            colon == std::string::npos ? name : trimmed(entry.substr(colon + 1));
          result +=
            (result.empty() ? "" : ", ") + name + ": " + absolute_path(path, origin);
        }
      return result;
    }

    // Where a comment begins: at a # that is first in the line or behind a blank, so
    // that "run#1" is a name. npos if there is none.
    std::size_t
    begin_of_comment(const std::string &line)
    {
      for (auto at = line.find('#'); at != std::string::npos; at = line.find('#', at + 1))
        if (at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t')
          return at;
      return std::string::npos;
    }

    // The next statement: lines joined where a backslash ends one, each without its
    // comment. A backslash within a comment continues nothing. False at the end.
    bool
    next_statement(std::istream &stream,
                   std::string  &statement,
                   unsigned int &first_line,
                   unsigned int &lines_read)
    {
      statement.clear();
      first_line = lines_read + 1;
      for (std::string line; std::getline(stream, line);)
        {
          ++lines_read;
          std::string text      = trimmed(line.substr(0, begin_of_comment(line)));
          const bool  continued = !text.empty() && text.back() == '\\';
          if (continued)
            text.pop_back();
          statement += text;
          if (!continued)
            break;
        }
      statement = trimmed(statement);
      return lines_read >= first_line;
    }

    // Whether a parameter file can hold the value so that it is read back as it is.
    bool
    survives_in_file(const std::string &value)
    {
      // As it stands there: behind "set name = ".
      return begin_of_comment(' ' + value) == std::string::npos &&
             value.find_first_of("\r\n") == std::string::npos &&
             (value.empty() || value.back() != '\\');
    }

    // The file, which is @p what at @p where for the user. Looked at before it is opened:
    // /dev/zero never ends, a pipe may never begin.
    std::ifstream
    opened(const std::string &file_name,
           const bool         may_be_pipe,
           const std::string &where,
           const std::string &what)
    {
      std::error_code none;
      const auto      kind = std::filesystem::status(file_name, none).type();
      std::ifstream   stream;
      if (kind == std::filesystem::file_type::regular ||
          (kind == std::filesystem::file_type::fifo && may_be_pipe))
        stream.open(file_name);
      if (!stream.is_open())
        refuse(where, "cannot read " + what + "; is the path right?");
      return stream;
    }

    /**
     * Walks through the statements of a file and of what it includes, and
     * hands every assignment on: path, value, and "FILE:LINE".
     */
    class Reader
    {
    public:
      using Assign = std::function<void(
        const std::string &, const std::string &, const std::string &)>;

      Reader(const std::vector<std::string> &known, const Assign &assign)
        : known(known)
        , assign(assign)
      {
      }

      // Empty @p asked_by: the file that the user named.
      void
      read_file(const std::string &file_name, const std::string &asked_by)
      {
        const std::string where = asked_by.empty() ? file_name : asked_by;
        const std::string what =
          asked_by.empty() ? this_file : "the included file " + in_quotes(file_name);

        std::ifstream stream = opened(file_name, asked_by.empty(), where, what);

        // By another path (a link, "./") it is still the same file.
        const auto is_the_same = [&](const std::string &open) {
          std::error_code none;
          return std::filesystem::equivalent(open, file_name, none);
        };
        if (std::any_of(open_files.begin(), open_files.end(), is_the_same))
          refuse(where,
                 what + " is still being read: files include each other in a circle");
        open_files.push_back(file_name);
        read_stream(stream, file_name);
        open_files.pop_back();
      }

      void
      read_stream(std::istream &stream, const std::string &name)
      {
        const std::size_t sections_outside = sections.size();
        std::string       statement;
        unsigned int      line = 0, lines_read = 0;
        while (next_statement(stream, statement, line, lines_read))
          if (!statement.empty())
            obey(statement, name, name + ':' + std::to_string(line), sections_outside);

        if (sections.size() > sections_outside)
          refuse(sections.back().origin,
                 "the section " + in_quotes(sections.back().name) +
                   " has no \"end\" before the end of the file");
      }

    private:
      struct OpenSection
      {
        std::string name;
        std::string origin;
      };

      std::string
      path_of(const std::string &name) const
      {
        std::string path;
        for (const OpenSection &section : sections)
          path += section.name + "/";
        return path + name;
      }

      void
      obey(const std::string &statement,
           const std::string &file_name,
           const std::string &origin,
           const std::size_t  sections_outside)
      {
        const auto  blank   = statement.find_first_of(" \t");
        std::string keyword = statement.substr(0, blank);
        std::transform(keyword.begin(),
                       keyword.end(),
                       keyword.begin(),
                       [](unsigned char c) { return std::tolower(c); });
        const std::string rest =
          blank == std::string::npos ? "" : trimmed(statement.substr(blank));

        if (keyword == "subsection" && !rest.empty())
          sections.push_back({rest, origin});
        else if (keyword == "end" && rest.empty())
          close_section(origin, sections_outside);
        else if (keyword == "set" && !rest.empty())
          {
            const auto equals = rest.find('=');
            if (equals == std::string::npos)
              refuse(origin,
                     in_quotes(statement) +
                       " gives no value; write \"set name = value\"");
            assign(path_of(trimmed(rest.substr(0, equals))),
                   trimmed(rest.substr(equals + 1)),
                   origin);
          }
        else if (keyword == "include" && !rest.empty())
          read_file((std::filesystem::path(file_name).parent_path() / rest).string(),
                    origin);
        else
          refuse(
            origin,
            in_quotes(statement) +
              " is no statement; expected \"set name = value\", \"subsection NAME\", "
              "\"end\", \"include FILE\" or a comment after #");
      }

      // A section that holds nothing would otherwise escape the check of names.
      void
      close_section(const std::string &origin, const std::size_t sections_outside)
      {
        if (sections.size() <= sections_outside)
          refuse(origin, "this \"end\" closes no section of this file");

        const std::string        path = path_of("");
        std::vector<std::string> known_sections;
        for (const std::string &name : known)
          for (auto slash = name.find('/'); slash != std::string::npos;
               slash      = name.find('/', slash + 1))
            known_sections.push_back(name.substr(0, slash));
        const std::string name = path.substr(0, path.size() - 1);
        if (std::find(known_sections.begin(), known_sections.end(), name) ==
            known_sections.end())
          refuse(sections.back().origin,
                 "there is no section " + in_quotes(name) + "; did you mean " +
                   in_quotes(nearest_name(name, known_sections)) + "?");
        sections.pop_back();
      }

      const std::vector<std::string> &known;
      const Assign                    assign;
      std::vector<OpenSection>        sections;
      std::vector<std::string>        open_files;
    };
  } // namespace

  InputError::InputError(const std::string &parameter, const std::string &reason)
    : std::runtime_error(parameter.empty() ? reason : parameter + ": " + reason)
    , parameter(parameter)
  {
  }

  void
  require(const bool condition, const std::string &parameter, const std::string &reason)
  {
    if (!condition)
      throw InputError(parameter, reason);
  }

  std::optional<double>
  number_or_word(const std::string              &parameter,
                 const std::string              &text,
                 const std::vector<std::string> &words)
  {
    if (std::find(words.begin(), words.end(), text) != words.end())
      return {};
    if (const auto value = number_in(text))
      return value;
    throw InputError(parameter,
                     in_quotes(text) + " is neither a number nor " +
                       boost::algorithm::join(words, " nor "));
  }

  ParameterFile::ParameterFile(dealii::ParameterHandler &handler)
    : handler(handler)
  {
    for (const ParameterEntry &entry : parameter_entries(handler))
      {
        known.push_back(entry.path);
        patterns.push_back(entry.pattern);
      }
  }

  void
  ParameterFile::read(const std::string &file_name)
  {
    const std::string kind = std::filesystem::path(file_name).extension().string();
    if (kind == ".json" || kind == ".xml")
      return read_tree(file_name, kind == ".json");
    Reader(known, [this](const auto &path, const auto &value, const auto &origin) {
      assign(path, value, origin);
    }).read_file(file_name, "");
  }

  void
  ParameterFile::read(std::istream &stream, const std::string &name)
  {
    Reader(known, [this](const auto &path, const auto &value, const auto &origin) {
      assign(path, value, origin);
    }).read_stream(stream, name);
  }

  void
  ParameterFile::read_tree(const std::string &file_name, const bool is_json)
  {
    std::ifstream stream = opened(file_name, true, file_name, this_file);
    try
      {
        if (is_json)
          handler.parse_input_from_json(stream);
        else
          handler.parse_input_from_xml(stream);
      }
    catch (const dealii::ExceptionBase &error)
      {
        std::ostringstream text;
        error.print_info(text);
        refuse(file_name, "this is no parameter file: " + trimmed(text.str()));
      }
    catch (const std::exception &error)
      {
        refuse(file_name, std::string("this is no parameter file: ") + error.what());
      }
    // As if each were set by itself.
    for (const auto &[path, value] : texts())
      assign(path, value, file_name + ':' + path);
  }

  void
  ParameterFile::set(const std::string &assignment)
  {
    const auto equals = assignment.find('=');
    if (equals == std::string::npos)
      refuse("--set", "expected \"Section/name=value\", not " + in_quotes(assignment));
    assign(trimmed(assignment.substr(0, equals)),
           trimmed(assignment.substr(equals + 1)),
           "--set");
  }

  std::string
  ParameterFile::explain(const InputError &error) const
  {
    if (!std::binary_search(known.begin(), known.end(), error.parameter))
      return error.what();

    const auto [sections, name] = split_path(error.parameter);
    const std::string value     = error.parameter + " = " + handler.get(sections, name);
    const std::string reason =
      std::string(error.what()).substr(error.parameter.size() + 2);
    const auto origin = origins.find(error.parameter);
    if (origin == origins.end())
      return value + " (the default): " + reason;
    return origin->second + ": " + value + ": " + reason;
  }

  std::map<std::string, std::string>
  ParameterFile::texts() const
  {
    std::map<std::string, std::string> result;
    for (const std::string &path : known)
      {
        const auto [sections, name] = split_path(path);
        result[path]                = handler.get(sections, name);
      }
    return result;
  }

  const std::vector<std::string> &
  ParameterFile::known_parameters() const
  {
    return known;
  }

  void
  ParameterFile::assign(const std::string &path,
                        const std::string &value,
                        const std::string &origin)
  {
    const auto place = std::lower_bound(known.begin(), known.end(), path);
    if (place == known.end() || *place != path)
      refuse(origin,
             "there is no parameter " + in_quotes(path) + "; did you mean " +
               in_quotes(nearest_name(path, known)) + "?");

    const auto [sections, name] = split_path(path);
    const std::string &pattern  = patterns[place - known.begin()];

    // A path is meant relative to the file that names it ("FILE:LINE").
    std::string fitted = value;
    if (pattern.rfind("[FileName", 0) == 0 && !value.empty())
      fitted = absolute_path(value, origin);
    if (pattern.rfind("[List of <[FileName", 0) == 0)
      fitted = absolute_paths(value, origin);

    if (!survives_in_file(fitted))
      refuse(origin,
             path + " = " + fitted +
               ": no parameter file can hold this value, in which a # behind a blank "
               "begins a comment and a backslash at the end continues the line; choose "
               "another name");

    // deal.II would take a negative number for an unsigned one, modulo 2^32.
    bool fits = !(pattern == "[Integer]" && value.find('-') != std::string::npos);
    for (const std::string &section : sections)
      handler.enter_subsection(section);
    try
      {
        if (fits)
          handler.set(name, fitted);
      }
    catch (const std::exception &)
      {
        fits = false;
      }
    for (unsigned int i = 0; i < sections.size(); ++i)
      handler.leave_subsection();

    if (!fits)
      refuse(origin, path + " = " + value + ": expected " + expected_by(pattern));
    origins[path] = origin;
  }

  std::string
  nearest_name(const std::string &name, const std::vector<std::string> &known)
  {
    // Levenshtein's distance, a row of the table at a time.
    const auto distance = [&name](const std::string &other) {
      std::vector<std::size_t> row(other.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 1; i <= name.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i;
          for (std::size_t j = 1; j <= other.size(); ++j)
            {
              const std::size_t replaced = diagonal + (name[i - 1] != other[j - 1]);
              diagonal                   = row[j];
              row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
            }
        }
      return row.back();
    };

    std::string nearest;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const std::string &candidate : known)
      if (const std::size_t d = distance(candidate); d < least)
        {
          least   = d;
          nearest = candidate;
        }
    return nearest;
  }
} // namespace graupel
