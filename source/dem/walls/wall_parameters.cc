// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameters.h>
#include <graupel/base/read_numbers.h>
#include <graupel/dem/walls/walls.h>

#include <deal.II/base/utilities.h>

#include <filesystem>
#include <set>

namespace graupel
{
  namespace
  {
    using dealii::Utilities::split_string_list;
    using dealii::Utilities::trim;

    Triple<double>
    three_numbers(const std::vector<double> &numbers, const unsigned int first)
    {
      return {numbers[first], numbers[first + 1], numbers[first + 2]};
    }

    // "name: text", or only the text.
    struct NamedText
    {
      std::string name, text;
    };

    NamedText
    split_name(const std::string &entry)
    {
      const auto colon = entry.find(':');
      if (colon == std::string::npos)
        return {"", trim(entry)};
      return {trim(entry.substr(0, colon)), trim(entry.substr(colon + 1))};
    }

    void
    check_name(const std::string           &name,
               const std::string           &parameter,
               const std::set<std::string> &taken)
    {
      require(!name.empty() && name.find_first_of("=|;") == std::string::npos &&
                name.find_first_not_of("0123456789") != std::string::npos,
              parameter,
              "\"" + name +
                "\" cannot be the name of a wall, which is no number and holds none of "
                ", : = | ;. Write \"NAME: \" in front of the entry, with another one");
      require(taken.count(name) == 0,
              parameter,
              "\"" + name +
                "\" is a wall already (wall, bottom and top always are). Write "
                "\"NAME: \" in front of the entry, with another name");
    }

    // "x y z nx ny nz" or with "vx vy vz" behind.
    Wall
    read_plane(const NamedText &entry)
    {
      const auto numbers = read_numbers("Walls/planes", entry.text);
      require(numbers.size() == 6 || numbers.size() == 9,
              "Walls/planes",
              "\"" + entry.text +
                "\" is not a plane: write a point, the normal out of the vessel and, if "
                "it moves, a velocity, six or nine numbers with blanks between, and in "
                "front, if wanted, \"NAME: \"; planes are separated by commas");
      PlaneWall    plane{three_numbers(numbers, 0), three_numbers(numbers, 3)};
      const double length = plane.normal.norm();
      require(length > 0., "Walls/planes", "the normal of a plane cannot be zero");
      plane.normal *= 1. / length;
      Wall wall{entry.name, plane};
      if (numbers.size() == 9)
        wall.course.set_constant_velocity(three_numbers(numbers, 6));
      return wall;
    }

    unsigned int
    number_of(const std::string       &name,
              const std::vector<Wall> &walls,
              const std::string       &parameter)
    {
      std::string known;
      for (unsigned int w = 0; w < walls.size(); ++w)
        {
          if (walls[w].name == name)
            return w;
          known += (w > 0 ? ", " : "") + walls[w].name;
        }
      throw InputError(parameter,
                       "there is no wall \"" + name + "\"; there are " + known);
    }

    bool
    is_zero(const std::string &expression)
    {
      return number_in(expression).value_or(1.) == 0.;
    }

    const std::string motion_advice =
      "write \"NAME = velocity A; B; C\" [m/s] or \"NAME = rotation X Y Z; AX AY AZ; "
      "OMEGA\" (a point on the axis [m], its direction, the angular speed [rad/s]), "
      "with bars (|) between";

    // Moves by "velocity A; B; C", if it may.
    void
    set_velocity(const unsigned int w, const std::vector<std::string> &parts, Wall &wall)
    {
      const std::string parameter = "Walls/motion";
      require(
        parts.size() == 3, parameter, "a velocity has three parts: " + motion_advice);
      require(!wall.course.has_velocity(),
              parameter,
              "\"" + wall.name + "\" has a velocity already");
      const bool along_axis = is_zero(parts[0]) && is_zero(parts[1]);
      require(w != lateral_wall || along_axis,
              parameter,
              "the lateral wall moves along itself only: \"wall = velocity 0; 0; C\"");
      require((w != bottom_wall && w != top_wall) || is_zero(parts[2]),
              parameter,
              "the ends move along themselves only: \"" + wall.name +
                " = velocity A; B; 0\". A floor that rises is one of Walls/planes");
      wall.course.set_velocity(parts);
    }

    // Turns by "rotation X Y Z; AX AY AZ; OMEGA", if it may.
    void
    set_rotation(const unsigned int w, const std::vector<std::string> &parts, Wall &wall)
    {
      const std::string parameter = "Walls/motion";
      require(
        parts.size() == 3, parameter, "a rotation has three parts: " + motion_advice);
      const auto point     = read_numbers(parameter, parts[0]);
      const auto direction = read_numbers(parameter, parts[1]);
      require(point.size() == 3 && direction.size() == 3,
              parameter,
              "a point and a direction have three numbers each: " + motion_advice);
      Triple<double> axis   = three_numbers(direction, 0);
      const double   length = axis.norm();
      require(length > 0., parameter, "the direction of an axis cannot be zero");
      axis *= 1. / length;
      require(!wall.course.has_rotation(),
              parameter,
              "\"" + wall.name + "\" has a rotation already");
      const bool upright = axis.x == 0. && axis.y == 0.;
      require(w > top_wall || upright,
              parameter,
              "the cylinder and its ends turn about its axis only, \"0 0 1\"");
      require(w != lateral_wall || (point[0] == 0. && point[1] == 0.),
              parameter,
              "the lateral wall turns about its own axis only, through \"0 0 0\"");
      wall.course.set_rotation(three_numbers(point, 0), axis, parts[2]);
    }
  } // namespace

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
      "Further plane walls, separated by commas; each a name and a colon (without: plane "
      "1, plane 2, ...), a point [m], the normal out of the vessel and, for a plane that "
      "moves from the start, a velocity [m/s]: six or nine numbers, as in \"floor: 0 0 "
      "0.003 0 0 -1\".");
    prm.add_parameter(
      "surfaces",
      surfaces,
      "STL files of further walls, separated by commas; each with a name and a colon in "
      "front, as in \"drum: drum.stl\", or named as the file.",
      dealii::Patterns::List(dealii::Patterns::FileName()));
    prm.add_parameter("from mesh",
                      from_mesh,
                      "Whether the flat boundaries of Mesh/file are planes for particles "
                      "too, with the names of the boundaries.");
    prm.add_parameter("surface unit",
                      surface_unit,
                      "Length of the unit of the STL files, which name none [m].");
    prm.add_parameter(
      "containers",
      containers,
      "Names of the closed surfaces that hold the particles, separated by commas; the "
      "inside of any other closed surface is solid.");
    declare_courses(prm);
    prm.leave_subsection();
  }

  void
  WallParameters::declare_courses(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "motion",
      motion,
      "How walls move while fluid flows, separated by bars (|): \"NAME = velocity A; B; "
      "C\" in m/s, or \"NAME = rotation X Y Z; AX AY AZ; OMEGA\" with a point on the "
      "axis in m, its direction and the angular speed in rad/s. Expressions may hold t, "
      "the time of the flow in s, and pi. Before the flow these walls stand still. The "
      "cylinder (wall) and its ends move along themselves only.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "gates",
      gates,
      "Walls that are there for a part of the time only, separated by commas: \"NAME "
      "until T\", \"NAME from T\" with the time of the flow in s, or \"NAME until "
      "settled\" for one that is gone when the flow begins.",
      dealii::Patterns::Anything());
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
    outline({});
  }

  std::vector<std::string>
  WallParameters::names() const
  {
    std::vector<std::string> result;
    for (const Wall &wall : outline({}))
      result.push_back(wall.name);
    return result;
  }

  std::vector<Wall>
  WallParameters::outline(const Cylinder &cylinder) const
  {
    std::vector<Wall> walls = vessel_walls(cylinder);
    if (bottom != "closed")
      walls[bottom_wall].shape = NoWall{};
    if (top != "closed")
      walls[top_wall].shape = NoWall{};

    std::set<std::string> taken{"wall", "bottom", "top"};
    const auto            add = [&](const std::string &parameter, Wall wall) {
      check_name(wall.name, parameter, taken);
      taken.insert(wall.name);
      walls.push_back(std::move(wall));
    };
    unsigned int number = 0;
    for (const auto &text : split_string_list(planes))
      {
        ++number;
        auto entry = split_name(text);
        if (text.find(':') == std::string::npos)
          entry.name = "plane " + std::to_string(number);
        add("Walls/planes", read_plane(entry));
      }
    const auto first_surface = walls.size();
    for (const auto &text : split_string_list(surfaces))
      {
        auto entry = split_name(text);
        if (text.find(':') == std::string::npos)
          entry.name = entry.text;
        add("Walls/surfaces", {entry.name, NoWall{}});
      }
    require(walls.size() <= most_walls,
            "Walls/planes",
            "a vessel has at most " + std::to_string(most_walls) + " walls");

    for (const auto &name : split_string_list(containers))
      require(number_of(name, walls, "Walls/containers") >= first_surface,
              "Walls/containers",
              "\"" + name + "\" is none of Walls/surfaces");
    for (const auto &entry : split_string_list(motion, '|'))
      set_course(entry, walls);
    for (const auto &entry : split_string_list(gates))
      set_gate(entry, walls);
    return walls;
  }

  void
  WallParameters::set_course(const std::string &entry, std::vector<Wall> &walls) const
  {
    const std::string parameter = "Walls/motion";
    const auto        equals    = entry.find('=');
    require(equals != std::string::npos,
            parameter,
            "\"" + entry + "\" is no motion: " + motion_advice);
    const auto name = trim(entry.substr(0, equals));
    const auto how  = trim(entry.substr(equals + 1));
    const auto w    = number_of(name, walls, parameter);
    require((w != bottom_wall || bottom == "closed") &&
              (w != top_wall || top == "closed"),
            parameter,
            "the " + name + " is not closed; there is no wall that could move");

    const auto word  = how.substr(0, how.find(' '));
    const auto parts = split_string_list(how.substr(word.size()), ';');
    require(word == "velocity" || word == "rotation",
            parameter,
            "\"" + how + "\" is no motion: " + motion_advice);
    word == "velocity" ? set_velocity(w, parts, walls[w])
                       : set_rotation(w, parts, walls[w]);
  }

  void
  WallParameters::set_gate(const std::string &entry, std::vector<Wall> &walls) const
  {
    const std::string parameter = "Walls/gates";
    const auto        from = entry.rfind(" from "), until = entry.rfind(" until ");
    require((from == std::string::npos) != (until == std::string::npos),
            parameter,
            "\"" + entry +
              "\" is no gate: write \"NAME until T\", \"NAME from T\" (in seconds) or "
              "\"NAME until settled\", with commas between");
    const bool comes = from != std::string::npos;
    const auto at    = comes ? from : until;
    const auto time  = trim(entry.substr(at + (comes ? 6 : 7)));
    const auto w     = number_of(trim(entry.substr(0, at)), walls, parameter);
    require(w > top_wall,
            parameter,
            "the cylinder and its ends are always there; make the gate one of "
            "Walls/planes or Walls/surfaces");

    auto        &course  = walls[w].course;
    const double endless = std::numeric_limits<double>::infinity();
    require((comes ? course.from : course.until) == (comes ? -endless : endless),
            parameter,
            "\"" + walls[w].name + "\" " + (comes ? "comes" : "goes") + " twice");
    if (time == "settled" && !comes)
      course.until = 0.;
    else
      (comes ? course.from : course.until) = read_number(parameter, time);
    require(time == "settled" || (comes ? course.from : course.until) >= 0.,
            parameter,
            "the flow begins at 0 s; \"NAME until settled\" is gone by then");
    require(course.from != course.until,
            parameter,
            "\"" + walls[w].name + "\" comes as it goes");
  }

  std::vector<Wall>
  WallParameters::walls(const Cylinder &cylinder) const
  {
    std::vector<Wall> walls      = outline(cylinder);
    const auto        containing = split_string_list(containers);
    auto              wall       = walls.end() - split_string_list(surfaces).size();
    for (const auto &text : split_string_list(surfaces))
      {
        SurfaceWall surface{SurfaceMesh::read_stl(split_name(text).text, surface_unit)};
        surface.is_container =
          std::count(containing.begin(), containing.end(), wall->name) > 0;
        require(!surface.is_container || surface.mesh.is_closed(),
                "Walls/containers",
                "the surface \"" + wall->name +
                  "\" is not closed, so that it has no inside: " +
                  std::to_string(surface.mesh.n_free_edges()) +
                  " of its edges belong to one triangle only");
        wall->shape = std::move(surface);
        ++wall;
      }
    for (Wall &each : walls)
      each.look_at({});
    return walls;
  }
} // namespace graupel
