#include <graupel/base/parameters.h>
#include <graupel/dem/walls/walls.h>

#include <deal.II/base/utilities.h>

namespace graupel
{
  namespace
  {
    Triple<double>
    three_numbers(const std::vector<double> &numbers, const unsigned int first)
    {
      return {numbers[first], numbers[first + 1], numbers[first + 2]};
    }

    // "x y z nx ny nz" or with "vx vy vz" behind.
    PlaneWall
    read_plane(const std::string &text)
    {
      std::istringstream  stream(text);
      std::vector<double> numbers;
      for (double number; stream >> number;)
        numbers.push_back(number);
      require(stream.eof() && (numbers.size() == 6 || numbers.size() == 9),
              "Walls/planes",
              "\"" + text +
                "\" is not a plane: write a point, the normal out of the vessel and, if "
                "it moves, a velocity, six or nine numbers with blanks between; planes "
                "are separated by commas");
      PlaneWall    plane{three_numbers(numbers, 0), three_numbers(numbers, 3), {}};
      const double length = plane.normal.norm();
      require(length > 0., "Walls/planes", "the normal of a plane cannot be zero");
      plane.normal *= 1. / length;
      if (numbers.size() == 9)
        plane.velocity = three_numbers(numbers, 6);
      return plane;
    }
  } // namespace

  WallGeometry<double>
  Wall::at(const Triple<double> &x, const unsigned int facet, const double reach) const
  {
    return std::visit(
      [&](const auto &surface) -> WallGeometry<double> {
        if constexpr (std::is_same_v<std::decay_t<decltype(surface)>, SurfaceWall>)
          {
            std::vector<SurfaceMesh::Touch> touches;
            surface.mesh.touches(dealii::Point<3>(tensor(x)), reach, touches);
            for (const auto &touch : touches)
              if (touch.facet == facet)
                return {touch.distance, triple(touch.normal)};
            return NoWall().at(x);
          }
        else
          return surface.at(x);
      },
      shape);
  }

  bool
  Wall::is_near(const dealii::Point<3> &x, const double distance) const
  {
    if (const auto *surface = std::get_if<SurfaceWall>(&shape))
      return surface->mesh.near(x, distance);
    return at(triple(x)).distance < distance;
  }

  std::vector<Wall>
  vessel_walls(const Cylinder &cylinder)
  {
    const Triple<double> bottom, top{0., 0., cylinder.height};
    const Triple<double> up{0., 0., 1.};

    std::vector<Wall> walls(3);
    walls[lateral_wall] = {"wall", TubeWall{cylinder.diameter / 2.}};
    walls[bottom_wall]  = {"bottom", PlaneWall{bottom, -up}};
    walls[top_wall]     = {"top", PlaneWall{top, up}};
    return walls;
  }

  void
  WallParameters::declare(dealii::ParameterHandler &prm)
  {
    const dealii::Patterns::Selection ends("closed|open|periodic");
    prm.enter_subsection("Walls");
    prm.add_parameter("bottom",
                      bottom,
                      "The bottom of the vessel, for particles: closed, open (they "
                      "leave and are counted) or periodic (they come in at the top).",
                      ends);
    prm.add_parameter("top",
                      top,
                      "The top of the vessel, for particles: closed, open or periodic.",
                      ends);
    prm.add_parameter(
      "planes",
      planes,
      "Further plane walls, separated by commas; each a point [m], the normal out of "
      "the vessel and, for a moving plane, a velocity [m/s]: six or nine numbers.");
    prm.add_parameter(
      "surfaces", surfaces, "STL files of further walls, separated by commas.");
    prm.add_parameter("surface unit",
                      surface_unit,
                      "Length of the unit of the STL files, which name none [m].");
    prm.leave_subsection();
  }

  void
  WallParameters::check() const
  {
    require((bottom == "periodic") == (top == "periodic"),
            "Walls/top",
            "what leaves a periodic end comes in at the other, so both or none is "
            "periodic");
    require(surface_unit > 0.,
            "Walls/surface unit",
            "a unit of length is positive, in metres: 1e-3 for millimetres");
    for (const auto &text : dealii::Utilities::split_string_list(planes))
      read_plane(text);
  }

  std::vector<Wall>
  WallParameters::walls(const Cylinder &cylinder) const
  {
    std::vector<Wall> walls = vessel_walls(cylinder);
    if (bottom != "closed")
      walls[bottom_wall].shape = NoWall{};
    if (top != "closed")
      walls[top_wall].shape = NoWall{};

    unsigned int number = 0;
    for (const auto &text : dealii::Utilities::split_string_list(planes))
      walls.push_back({"plane " + std::to_string(++number), read_plane(text)});
    for (const auto &file : dealii::Utilities::split_string_list(surfaces))
      walls.push_back({file, SurfaceWall{SurfaceMesh::read_stl(file, surface_unit)}});
    return walls;
  }
} // namespace graupel
