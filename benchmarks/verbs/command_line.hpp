#pragma once
/// What a verb reads from the command line, without the parser's headers, which take seconds to
/// compile: the words, options and flags of one verb, bound to variables. A value of the wrong
/// type, an unknown option or a missing word is one line with exit code 2. Test:
/// tests/command_line/bad_input_test.cpp

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace diptych::verbs {

/// The command line of one verb. Variables must live until the verb has run.
class CommandLine {
 public:
  explicit CommandLine(CLI::App& verb) : verb_(verb) {}

  /// A word that must stand.
  void word(const char* name, std::string& value, const char* help);
  /// Any number of words.
  void words(const char* name, std::vector<std::string>& values, const char* help);
  void option(const char* name, std::string& value, const char* help);
  void option(const char* name, int& value, const char* help);
  void option(const char* name, double& value, const char* help);
  /// A whole number between two others.
  void count(const char* name, int& value, int least, int most, const char* help);
  /// An option without which the verb does not run.
  void required(const char* name, double& value, const char* help);
  /// An option that may stand several times, one value each.
  void repeated(const char* name, std::vector<std::string>& values, const char* help);
  /// Values between commas.
  void list(const char* name, std::vector<std::string>& values, const char* help);
  void list(const char* name, std::vector<int>& values, const char* help);
  void flag(const char* name, bool& value, const char* help);
  /// `name` is refused where `other` does not stand. Both have been declared.
  void only_with(const char* name, const char* other);

 private:
  CLI::App& verb_;
};

/// What a verb does once its command line is read. @return exit code
using Action = std::function<int()>;

/// A verb: its name, one line of help, and its options; the Action is called where it was given.
struct Verb {
  const char* name;
  const char* help;
  Action (*declare)(CommandLine&);
};

/// Reads the command line and does what it says.
/// @return exit code
/// @throws base::Error  base::InputError for a command line that no verb understands
int run_program(const std::vector<Verb>& verbs, int argc, char** argv);

}  // namespace diptych::verbs
