// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The Graupel authors

#include <graupel/base/parameter_entries.h>
#include <graupel/base/parameters.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <unistd.h>

using namespace graupel;

namespace
{
  // A handler with one entry of each kind, as the rooms declare them.
  struct Declared
  {
    Declared()
    {
      handler.enter_subsection("Geometry");
      handler.add_parameter("diameter", diameter, "Inner diameter [m].");
      handler.add_parameter("layers", layers, "Layers of cells [-].");
      handler.leave_subsection();
      handler.enter_subsection("Coupling");
      handler.add_parameter("scaling",
                            scaling,
                            "Form.",
                            dealii::Patterns::Selection("exact|expression|none"));
      handler.enter_subsection("Filter");
      handler.add_parameter("length", length, "Length [m].");
      handler.add_parameter("velocities", velocities, "Flow cases [m/s].");
      handler.leave_subsection();
      handler.leave_subsection();
      handler.enter_subsection("Output");
      handler.add_parameter("name", name, "Any text.", dealii::Patterns::Anything());
      handler.leave_subsection();
    }

    dealii::ParameterHandler handler;
    double                   diameter = 0.025;
    unsigned int             layers   = 4;
    std::string              scaling  = "exact";
    double                   length   = 1.6e-3;
    std::vector<double>      velocities{0.271};
    std::string              name = "output";
  };

  // What the user reads when @p text is in the file case.prm; "" if all is well.
  std::string
  complaint(const std::string &text)
  {
    Declared           declared;
    ParameterFile      file(declared.handler);
    std::istringstream stream(text);
    try
      {
        file.read(stream, "case.prm");
      }
    catch (const InputError &error)
      {
        return file.explain(error);
      }
    return "";
  }

  std::string
  complaint_about_override(const std::string &assignment)
  {
    Declared      declared;
    ParameterFile file(declared.handler);
    try
      {
        file.set(assignment);
      }
    catch (const InputError &error)
      {
        return file.explain(error);
      }
    return "";
  }

  class Files : public testing::Test
  {
  protected:
    Files()
      : folder(std::filesystem::temp_directory_path() /
               ("graupel-test-" + std::to_string(::getpid())))
    {
      std::filesystem::create_directories(folder / "parts");
    }

    ~Files() override
    {
      std::filesystem::remove_all(folder);
    }

    std::string
    write(const std::string &name, const std::string &text) const
    {
      std::ofstream(folder / name) << text;
      return (folder / name).string();
    }

    const std::filesystem::path folder;
  };
} // namespace

TEST(ParameterFile, ReachesTheBoundMembers)
{
  Declared           declared;
  ParameterFile      file(declared.handler);
  std::istringstream stream("# a comment\n"
                            "subsection Geometry\r\n"
                            "  set diameter = 0.05  # [m]\n"
                            "\tset   layers=7\n"
                            "end\n"
                            "subsection Coupling\n"
                            "  subsection Filter\n"
                            "    set velocities = 0.1, \\\n"
                            "                     0.2\n"
                            "  end\n"
                            "  SET scaling = none\n"
                            "end");
  file.read(stream, "case.prm");
  EXPECT_EQ(declared.diameter, 0.05);
  EXPECT_EQ(declared.layers, 7u);
  EXPECT_EQ(declared.scaling, "none");
  EXPECT_EQ(declared.velocities, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(declared.length, 1.6e-3);

  file.set(" Coupling/Filter/length = 3.2e-3 ");
  EXPECT_EQ(declared.length, 3.2e-3);
}

TEST(ParameterFile, KnowsEveryDeclaredPath)
{
  Declared declared;
  EXPECT_EQ(ParameterFile(declared.handler).known_parameters(),
            (std::vector<std::string>{"Coupling/Filter/length",
                                      "Coupling/Filter/velocities",
                                      "Coupling/scaling",
                                      "Geometry/diameter",
                                      "Geometry/layers",
                                      "Output/name"}));
}

TEST(ParameterFile, TellsEveryValueAsText)
{
  Declared      declared;
  ParameterFile file(declared.handler);
  file.set("Geometry/diameter=5e-2");
  EXPECT_EQ(file.texts(),
            (std::map<std::string, std::string>{{"Coupling/Filter/length", "0.0016"},
                                                {"Coupling/Filter/velocities", "0.271"},
                                                {"Coupling/scaling", "exact"},
                                                {"Geometry/diameter", "5e-2"},
                                                {"Geometry/layers", "4"},
                                                {"Output/name", "output"}}));
}

TEST(ParameterFile, SaysWhereAValueCameFrom)
{
  Declared      declared;
  ParameterFile file(declared.handler);
  const auto    explained = [&file]() {
    return file.explain(InputError("Geometry/diameter", "no bed fits"));
  };
  EXPECT_EQ(explained(), "Geometry/diameter = 0.025 (the default): no bed fits");

  // A continued line above shifts no number: a statement counts by its first line.
  std::istringstream stream("\n"
                            "subsection \\\n Geometry\n"
                            "set diameter = \\\n 0.0015\n"
                            "end\n");
  file.read(stream, "case.prm");
  EXPECT_EQ(explained(), "case.prm:4: Geometry/diameter = 0.0015: no bed fits");

  file.set("Geometry/diameter=0.0014");
  EXPECT_EQ(explained(), "--set: Geometry/diameter = 0.0014: no bed fits");

  EXPECT_EQ(file.explain(InputError("Time/end", "is before the start")),
            "Time/end: is before the start");
}

TEST(ParameterFile, ABackslashWithinACommentContinuesNothing)
{
  Declared           declared;
  ParameterFile      file(declared.handler);
  std::istringstream stream("subsection Geometry\n"
                            "  # in the folder C:\\beds\\\n"
                            "  set diameter = 0.05\n"
                            "  set layers = 7 # as in C:\\beds\\\n"
                            "end\n"
                            "subsection Coupling\n"
                            "  set scaling = none\n"
                            "  subsection Filter\n"
                            "    set velocities = 0.1, \\  # the first\n"
                            "                     0.2, \\ \n"
                            "                     0.3    # the last \\\n"
                            "    set length = 2e-3\n"
                            "  end\n"
                            "end\n");
  file.read(stream, "case.prm");
  EXPECT_EQ(declared.diameter, 0.05);
  EXPECT_EQ(declared.layers, 7u);
  EXPECT_EQ(declared.scaling, "none");
  EXPECT_EQ(declared.velocities, (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(declared.length, 2e-3);
}

TEST(ParameterFile, ACommentBeginsBehindABlank)
{
  const auto name_from = [](const std::string &value) {
    Declared           declared;
    ParameterFile      file(declared.handler);
    std::istringstream stream("subsection Output\nset name = " + value + "\nend\n");
    file.read(stream, "case.prm");
    return declared.name;
  };
  EXPECT_EQ(name_from("run#1"), "run#1");
  EXPECT_EQ(name_from("run#1 # the first"), "run#1");
  EXPECT_EQ(name_from("run\t#1"), "run");
  EXPECT_EQ(name_from("#1"), "");
  EXPECT_EQ(complaint("subsection Geometry\nset layers = 3#\nend\n"),
            "case.prm:2: Geometry/layers = 3#: expected a whole number, 0 or more");
}

// What the program writes into the directory of a run repeats the run.
TEST(ParameterFile, ReadsWhatIsPrinted)
{
  for (const std::string name : {"run#1",
                                 "a;b; c",
                                 "a = b",
                                 "= b",
                                 "a##b",
                                 "back\\slash",
                                 "two  blanks",
                                 "end",
                                 "plane 1",
                                 ""})
    {
      Declared      written;
      ParameterFile file(written.handler);
      file.set("Output/name=" + name);
      file.set("Geometry/diameter=0.0123456789012345678");
      file.set("Coupling/Filter/velocities=0.1, 1e-7");
      std::stringstream text;
      written.handler.print_parameters(text,
                                       dealii::ParameterHandler::PRM |
                                         dealii::ParameterHandler::KeepDeclarationOrder);

      Declared declared;
      ParameterFile(declared.handler).read(text, "parameters.prm");
      EXPECT_EQ(written.name, name);
      EXPECT_EQ(declared.name, name);
      EXPECT_EQ(declared.diameter, written.diameter);
      EXPECT_EQ(declared.velocities, written.velocities);
    }
}

// As deal.II writes them, and as a script would.
TEST_F(Files, JsonAndXmlHoldWhatAFileHolds)
{
  Declared           written;
  ParameterFile      from(written.handler);
  std::istringstream stream("subsection Geometry\nset diameter = 0.05\nend\n"
                            "subsection Coupling\nsubsection Filter\nset length = 0.002\n"
                            "end\nend\nsubsection Output\nset name = a b\nend\n");
  from.read(stream, "case.prm");
  using Handler = dealii::ParameterHandler;
  const std::vector<std::pair<std::string, int>> forms{
    {"long.json", Handler::JSON | Handler::KeepDeclarationOrder},
    {"short.json", Handler::ShortJSON},
    {"long.xml", Handler::XML},
    {"short.xml", Handler::ShortXML}};
  for (const auto &[name, form] : forms)
    {
      std::ostringstream text;
      written.handler.print_parameters(text, Handler::OutputStyle(form));
      Declared      read;
      ParameterFile file(read.handler);
      file.read(write(name, text.str()));
      EXPECT_EQ(file.texts(), from.texts()) << name;
      EXPECT_EQ(read.diameter, 0.05) << name;
    }

  Declared      own;
  ParameterFile file(own.handler);
  const auto path = write("own.json", R"({"Geometry": {"diameter": -1, "layers": "7"}})");
  file.read(path);
  EXPECT_EQ(own.layers, 7u);
  EXPECT_EQ(file.explain(InputError("Geometry/diameter", "must be above 0")),
            path + ":Geometry/diameter: Geometry/diameter = -1: must be above 0");

  const auto complaint_about = [&](const std::string &name, const std::string &text) {
    Declared      declared;
    ParameterFile bad(declared.handler);
    try
      {
        bad.read(write(name, text));
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  for (const auto &[name, text, said] : std::vector<std::array<std::string, 3>>{
         {"a.json", R"({"Geometry": {"diametre": 1}})", "diametre"},
         {"b.json", R"({"Geometry": {"layers": "many"}})", "many"},
         {"c.json", R"({"Geometry": )", "no parameter file"},
         {"d.xml",
          "<ParameterHandler><Geometry></ParameterHandler>",
          "no parameter file"},
         {"e.xml", "", "no parameter file"}})
    {
      const std::string found = complaint_about(name, text);
      EXPECT_NE(found.find(said), std::string::npos) << name << ": " << found;
      EXPECT_EQ(found.rfind((folder / name).string(), 0), 0u) << found;
    }
}

TEST(ParameterFile, RefusesWhatNoFileCanHold)
{
  for (const std::string name : {"a #1", "a\t#1", "#1", "a\\", "a\nb"})
    EXPECT_NE(complaint_about_override("Output/name=" + name)
                .find("--set: Output/name = " + name + ": no parameter file can hold"),
              std::string::npos)
      << complaint_about_override("Output/name=" + name);
}

TEST(ParameterFile, TheLaterSettingWins)
{
  Declared           declared;
  ParameterFile      file(declared.handler);
  std::istringstream stream("subsection Geometry\nset layers = 3\nset layers = 5\nend\n"
                            "subsection Geometry\nset layers = 4\nend\n");
  file.read(stream, "case.prm");
  EXPECT_EQ(declared.layers, 4u);
}

TEST(ParameterFile, ProposesTheNearestName)
{
  EXPECT_EQ(complaint("subsection Geometri\nset diameter = 1\nend\n"),
            "case.prm:2: there is no parameter \"Geometri/diameter\"; did you mean "
            "\"Geometry/diameter\"?");
  EXPECT_EQ(complaint("set scaling = exact\n"),
            "case.prm:1: there is no parameter \"scaling\"; did you mean "
            "\"Coupling/scaling\"?");
  EXPECT_EQ(complaint("subsection Geometri\nend\n"),
            "case.prm:1: there is no section \"Geometri\"; did you mean \"Geometry\"?");
  EXPECT_EQ(complaint_about_override("Geometry/layer=3"),
            "--set: there is no parameter \"Geometry/layer\"; did you mean "
            "\"Geometry/layers\"?");
}

TEST(ParameterFile, SaysWhatAValueMustBe)
{
  const auto in_geometry = [](const std::string &line) {
    return complaint("subsection Geometry\n" + line + "\nend\n");
  };
  EXPECT_EQ(in_geometry("set diameter = wide"),
            "case.prm:2: Geometry/diameter = wide: expected a number");
  EXPECT_EQ(in_geometry("set diameter = nan"),
            "case.prm:2: Geometry/diameter = nan: expected a number");
  EXPECT_EQ(in_geometry("set diameter = inf"),
            "case.prm:2: Geometry/diameter = inf: expected a number");
  EXPECT_EQ(in_geometry("set diameter = 1e400"),
            "case.prm:2: Geometry/diameter = 1e400: expected a number");
  EXPECT_EQ(in_geometry("set layers = 5000000000"),
            "case.prm:2: Geometry/layers = 5000000000: expected a whole number, 0 or "
            "more");
  EXPECT_EQ(complaint_about_override("Coupling/Filter/velocities=0.1, nan"),
            "--set: Coupling/Filter/velocities = 0.1, nan: expected a list separated by "
            "\",\", each element a number");
  EXPECT_EQ(in_geometry("set diameter = 0,025"),
            "case.prm:2: Geometry/diameter = 0,025: expected a number");
  EXPECT_EQ(in_geometry("set diameter = 0.025 m"),
            "case.prm:2: Geometry/diameter = 0.025 m: expected a number");
  EXPECT_EQ(in_geometry("set diameter ="),
            "case.prm:2: Geometry/diameter = : expected a number");
  EXPECT_EQ(in_geometry("set layers = -3"),
            "case.prm:2: Geometry/layers = -3: expected a whole number, 0 or more");
  EXPECT_EQ(in_geometry("set layers = 2.5"),
            "case.prm:2: Geometry/layers = 2.5: expected a whole number, 0 or more");
  EXPECT_EQ(complaint_about_override("Coupling/scaling = Exact"),
            "--set: Coupling/scaling = Exact: expected one of exact | expression | none");
  EXPECT_EQ(complaint_about_override("Coupling/Filter/velocities = 0.1; 0.2"),
            "--set: Coupling/Filter/velocities = 0.1; 0.2: expected a list separated by "
            "\",\", each element a number");
}

TEST(ParameterFile, RefusesWhatIsNoStatement)
{
  EXPECT_EQ(
    complaint("subsection Geometry\n"
              "subsection Mesh\nend\n"),
    "case.prm:2: there is no section \"Geometry/Mesh\"; did you mean \"Geometry\"?");
  EXPECT_EQ(
    complaint("subsection Geometry\nset layers = 3\n"),
    "case.prm:1: the section \"Geometry\" has no \"end\" before the end of the file");
  EXPECT_EQ(complaint("subsection Geometry\nend\nend\n"),
            "case.prm:3: this \"end\" closes no section of this file");
  EXPECT_EQ(complaint("subsection Geometry\nset layers 3\nend\n"),
            "case.prm:2: \"set layers 3\" gives no value; write \"set name = value\"");
  const std::string expected = " is no statement; expected \"set name = value\", "
                               "\"subsection NAME\", \"end\", \"include FILE\" or a "
                               "comment after #";
  EXPECT_EQ(complaint("diameter = 3\n"), "case.prm:1: \"diameter = 3\"" + expected);
  EXPECT_EQ(complaint("\n\nsubsection\n"), "case.prm:3: \"subsection\"" + expected);
  EXPECT_EQ(complaint("// set\n"), "case.prm:1: \"// set\"" + expected);
  EXPECT_EQ(complaint_about_override("Geometry/layers"),
            "--set: expected \"Section/name=value\", not \"Geometry/layers\"");
}

TEST_F(Files, IncludeStartsFromTheIncludingFile)
{
  write("parts/layers.prm", "set layers = 9\n");
  write("parts/geometry.prm", "subsection Geometry\n\n  include layers.prm\nend\n");
  const std::string main = write("main.prm",
                                 "include parts/geometry.prm\n"
                                 "subsection Geometry\nset diameter = 1\nend\n");
  Declared          declared;
  ParameterFile     file(declared.handler);
  file.read(main);
  EXPECT_EQ(declared.layers, 9u);
  EXPECT_EQ(declared.diameter, 1.);
  EXPECT_EQ(file.explain(InputError("Geometry/layers", "too many")),
            (folder / "parts/layers.prm").string() + ":1: Geometry/layers = 9: too many");
}

TEST_F(Files, UnreadableFilesAreNamed)
{
  Declared      declared;
  ParameterFile file(declared.handler);
  const auto    sentence = [&file](const std::string &name) -> std::string {
    try
      {
        file.read(name);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "";
  };
  EXPECT_EQ(sentence("no-such.prm"),
            "no-such.prm: cannot read this parameter file; is the path right?");
  EXPECT_EQ(sentence(folder.string()),
            folder.string() + ": cannot read this parameter file; is the path right?");

  const std::string lost = write("lost.prm", "\ninclude gone.prm\n");
  EXPECT_EQ(sentence(lost),
            lost + ":2: cannot read the included file \"" +
              (folder / "gone.prm").string() + "\"; is the path right?");

  const std::string circle = write("circle.prm", "include circle.prm\n");
  EXPECT_EQ(sentence(circle),
            circle + ":1: the included file \"" + circle +
              "\" is still being read: files include each other in a circle");

  // The same file by other paths.
  for (const std::string path : {"./again.prm", "parts/../again.prm", "parts/link.prm"})
    {
      const std::string again = write("again.prm", "\ninclude " + path + "\n");
      std::filesystem::remove(folder / "parts/link.prm");
      std::filesystem::create_symlink(again, folder / "parts/link.prm");
      EXPECT_EQ(sentence(again),
                again + ":2: the included file \"" + (folder / path).string() +
                  "\" is still being read: files include each other in a circle");
    }
  // What is no file, and would not end.
  for (const std::string path : {"parts", "/dev/zero", "/dev/null"})
    {
      const std::string odd = write("odd.prm", "include " + path + "\n");
      EXPECT_EQ(sentence(odd),
                odd + ":1: cannot read the included file \"" + (folder / path).string() +
                  "\"; is the path right?");
    }

  const std::string open = write("open.prm", "subsection Geometry\n");
  EXPECT_EQ(sentence(write("opens.prm", "include open.prm\nend\n")),
            open +
              ":1: the section \"Geometry\" has no \"end\" before the end of the file");
}

TEST(Require, FailsOnNaN)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(require(1. > 0., "Geometry/diameter", "positive"));
  try
    {
      require(nan > 0., "Geometry/diameter", "a length is positive");
      ADD_FAILURE() << "a NaN passed";
    }
  catch (const InputError &error)
    {
      EXPECT_EQ(error.parameter, "Geometry/diameter");
      EXPECT_STREQ(error.what(), "Geometry/diameter: a length is positive");
    }
}

TEST(NumberOrWord, TakesNoOtherWord)
{
  EXPECT_EQ(number_or_word("A/b", "auto", {"auto"}), std::nullopt);
  EXPECT_EQ(number_or_word("A/b", "1e-3", {"auto"}), 1e-3);
  for (const char *text : {"nan", "inf", "-inf", "1e-3 m", "", "Auto"})
    EXPECT_THROW(number_or_word("A/b", text, {"auto"}), InputError) << text;
}

TEST(NearestName, HasTheLeastEditDistance)
{
  const std::vector<std::string> known{"abcd", "axcd", "kitten"};
  EXPECT_EQ(nearest_name("abcd", known), "abcd");
  EXPECT_EQ(nearest_name("acd", {"abxd", "axcd"}), "axcd"); // 1 against 2
  EXPECT_EQ(nearest_name("abcd", {"wxyd", "ab"}), "ab");    // 2 against 3
  EXPECT_EQ(nearest_name("sitting", known), "kitten");
  EXPECT_EQ(nearest_name("", known), "abcd");
  EXPECT_EQ(nearest_name("anything", {}), "");
}

TEST(ParameterEntries, NumbersNeedAUnit)
{
  dealii::ParameterHandler handler;
  Declared                 declared;
  EXPECT_EQ(entries_without_unit(declared.handler), std::vector<std::string>{});

  double              real  = 0.;
  unsigned int        whole = 0;
  bool                flag  = false;
  std::string         text;
  std::vector<double> list;
  handler.enter_subsection("A");
  handler.add_parameter("bare", real, "Length.");
  handler.add_parameter("brackets inside", real, "A length [m] of something.");
  handler.add_parameter("count", whole, "A count.");
  handler.add_parameter("empty brackets", real, "A length [ ].");
  handler.add_parameter("flag", flag, "A switch.");
  handler.add_parameter("list", list, "Many lengths.");
  handler.add_parameter("text", text, "A name.");
  handler.add_parameter("unit", real, "A length\nover two lines [kg/m^3].");
  handler.leave_subsection();
  EXPECT_EQ(entries_without_unit(handler),
            (std::vector<std::string>{
              "A/bare", "A/brackets inside", "A/count", "A/empty brackets", "A/list"}));
}

TEST(ParameterEntries, PatternsHaveWords)
{
  using namespace dealii::Patterns;
  EXPECT_EQ(expected_by(Bool().description()), "true or false");
  EXPECT_EQ(expected_by(Double(0., 1.).description()), "a number from 0 to 1");
  EXPECT_EQ(expected_by(Double(0.).description()), "a number, 0 or more");
  EXPECT_EQ(expected_by(Integer(2).description()), "a whole number, 2 or more");
  EXPECT_EQ(expected_by(Integer().description()), "a whole number");
  EXPECT_EQ(expected_by(Selection("a|b|c").description()), "one of a | b | c");
  EXPECT_EQ(expected_by(MultipleSelection("a|b").description()),
            "any of a | b, separated by commas");
  EXPECT_EQ(expected_by(List(Double(0.), 0, 5, ";").description()),
            "a list separated by \";\", each element a number, 0 or more");
}
