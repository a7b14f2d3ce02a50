/// An atlas as text, CSV, JSON and a page; and what an earlier one says of its points.

#include "benchmarks/study/atlas.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "benchmarks/terminal/text.hpp"
#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "postprocess/report/atlas_page.hpp"
#include "postprocess/report/orders.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string_view>

namespace diptych::harness {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array outcomes{Outcome::stable, Outcome::stopped, Outcome::wrong, Outcome::refused,
                              Outcome::unfinished};

char letter_of(Outcome outcome) {
  return ".SW-U"[static_cast<size_t>(outcome)];
}

/// The choices of some axes.
using Names = std::vector<std::string>;

/// The points of one method as rows and columns, in the order of the axes.
struct Grid {
  Names row_axes, column_axes;
  std::vector<Names> rows, columns;
  std::map<std::pair<Names, Names>, const AtlasPoint*> points;

  const AtlasPoint* at(size_t row, size_t column) const {
    const auto found = points.find({rows[row], columns[column]});
    return found == points.end() ? nullptr : found->second;
  }
};

Grid grid_of(const AtlasMap& map, const std::string& method) {
  Grid grid;
  std::vector<size_t> across, down;
  const std::vector<AtlasAxis>& axes = map.atlas.axes;
  for (const std::string& name : map.atlas.columns) {
    for (size_t axis = 0; axis < axes.size(); ++axis) {
      if (axes[axis].name == name) across.push_back(axis);
    }
  }
  for (size_t axis = 0; axis < axes.size(); ++axis) {
    if (!contains(map.atlas.columns, axes[axis].name)) down.push_back(axis);
  }
  for (const size_t axis : across)
    grid.column_axes.push_back(axes[axis].name);
  for (const size_t axis : down)
    grid.row_axes.push_back(axes[axis].name);
  using Key = std::vector<size_t>;
  std::map<Key, Names> rows, columns;  // by the numbers of their choices, which sorts them
  for (const AtlasPoint& point : map.points) {
    if (point.method != method) continue;
    const Names settings = settings_of(map.atlas, point);
    Key row_key, column_key;
    Names row, column;
    for (const size_t axis : down) {
      row_key.push_back(point.choices[axis]);
      row.push_back(settings[axis]);
    }
    for (const size_t axis : across) {
      column_key.push_back(point.choices[axis]);
      column.push_back(settings[axis]);
    }
    rows[row_key] = row;
    columns[column_key] = column;
    grid.points[{row, column}] = &point;
  }
  for (const auto& [key, names] : rows)
    grid.rows.push_back(names);
  for (const auto& [key, names] : columns)
    grid.columns.push_back(names);
  return grid;
}

Names methods_in(const AtlasMap& map) {
  Names methods;
  for (const AtlasPoint& point : map.points) {
    if (!contains(methods, point.method)) methods.push_back(point.method);
  }
  return methods;
}

std::string letters_of(const AtlasPoint* point) {
  if (point == nullptr) return "";
  const std::string now(1, letter_of(point->judgement.outcome));
  return point->before && *point->before != point->judgement.outcome
             ? letter_of(*point->before) + (">" + now)
             : now;
}

/// Names of the columns below each other, an axis a line.
std::string grid_text(const AtlasMap& map, const std::string& method) {
  const Grid grid = grid_of(map, method);
  std::string row_title = base::joined(grid.row_axes);
  size_t width = row_title.size(), column_width = 4;
  for (const Names& row : grid.rows)
    width = std::max(width, base::joined(row).size());
  for (const Names& column : grid.columns) {
    for (const std::string& name : column)
      column_width = std::max(column_width, name.size() + 1);
  }
  std::string text = report::method_title(method) + "\n";
  for (size_t axis = 0; axis < grid.column_axes.size(); ++axis) {
    const bool is_last = axis + 1 == grid.column_axes.size();
    text += fmt::format("{:<{}} ", is_last ? row_title : "", width);
    for (const Names& column : grid.columns)
      text += fmt::format("{:>{}}", column[axis], column_width);
    text += "  " + grid.column_axes[axis] + "\n";
  }
  if (grid.column_axes.empty()) text += row_title + "\n";
  for (size_t row = 0; row < grid.rows.size(); ++row) {
    text += fmt::format("{:<{}} ", base::joined(grid.rows[row]), width);
    for (size_t column = 0; column < grid.columns.size(); ++column)
      text += fmt::format("{:>{}}", letters_of(grid.at(row, column)), column_width);
    text += "\n";
  }
  return text + "\n";
}

/// A reason without its numbers, so that equal causes are counted as one.
std::string kind_of(const std::string& reason) {
  static const std::regex number(R"(-?\d+(\.\d+)?(e[-+]?\d+)?)");
  return std::regex_replace(reason, number, "N");
}

size_t count(const AtlasMap& map, Outcome outcome) {
  return static_cast<size_t>(
      std::count_if(map.points.begin(), map.points.end(),
                    [&](const AtlasPoint& p) { return p.judgement.outcome == outcome; }));
}

std::string causes_text(const AtlasMap& map) {
  std::map<std::pair<Outcome, std::string>, size_t> causes;
  for (const AtlasPoint& point : map.points) {
    if (point.judgement.outcome != Outcome::stable)
      ++causes[{point.judgement.outcome, kind_of(point.judgement.reason)}];
  }
  std::string text;
  for (const auto& [cause, n] : causes)
    text += fmt::format("{:>5} {}: {}\n", n, word_of(cause.first), cause.second);
  return text;
}

bool has_before(const AtlasMap& map) {
  return std::any_of(map.points.begin(), map.points.end(),
                     [](const AtlasPoint& point) { return point.before.has_value(); });
}

/// How many points an earlier map has that was this and are that now.
size_t count(const AtlasMap& map, Outcome before, Outcome now) {
  return static_cast<size_t>(std::count_if(
      map.points.begin(), map.points.end(),
      [&](const AtlasPoint& p) { return p.before == before && p.judgement.outcome == now; }));
}

std::string changes_text(const AtlasMap& map) {
  std::string text = fmt::format("\n{:<16}", "before \\ now");
  const auto width_of = [](Outcome now) {
    return std::max(9, 1 + static_cast<int>(std::string_view(word_of(now)).size()));
  };
  for (const Outcome now : outcomes)
    text += fmt::format("{:>{}}", word_of(now), width_of(now));
  for (const Outcome before : outcomes) {
    text += fmt::format("\n{:<16}", word_of(before));
    for (const Outcome now : outcomes)
      text += fmt::format("{:>{}}", count(map, before, now), width_of(now));
  }
  text += "\n";
  for (const AtlasPoint& point : map.points) {
    if (point.before != Outcome::stable || point.judgement.outcome == Outcome::stable) continue;
    text += fmt::format("no longer stable: {} {}: {}: {}\n", point.method,
                        base::joined(settings_of(map.atlas, point)),
                        word_of(point.judgement.outcome), point.judgement.reason);
  }
  return text;
}

/// "Of 64 points 40 are stable, 20 were stopped, 4 are wrong."
std::string verdict_of(const AtlasMap& map) {
  std::string text = fmt::format(
      "Of {} points {} are stable, {} were stopped with their cause, {} came to their end and are "
      "wrong{}.",
      map.points.size(), count(map, Outcome::stable), count(map, Outcome::stopped),
      count(map, Outcome::wrong),
      count(map, Outcome::refused) > 0
          ? fmt::format(", {} could not be begun", count(map, Outcome::refused))
          : "");
  if (count(map, Outcome::unfinished) > 0) {
    text +=
        fmt::format(" {} ended at their step limit (time.max_steps), which says nothing of them.",
                    count(map, Outcome::unfinished));
  }
  if (map.points.size() < map.n_planned) {
    text += fmt::format(" {} are still to be run: the same command goes on.",
                        map.n_planned - map.points.size());
  }
  if (!has_before(map)) return text;
  size_t failed = 0, cured = 0, lost = 0;
  for (const AtlasPoint& point : map.points) {
    if (!point.before) continue;
    const bool was = *point.before == Outcome::stable;
    const bool is = point.judgement.outcome == Outcome::stable;
    failed += was ? 0 : 1;
    cured += !was && is ? 1 : 0;
    lost += was && !is ? 1 : 0;
  }
  return text +
         fmt::format(" Of {} that were not stable before, {} are now; {} that were, are no longer.",
                     failed, cured, lost);
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json point_json(const AtlasMap& map, const AtlasPoint& point) {
  Json settings = Json::object();
  const Names names = settings_of(map.atlas, point);
  for (size_t axis = 0; axis < names.size(); ++axis)
    settings[map.atlas.axes[axis].name] = names[axis];
  const io::RunSummary& run = point.run;
  return {{"method", point.method},
          {"settings", settings},
          {"outcome", word_of(point.judgement.outcome)},
          {"reason", point.judgement.reason},
          {"end_time", number(run.end_time)},
          {"steps", run.steps},
          {"energy_residual", number(run.energy.relative_residual)},
          {"inverted_cells", run.most_inverted_cells},
          {"least_cell_J", number(run.least_cell_J)},
          {"kinetic_growth", number(point.kinetic_growth)},
          {"seconds", number(run.wall_seconds)}};
}

report::AtlasPicture picture_of(const AtlasMap& map, const std::string& method) {
  const Grid grid = grid_of(map, method);
  report::AtlasPicture picture{
      method, base::joined(grid.row_axes), base::joined(grid.column_axes), grid.rows, grid.columns,
      {}};
  for (size_t row = 0; row < grid.rows.size(); ++row) {
    auto& cells = picture.cells.emplace_back();
    for (size_t column = 0; column < grid.columns.size(); ++column) {
      const AtlasPoint* point = grid.at(row, column);
      cells.emplace_back();
      if (point == nullptr) continue;
      cells.back() = {word_of(point->judgement.outcome), point->judgement.reason,
                      point->before ? word_of(*point->before) : ""};
    }
  }
  return picture;
}

}  // namespace

std::string atlas_text(const AtlasMap& map) {
  std::string text = map.atlas.title + "\n\n";
  for (const std::string& method : methods_in(map))
    text += grid_text(map, method);
  text += ". stable, S stopped, W wrong, - refused, U unfinished";
  text += has_before(map) ? ", S>. stopped before and stable now\n" : "\n";
  text += verdict_of(map) + "\n" + causes_text(map);
  if (has_before(map)) text += changes_text(map);
  return text + fmt::format("{} of runs\n", duration_text(map.seconds));
}

std::string atlas_csv(const AtlasMap& map) {
  std::string csv = "method";
  for (const AtlasAxis& axis : map.atlas.axes)
    csv += "," + quoted(axis.name);
  csv +=
      ",outcome,before,reason,end time [s],steps,energy residual,inverted cells,least cell "
      "J,kinetic growth,seconds\n";
  for (const AtlasPoint& point : map.points) {
    csv += point.method;
    for (const std::string& name : settings_of(map.atlas, point))
      csv += "," + quoted(name);
    const io::RunSummary& run = point.run;
    csv += fmt::format(",{},{},{},{},{},{},{},{},{},{:.3f}\n", word_of(point.judgement.outcome),
                       point.before ? word_of(*point.before) : "", quoted(point.judgement.reason),
                       number_text(run.end_time, "{:.9g}", ""), run.steps,
                       number_text(run.energy.relative_residual, "{:.6g}", ""),
                       run.most_inverted_cells, number_text(run.least_cell_J, "{:.6g}", ""),
                       number_text(point.kinetic_growth, "{:.6g}", ""), run.wall_seconds);
  }
  return csv;
}

std::string atlas_json(const AtlasMap& map) {
  Json head = {{"format", "diptych atlas"}, {"format_version", 1},      {"atlas", map.atlas.name},
               {"title", map.atlas.title},  {"planned", map.n_planned}, {"seconds", map.seconds},
               {"commit", map.commit},      {"date", map.date},         {"program", map.program}};
  std::string text = head.dump(1);
  text.resize(text.size() - 2);  // "\n}": the points follow, one on each line
  text += ",\n \"points\": [";
  for (size_t i = 0; i < map.points.size(); ++i) {
    text += i == 0 ? "\n  " : ",\n  ";
    text += point_json(map, map.points[i]).dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return text + "\n ]\n}\n";
}

std::string atlas_html(const AtlasMap& map) {
  std::vector<report::AtlasPicture> pictures;
  for (const std::string& method : methods_in(map))
    pictures.push_back(picture_of(map, method));
  return report::atlas_page(map.atlas.title, map.atlas.text, verdict_of(map), pictures,
                            atlas_text(map));
}

size_t set_before(AtlasMap& map, const std::string& json, const std::string& path) {
  std::map<std::pair<std::string, std::map<std::string, std::string>>, Outcome> earlier;
  try {
    const Json document = Json::parse(json);
    for (const Json& point : document.at("points")) {
      const auto word = point.at("outcome").get<std::string>();
      const auto found = std::find_if(outcomes.begin(), outcomes.end(),
                                      [&](Outcome outcome) { return word == word_of(outcome); });
      if (found == outcomes.end()) throw base::InputError(path + ": '" + word + "' is no outcome");
      earlier[{point.at("method").get<std::string>(),
               point.at("settings").get<std::map<std::string, std::string>>()}] = *found;
    }
  } catch (const Json::exception&) {
    throw base::InputError(path + ": is no atlas.json that study --atlas has written");
  }
  size_t n_found = 0;
  for (AtlasPoint& point : map.points) {
    const Names names = settings_of(map.atlas, point);
    std::map<std::string, std::string> settings;
    for (size_t axis = 0; axis < names.size(); ++axis)
      settings[map.atlas.axes[axis].name] = names[axis];
    const auto found = earlier.find({point.method, settings});
    if (found == earlier.end()) continue;
    point.before = found->second;
    ++n_found;
  }
  return n_found;
}

}  // namespace diptych::harness
