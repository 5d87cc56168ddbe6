#include <graupel/base/parameters.h>
#include <graupel/simulation/observers/probes.h>

#include <deal.II/base/utilities.h>
#include <deal.II/numerics/vector_tools_evaluate.h>

#include <set>
#include <sstream>

namespace graupel
{
  namespace
  {
    const char *const parameter = "Output/probes";

    // In cells, within which a point on the vessel's wall is found still.
    constexpr double tolerance = 1e-6;

    ProbePoint
    read_probe(const std::string &text)
    {
      const auto         colon = text.find(':');
      ProbePoint         point;
      std::istringstream numbers(colon == std::string::npos ? ""
                                                            : text.substr(colon + 1));
      require(numbers >> point.place[0] >> point.place[1] >> point.place[2] &&
                (numbers >> std::ws).eof(),
              parameter,
              "\"" + text +
                "\" is not a probe: write NAME: x y z, a name and three numbers in "
                "metres; probes are separated by bars (|)");
      point.name = dealii::Utilities::trim(text.substr(0, colon));
      require(!point.name.empty() &&
                point.name.find_first_of(",\" ") == std::string::npos,
              parameter,
              "a probe needs a name without blanks, commas or quotes, for its columns");
      return point;
    }
  } // namespace

  std::vector<ProbePoint>
  read_probes(const std::string &text)
  {
    std::vector<ProbePoint> points;
    std::set<std::string>   names;
    for (const auto &entry : dealii::Utilities::split_string_list(text, '|'))
      {
        points.push_back(read_probe(entry));
        require(names.insert(points.back().name).second,
                parameter,
                "there are two probes named " + points.back().name);
      }
    return points;
  }

  Probes::Probes(const std::vector<ProbePoint> &points)
    : points(points)
    , places(tolerance)
  {
  }

  std::string
  Probes::header() const
  {
    std::string text = "time";
    for (const ProbePoint &point : points)
      for (const char *quantity :
           {"pressure", "void_fraction", "velocity_x", "velocity_y", "velocity_z"})
        text += "," + point.name + "_" + quantity;
    return text;
  }

  void
  Probes::find_points(const VesselMesh &mesh)
  {
    std::vector<dealii::Point<3>> wanted;
    if (dealii::Utilities::MPI::this_mpi_process(mesh.communicator()) == 0)
      for (const ProbePoint &point : points)
        wanted.push_back(point.place);
    places.reinit(wanted, mesh.triangulation(), mesh.mapping());
    std::string outside;
    for (unsigned int n = 0; n < wanted.size(); ++n)
      if (!places.point_found(n))
        outside = points[n].name;
    outside = dealii::Utilities::MPI::broadcast(mesh.communicator(), outside, 0);
    require(
      outside.empty(), parameter, "the probe " + outside + " lies outside the mesh");
  }

  std::string
  Probes::row(const SimulationState &state)
  {
    if (!places.is_ready())
      find_points(state.mesh);
    const CoupledFlow &fluid = *state.fluid;
    const auto         at    = [&](const NodalVector &field) {
      return dealii::VectorTools::point_values<1>(
        places, fluid.nodes().dof_handler, field);
    };
    const auto pressure = at(fluid.fluid().pressure());
    const auto alpha    = at(fluid.exchange().medium().void_fraction);
    std::array<std::vector<double>, 3> flux;
    for (unsigned int i = 0; i < 3; ++i)
      flux[i] = at(fluid.fluid().flux()[i]);

    std::ostringstream text;
    text << std::setprecision(10) << state.time;
    for (unsigned int n = 0; n < alpha.size(); ++n)
      {
        text << ',' << pressure[n] << ',' << alpha[n];
        for (unsigned int i = 0; i < 3; ++i)
          text << ',' << flux[i][n] / alpha[n];
      }
    return text.str();
  }
} // namespace graupel
