/// Meshing of .geo files by the gmsh program: started directly (no shell), one thread, Delaunay
/// (HXT is not repeatable), without the user's own Gmsh settings, so that a mesh can be made again.
/// A .geo file is a program: those that run, write or read what a mesh has no need of are refused
/// (geo_scan.hpp), and gmsh itself can neither start a program nor write outside its own folder
/// (jail.hpp). Test: tests/meshes/mesh_geo_test.cpp.

#include "common/base/error.hpp"
#include "meshes/geo/child_program.hpp"
#include "meshes/geo/geo_scan.hpp"
#include "meshes/geo/jail.hpp"
#include "meshes/gmsh.hpp"
#include "meshes/msh/source.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <string_view>
#include <system_error>

namespace diptych::meshes {

namespace {

namespace fs = std::filesystem;

/// Before the value of h that the file ended with.
constexpr std::string_view size_line = "diptych: h = ";

/// Read by gmsh behind the .geo file, so that it has the last word.
constexpr const char* fixed_options =
    "Mesh.Algorithm3D = 1;\nMesh.Binary = 0;\nPrintf(\"diptych: h = %.17g\", h);\n";

void check_arguments(const std::string& geo_path, int dimension, double size) {
  if (dimension != 2 && dimension != 3) {
    throw base::InputError(fmt::format("{}: dimension {} is not 2 or 3", geo_path, dimension));
  }
  if (!(size > 0) || !(size < 1e300)) {
    throw base::InputError(
        fmt::format("{}: element size {} must be positive and finite", geo_path, size));
  }
  check_geo(geo_path);
}

std::string gmsh_program() {
  if (DIPTYCH_GMSH_ALLOWED == 0) {
    throw base::EnvironmentError(
        "this program was configured with DIPTYCH_WITH_GMSH=OFF and does not mesh .geo files: give "
        "a .msh file, or configure it with DIPTYCH_WITH_GMSH=AUTO");
  }
  std::string program = program_in_path("gmsh");
  if (program.empty()) {
    throw base::EnvironmentError(
        "the gmsh program is needed to mesh a .geo file, but PATH has none: install the Debian "
        "package gmsh (apt-get install gmsh), or give a .msh file");
  }
  return program;
}

/// Gmsh's own words: its errors without the summary it adds, or else its last line.
std::string errors_of(const std::string& output) {
  std::string errors, last;
  int n_errors = 0;
  for (size_t start = 0; start < output.size();) {
    const size_t end = std::min(output.find('\n', start), output.size());
    const std::string line = output.substr(start, end - start);
    start = end + 1;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    last = line;
    const size_t colon = line.find(": ");
    if (!line.starts_with("Error") || colon == std::string::npos) continue;
    const std::string text = line.substr(colon + 2);
    if (text.starts_with("-----")) {
      if (n_errors > 0) break;  // the summary begins
      continue;
    }
    if (++n_errors <= 3) errors += (errors.empty() ? "" : "; ") + text;
  }
  return msh::shown(errors.empty() ? last : errors, 400);
}

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw base::EnvironmentError(
        fmt::format("{}: the folder for the mesh cannot be made: {}", folder, error.message()));
  }
}

void write_options(const fs::path& path) {
  std::ofstream file(path);
  file << fixed_options;
  file.close();
  if (!file) {
    throw base::EnvironmentError(
        fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
  }
}

/// "'x.geo', line 3: syntax error" as "x.geo:3: syntax error", where gmsh says so: a mistake of the
/// file. Else empty.
std::string mistake_of(const std::string& errors) {
  const size_t line = errors.find("', line ");
  if (errors.empty() || errors[0] != '\'' || line == std::string::npos) return {};
  const size_t number = line + 8, colon = errors.find(':', number);
  if (colon == std::string::npos) return {};
  return fmt::format("{}:{}: gmsh: {}", errors.substr(1, line - 1),
                     errors.substr(number, colon - number), errors.substr(colon + 2));
}

/// The program in its jail. A script, as some installations of gmsh are, starts its interpreter
/// with what the user's environment says, and other programs.
ChildResult run_gmsh(const std::string& program,
                     const std::vector<std::string>& arguments,
                     const std::string& folder) {
  const bool script = is_script(program);
  const Jail jail(folder, !script);
  Surroundings surroundings{{"GMSH_HOME=" + folder, "LC_ALL=C"}, script, &jail};
  if (!script) {
    for (const char* name : {"HOME=", "TMPDIR="})
      surroundings.environment.push_back(name + folder);
    const char* libraries = std::getenv("LD_LIBRARY_PATH");  // of a gmsh that the user built
    if (libraries != nullptr)
      surroundings.environment.push_back(std::string("LD_LIBRARY_PATH=") + libraries);
  }
  return run_child(program, arguments, surroundings);
}

[[noreturn]] void refuse(const std::string& geo_path, const ChildResult& result) {
  const std::string errors = errors_of(result.output), mistake = mistake_of(errors);
  if (!mistake.empty()) throw base::InputError(mistake);
  if (result.exit_status == 128 + SIGXCPU) {
    throw base::EnvironmentError(
        fmt::format("{}: gmsh was ended after {} s; use a larger mesh.size, or mesh it yourself "
                    "and give the .msh file",
                    geo_path, Jail::most_seconds));
  }
  throw base::EnvironmentError(
      fmt::format("{}: gmsh failed ({}): {}", geo_path, result.ending(), errors));
}

/// The value of h at the end of the file; nan: gmsh did not say.
double size_at_end(const std::string& output) {
  const size_t at = output.rfind(size_line);
  if (at == std::string::npos) return NAN;
  return std::strtod(output.c_str() + at + size_line.size(), nullptr);
}

/// A file that does not take the size that it is given would have the same mesh on all levels.
void check_size(const std::string& geo_path, double size, const std::string& output) {
  if (!uses_name(geo_path, "h")) {
    throw base::InputError(fmt::format(
        "{}: mesh.size has no effect, since the file does not use h: write DefineConstant[ h = "
        "{:.6g} ]; "
        "and give its points h as their size, or mesh it yourself and give the .msh file",
        geo_path, size));
  }
  const double end = size_at_end(output);
  if (std::isnan(end) || std::abs(end - size) <= 1e-12 * size) return;
  throw base::InputError(
      fmt::format("{}: mesh.size = {:.6g} has no effect, since the file sets h = {:.6g} itself: "
                  "write DefineConstant[ h = {:.6g} ]; instead",
                  geo_path, size, end, end));
}

}  // namespace

bool has_gmsh() {
  return DIPTYCH_GMSH_ALLOWED != 0 && !program_in_path("gmsh").empty();
}

Mesh mesh_geo(const std::string& geo_path,
              int dimension,
              double size,
              const std::string& work_directory) {
  check_arguments(geo_path, dimension, size);
  const std::string program = gmsh_program();
  make_folder(work_directory);
  // Absolute paths: a name that begins with a dash would be taken for an option.
  const fs::path geo = fs::absolute(geo_path), folder = fs::absolute(work_directory);
  const fs::path msh = folder / (geo.stem().string() + ".msh");
  const fs::path options = folder / (geo.stem().string() + ".options.geo");
  std::error_code ignored;
  fs::remove(msh, ignored);  // an old mesh must not pass for the new one; checked by its absence
  if (fs::exists(msh, ignored)) {
    throw base::EnvironmentError(msh.string() + ": the old mesh cannot be removed");
  }
  write_options(options);
  const ChildResult result =
      run_gmsh(program,
               {geo.string(), options.string(), fmt::format("-{}", dimension), "-nt", "1",
                "-format", "msh41", "-setnumber", "h", fmt::format("{}", size), "-o", msh.string()},
               folder.string());
  if (result.exit_status != 0) refuse(geo_path, result);
  if (!fs::exists(msh, ignored)) {
    throw base::EnvironmentError(
        fmt::format("{}: gmsh wrote no mesh: {}", geo_path, errors_of(result.output)));
  }
  check_size(geo_path, size, result.output);
  try {
    return read_msh(msh.string());
  } catch (const base::InputError& error) {  // of a file that nobody sees
    std::string what = error.what();
    if (const size_t at = what.find(msh.string()); at != std::string::npos)
      what.replace(at, msh.string().size(), geo_path + ", the mesh that gmsh made of it");
    throw base::InputError(what);
  }
}

}  // namespace diptych::meshes
