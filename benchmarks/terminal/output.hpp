#pragma once
/// What a command prints and the files that it says it has written.

#include <string>

namespace diptych::harness {

/// Writes to standard output and flushes it.
void print(const std::string& text);

/// Writes FOLDER/NAME, whole or not at all, making the folder where it is missing, and prints where
/// it is. @throws base::EnvironmentError
void write_output(const std::string& folder, const std::string& name, const std::string& text);

}  // namespace diptych::harness
