#include <graupel/simulation/files/growing_table.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace graupel
{
  GrowingTable::GrowingTable(const std::string &path)
    : path(path)
  {
  }

  void
  GrowingTable::add(const std::string &header, const std::string &row)
  {
    if (!stream.is_open())
      {
        stream.open(path);
        stream << header << '\n';
      }
    if (!(stream << row << std::endl))
      throw std::runtime_error("Cannot write " + path + ": is the disk full?");
  }

  void
  GrowingTable::continue_from(const double time)
  {
    std::ifstream before(path);
    if (!before)
      return;
    const std::string shortened = path + ".part";
    std::ofstream     kept(shortened);
    bool              is_header = true;
    for (std::string line; std::getline(before, line); is_header = false)
      if (is_header || std::strtod(line.c_str(), nullptr) <= time * (1. + 1e-9))
        kept << line << '\n';
    if (!kept.flush())
      throw std::runtime_error("Cannot write " + shortened + ": is the disk full?");
    kept.close();
    std::filesystem::rename(shortened, path);
    stream.open(path, std::ios::app);
  }
} // namespace graupel
