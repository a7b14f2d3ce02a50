/// diptych-picture SERIES [SERIES] -o OUT.png: a frame of one run, or of two runs side by side on
/// one colour scale.

#include "common/base/error.hpp"
#include "common/io/field_writer.hpp"
#include "postprocess/pictures/scene.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>

namespace {

using namespace diptych;

struct Request {
  std::vector<std::string> series;
  std::vector<std::string> titles;
  int frame = -1;
  std::string output;
  std::vector<double> range, towards;
  bool plain = false;
  pictures::PictureOptions picture;
};

/// DIR stands for DIR/run.hdf.series, and gives the panel its title.
pictures::Panel panel_of(const std::string& given, int frame) {
  namespace fs = std::filesystem;
  const fs::path series =
      fs::is_directory(given) ? fs::path(given) / "run.hdf.series" : fs::path(given);
  const std::vector<io::FrameEntry> frames = io::read_series(series.string());
  const int count = static_cast<int>(frames.size());
  const int index = frame < 0 ? count + frame : frame;
  if (index < 0 || index >= count) {
    throw base::InputError(fmt::format("{}: no frame {}; it has 0 to {}, and -1 is the last",
                                       series.string(), frame, count - 1));
  }
  const io::FrameEntry& entry = frames[static_cast<size_t>(index)];
  return {fs::absolute(series).parent_path().filename().string(), entry.path, entry.time};
}

void describe(CLI::App& app, Request& request) {
  app.add_option("series", request.series, "run.hdf.series of one or two runs, or their folders")
      ->required()
      ->expected(1, 2);
  app.add_option("-o,--output", request.output, "the PNG to write")->required();
  app.add_option("--field", request.picture.field,
                 "nodal field that gives the colours, such as 'von_mises_stress [Pa]'")
      ->capture_default_str();
  app.add_option("--component", request.picture.component,
                 "magnitude, x y z, xx ... zz, or a number")
      ->capture_default_str();
  app.add_option("--frame", request.frame, "number of the frame; negative counts from the end")
      ->capture_default_str();
  app.add_option("--title", request.titles, "title of each panel instead of its folder's name")
      ->expected(1, 2);
  app.add_option("--warp", request.picture.warp, "factor of the displacement")
      ->capture_default_str();
  app.add_option("--range", request.range, "lowest and highest value of the colours")->expected(2);
  app.add_option("--view", request.towards, "direction from the body to the eye")->expected(3);
  app.add_option("--width", request.picture.width, "pixels")
      ->check(CLI::Range(200, 8000))
      ->capture_default_str();
  app.add_option("--height", request.picture.height, "pixels")
      ->check(CLI::Range(200, 8000))
      ->capture_default_str();
  app.add_flag("--no-edges", request.plain, "do not draw the edges of cells");
}

void draw(Request& request) {
  if (!request.titles.empty() && request.titles.size() != request.series.size()) {
    throw base::InputError("--title needs one title for each series");
  }
  pictures::PictureOptions& options = request.picture;
  options.edges = !request.plain;
  if (!request.range.empty()) {
    if (!(request.range[0] < request.range[1])) {
      throw base::InputError("--range needs the lowest value first, then a higher one");
    }
    options.range = {request.range[0], request.range[1]};
  }
  if (!request.towards.empty()) {
    options.towards = {request.towards[0], request.towards[1], request.towards[2]};
    if (*options.towards == std::array<double, 3>{0, 0, 0}) {
      throw base::InputError("--view needs a direction that is not zero");
    }
  }
  std::vector<pictures::Panel> panels;
  for (const std::string& series : request.series)
    panels.push_back(panel_of(series, request.frame));
  for (size_t i = 0; i < request.titles.size(); ++i)
    panels[i].title = request.titles[i];
  pictures::write_picture(request.output, panels, options);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Pictures of the frames of a run, or of two runs side by side.", "diptych-picture");
  Request request;
  describe(app, request);
  try {
    app.parse(argc, argv);
    draw(request);
    return static_cast<int>(base::ExitCode::done);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(base::ExitCode::wrong_input);
  } catch (const base::Error& error) {
    fmt::print(stderr, "diptych-picture: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
