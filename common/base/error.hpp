#pragma once
/// Errors and exit codes. Four kinds, never mixed: wrong input, broken physics, environment, and
/// (asserts apart) a bound that was not met. Each carries the process's exit code.

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace diptych::base {

/// Documented exit codes of the program.
enum class ExitCode : int {
  done = 0,
  wrong_input = 2,    ///< case file, mesh, command line
  breakdown = 3,      ///< physics or scheme broke down: J <= 0, NaN, time step collapsed; a guard
  environment = 4,    ///< disk, memory, permission, missing program
  bound_not_met = 5,  ///< a check or a regression bound failed
  interrupted = 130   ///< SIGINT or SIGTERM, after writing what there is
};

/// Base of all errors that reach the user: lower case, no full stop, says what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ExitCode::wrong_input, message) {}
};

class BreakdownError : public Error {
 public:
  explicit BreakdownError(const std::string& message) : Error(ExitCode::breakdown, message) {}
  /// @param node  that the message calls "at node NODE"
  BreakdownError(const std::string& message, std::int64_t node)
      : Error(ExitCode::breakdown, message), node_(node) {}
  /// Number of the solver, where the message names one.
  const std::optional<std::int64_t>& node() const { return node_; }

 private:
  std::optional<std::int64_t> node_;
};

class EnvironmentError : public Error {
 public:
  explicit EnvironmentError(const std::string& message) : Error(ExitCode::environment, message) {}
};

class BoundError : public Error {
 public:
  explicit BoundError(const std::string& message) : Error(ExitCode::bound_not_met, message) {}
};

}  // namespace diptych::base
