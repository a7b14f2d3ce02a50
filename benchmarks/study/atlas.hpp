#pragma once
/// An atlas: a case over the product of some axes, such as step, Poisson's ratio and disorder, with
/// both methods; each point is stable, stopped with its cause, or wrong. One TOML file of
/// benchmarks/atlas, or of the user, says what is run:
///
///   title, text               what it shows
///   case                      a shipped case, or a path (relative to this file)
///   methods, set              sph, fvm (default both); "key=value" of every point, in place of
///                             which come those of --set
///   holds                     bounds beyond those of the guards and of the case (see judged)
///   columns                   names of the axes that run across in the picture, the others down
///   [[axis]]                  name, and key with values; or
///   [[axis.choice]]           name, set ("key=value"); methods that have it; a case of its own
///
/// With --coarse an axis has its first and last value, or those of its `coarse`; a list of choices
/// those with coarse = true. Tests: tests/harness/atlas_file_test.cpp,
/// tests/harness/atlas_test.cpp, tests/command_line/atlas_test.cpp

#include "benchmarks/run/judgement.hpp"

#include <optional>
#include <string>
#include <vector>

namespace diptych::harness {

struct AtlasChoice {
  std::string name;                  ///< "0.45", "box tetrahedra"
  std::vector<std::string> set;      ///< "key=value"
  std::vector<std::string> methods;  ///< that have it
  std::string case_file;             ///< empty: that of the atlas
  bool is_coarse = true;             ///< part of the coarse map
};

struct AtlasAxis {
  std::string name;
  std::vector<AtlasChoice> choices;
};

struct Atlas {
  std::string name, file, title, text, case_file;
  std::vector<std::string> methods, set, columns;
  std::vector<cases::BoundCase> holds;
  std::vector<AtlasAxis> axes;
};

/// @param cases_folder  of names of cases, see find_case
/// @throws base::InputError with file:line:column
Atlas read_atlas(const std::string& path, const std::string& cases_folder = {});

/// Path of an atlas: a file, or the name of a shipped one. @throws base::InputError
std::string find_atlas(const std::string& word);

/// One run: a method and a choice on each axis.
struct AtlasPoint {
  std::string method;
  std::vector<size_t> choices;    ///< on each axis
  Judgement judgement;            ///< once it has been made
  std::optional<Outcome> before;  ///< of an earlier program
  io::RunSummary run;
  double kinetic_growth = 0;  ///< NaN where the body starts at rest
};

/// All points of a method: those of its choices, the last axis fastest.
std::vector<AtlasPoint> points_of(const Atlas& atlas, const std::string& method, bool coarse);

/// Names of the choices of a point.
std::vector<std::string> settings_of(const Atlas& atlas, const AtlasPoint& point);

struct AtlasMap {
  Atlas atlas;
  std::vector<AtlasPoint> points;  ///< those that are known
  size_t n_planned = 0;
  double seconds = 0;  ///< of all runs, whenever they were made
  std::string program, commit, date;
};

/// One of the maps: letters by method, points that are wrong or were stopped by their cause, and,
/// where an earlier map is known, how many points went from what to what.
std::string atlas_text(const AtlasMap& map);
std::string atlas_csv(const AtlasMap& map);
std::string atlas_json(const AtlasMap& map);
std::string atlas_html(const AtlasMap& map);

/// Gives the points of a map what an earlier one says of them.
/// @param json  of atlas_json
/// @return how many it knows
/// @throws base::InputError where it is none
size_t set_before(AtlasMap& map, const std::string& json, const std::string& path);

struct AtlasRequest {
  std::string atlas, cases_folder;  ///< see find_atlas, find_case
  std::vector<std::string> overrides, methods;
  int level = 0, threads = 0;
  std::string directory;  ///< empty: results/NAME
  std::string before;     ///< atlas.json of an earlier program; empty: none
  bool coarse = false, fresh = false, quiet = false, force = false;
};

/// Runs what is not there yet, prints the map, writes DIR/atlas.html, .csv and .json, also after an
/// interrupt, of what is known then. Runs are kept in DIR/runs; those that ended or were stopped
/// there are not made again by the same program.
/// @return the folder
std::string make_atlas(const AtlasRequest& request);

}  // namespace diptych::harness
