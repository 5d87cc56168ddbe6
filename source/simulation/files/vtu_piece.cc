// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/simulation/files/vtu_piece.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <numeric>
#include <ostream>

#include <zlib.h>

namespace graupel
{
  namespace
  {
    template <typename Number>
    constexpr const char *vtk_type = nullptr;
    template <>
    constexpr const char *vtk_type<unsigned char> = "UInt8";
    template <>
    constexpr const char *vtk_type<std::int32_t> = "Int32";
    template <>
    constexpr const char *vtk_type<std::int64_t> = "Int64";
    template <>
    constexpr const char *vtk_type<float> = "Float32";
    template <>
    constexpr const char *vtk_type<double> = "Float64";

    template <typename Number>
    std::string
    in_base64(const std::vector<Number> &numbers)
    {
      const auto *bytes = reinterpret_cast<const unsigned char *>(numbers.data());
      return dealii::Utilities::encode_base64(
        std::vector<unsigned char>(bytes, bytes + numbers.size() * sizeof(Number)));
    }

    // One compressed block behind its header: number of blocks, their size, that of the
    // last one and the compressed size. Source: VTK File Formats, "XML file formats".
    template <typename Number>
    std::string
    compressed(const std::vector<Number> &numbers)
    {
      if (numbers.empty())
        return "";
      const uLong                size = numbers.size() * sizeof(Number);
      std::vector<unsigned char> block(compressBound(size));
      uLong                      compressed_size = block.size();
      const int                  status =
        compress2(block.data(),
                  &compressed_size,
                  reinterpret_cast<const unsigned char *>(numbers.data()),
                  size,
                  Z_BEST_SPEED);
      AssertThrow(status == Z_OK, dealii::ExcMessage("zlib cannot compress an array."));
      AssertThrow(size <= std::numeric_limits<std::uint32_t>::max(),
                  dealii::ExcMessage("One rank has too much for one VTU file."));
      block.resize(compressed_size);
      const std::vector<std::uint32_t> header{
        1,
        static_cast<std::uint32_t>(size),
        static_cast<std::uint32_t>(size),
        static_cast<std::uint32_t>(compressed_size)};
      return in_base64(header) + in_base64(block);
    }

    template <typename Number>
    std::string
    data_array(const std::string         &name,
               const unsigned int         n_components,
               const std::vector<Number> &numbers)
    {
      return std::string("<DataArray type=\"") + vtk_type<Number> + "\" Name=\"" + name +
             "\" NumberOfComponents=\"" + std::to_string(n_components) +
             "\" format=\"binary\">\n" + compressed(numbers) + "\n</DataArray>\n";
    }

    template <typename Number, typename Vector>
    std::vector<Number>
    components(const std::vector<Vector> &vectors)
    {
      std::vector<Number> numbers;
      numbers.reserve(3 * vectors.size());
      for (const Vector &vector : vectors)
        for (unsigned int i = 0; i < 3; ++i)
          numbers.push_back(vector[i]);
      return numbers;
    }
  } // namespace

  VtuPiece::VtuPiece(const Cell cell, const std::vector<dealii::Point<3>> &points)
    : cell(cell)
    , n_points(points.size())
    , points(data_array("Points", 3, components<double>(points)))
  {
  }

  template <typename Number>
  void
  VtuPiece::add(const std::string &name, const std::vector<Number> &numbers)
  {
    AssertThrow(numbers.size() == n_points,
                dealii::ExcDimensionMismatch(numbers.size(), n_points));
    values += data_array(name, 1, numbers);
  }

  template <typename Number>
  void
  VtuPiece::add_vectors(const std::string                       &name,
                        const std::vector<dealii::Tensor<1, 3>> &vectors)
  {
    AssertThrow(vectors.size() == n_points,
                dealii::ExcDimensionMismatch(vectors.size(), n_points));
    values += data_array(name, 3, components<Number>(vectors));
  }

  void
  VtuPiece::write_vtu(std::ostream &stream) const
  {
    const unsigned int n_corners = cell == line ? 2 : 1;
    const std::size_t  n_cells   = n_points / n_corners;
    // Cells have their points in the order of these.
    std::vector<std::int32_t> corners(n_points), ends(n_cells);
    std::iota(corners.begin(), corners.end(), 0);
    for (std::size_t c = 0; c < n_cells; ++c)
      ends[c] = n_corners * (c + 1);
    stream << "<?xml version=\"1.0\" ?>\n"
              "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
              "compressor=\"vtkZLibDataCompressor\" byte_order=\"LittleEndian\">\n"
              "<UnstructuredGrid>\n"
           << "<Piece NumberOfPoints=\"" << n_points << "\" NumberOfCells=\"" << n_cells
           << "\">\n<Points>\n"
           << points << "</Points>\n<Cells>\n"
           << data_array("connectivity", 1, corners) << data_array("offsets", 1, ends)
           << data_array("types", 1, std::vector<unsigned char>(n_cells, cell))
           << "</Cells>\n<PointData>\n"
           << values << "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }

  template void VtuPiece::add(const std::string &, const std::vector<std::int32_t> &);
  template void VtuPiece::add(const std::string &, const std::vector<std::int64_t> &);
  template void VtuPiece::add(const std::string &, const std::vector<float> &);
  template void VtuPiece::add(const std::string &, const std::vector<double> &);
  template void VtuPiece::add_vectors<float>(const std::string &,
                                             const std::vector<dealii::Tensor<1, 3>> &);
  template void VtuPiece::add_vectors<double>(const std::string &,
                                              const std::vector<dealii::Tensor<1, 3>> &);
} // namespace graupel
