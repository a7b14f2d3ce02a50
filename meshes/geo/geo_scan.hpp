#pragma once
/// What a .geo file would do besides describing a geometry. It is a program of Gmsh's own language:
/// it can start others, write anywhere and read other scripts. Test: tests/meshes/geo_scan_test.cpp

#include <string>
#include <string_view>
#include <vector>

namespace diptych::meshes {

/// Refuses commands that run or write, and files that are read from outside the folder of the .geo
/// file, in it and in all it takes in by Include and Merge. Names that are put together from
/// strings are refused too: they cannot be known without running the file.
///
/// The text is searched as it stands, comments, strings and branches not taken included: Gmsh looks
/// for the end of a branch inside strings, and comes back from a macro to the next line even inside
/// a comment, so that what looks quoted can be run.
/// @throws base::InputError "file:line: ..." on the first offence, a file that is not there or no
///         regular one
void check_geo(const std::string& path);

/// The file and all that a mesh of it hangs on: what it takes in, and that in turn; in the order of
/// their paths.
/// @throws base::InputError as check_geo
std::vector<std::string> files_read(const std::string& path);

/// Whether the file, or one that it takes in, uses this name outside comments and strings: other
/// than to give it a value.
/// @throws base::InputError as check_geo
bool uses_name(const std::string& path, std::string_view name);

}  // namespace diptych::meshes
