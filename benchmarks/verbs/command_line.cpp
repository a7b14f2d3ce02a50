#include "benchmarks/verbs/command_line.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"

#include <algorithm>
#include <CLI/CLI.hpp>
#include <memory>

namespace diptych::verbs {

namespace {

/// A name or path that a shell variable without a value leaves empty.
std::string what_is_empty(const std::string& text) {
  return text.empty() ? "is empty; give it a value or leave it out" : "";
}

}  // namespace

void CommandLine::word(const char* name, std::string& value, const char* help) {
  verb_.add_option(name, value, help)->required();
}
void CommandLine::words(const char* name, std::vector<std::string>& values, const char* help) {
  verb_.add_option(name, values, help);
}
void CommandLine::option(const char* name, std::string& value, const char* help) {
  verb_.add_option(name, value, help)->check(what_is_empty);
}
void CommandLine::option(const char* name, int& value, const char* help) {
  verb_.add_option(name, value, help);
}
void CommandLine::option(const char* name, double& value, const char* help) {
  verb_.add_option(name, value, help);
}
void CommandLine::count(const char* name, int& value, int least, int most, const char* help) {
  verb_.add_option(name, value, help)->check(CLI::Range(least, most));
}
void CommandLine::required(const char* name, double& value, const char* help) {
  verb_.add_option(name, value, help)->required();
}
void CommandLine::repeated(const char* name, std::vector<std::string>& values, const char* help) {
  verb_.add_option(name, values, help)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}
void CommandLine::list(const char* name, std::vector<std::string>& values, const char* help) {
  verb_.add_option(name, values, help)->delimiter(',');
}
void CommandLine::list(const char* name, std::vector<int>& values, const char* help) {
  verb_.add_option(name, values, help)->delimiter(',');
}
void CommandLine::flag(const char* name, bool& value, const char* help) {
  verb_.add_flag(name, value, help);
}
void CommandLine::only_with(const char* name, const char* other) {
  verb_.get_option(name)->needs(verb_.get_option(other));
}

namespace {

/// "--level=2" without its value.
std::string option_name(const std::string& word) {
  return word.substr(0, word.find('='));
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> verb_names(const std::vector<Verb>& verbs) {
  std::vector<std::string> names;
  for (const Verb& verb : verbs)
    names.emplace_back(verb.name);
  return names;
}

/// The first option that `app` does not know, with the nearest that it does; else empty.
std::string unknown_option(const CLI::App& app, const std::string& where, char** from, char** to) {
  const std::vector<std::string> known = option_names(app);
  for (char** word = from; word != to; ++word) {
    const std::string name = option_name(*word);
    if (name == "--") break;
    if (name.rfind("--", 0) != 0 || std::count(known.begin(), known.end(), name) > 0) continue;
    return "unknown option '" + name + "' of " + where + base::suggestion(name, known);
  }
  return {};
}

/// What is wrong with a command line that was not understood.
std::string mistake(const CLI::App& app,
                    const std::vector<Verb>& verbs,
                    const CLI::ParseError& error,
                    int argc,
                    char** argv) {
  char** const end = argv + argc;
  char** const verb = std::find_if(argv + 1, end, [](const char* word) { return word[0] != '-'; });
  const std::vector<std::string> names = verb_names(verbs);
  if (std::string wrong = unknown_option(app, "diptych", argv + 1, verb); !wrong.empty())
    return wrong;
  if (verb == end) return "no verb is given; known: " + base::joined(names);
  if (std::count(names.begin(), names.end(), *verb) == 0)
    return std::string("unknown verb '") + *verb + "'" + base::suggestion(*verb, names);
  const std::string where = std::string("'") + *verb + "'";
  if (std::string wrong = unknown_option(*app.get_subcommand(*verb), where, verb + 1, end);
      !wrong.empty())
    return wrong;
  return std::string(error.what()) + "; see diptych " + *verb + " --help";
}

/// Descriptions of options in lines that fit a terminal.
class FoldedHelp : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return base::folded(CLI::Formatter::make_option(option, is_positional), get_column_width());
  }
};

}  // namespace

int run_program(const std::vector<Verb>& verbs, int argc, char** argv) {
  CLI::App app{"Diptych: one large-strain solid-dynamics scene on SPH and finite volumes",
               "diptych"};
  app.require_subcommand(1);
  app.formatter(std::make_shared<FoldedHelp>());
  app.set_version_flag("--version", std::string("diptych ") + DIPTYCH_VERSION);
  std::vector<std::pair<const CLI::App*, Action>> actions;
  for (const Verb& verb : verbs) {
    CLI::App* declared = app.add_subcommand(verb.name, verb.help);
    CommandLine options(*declared);
    actions.emplace_back(declared, verb.declare(options));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    throw base::InputError(mistake(app, verbs, error, argc, argv));
  }
  for (const auto& [verb, action] : actions) {
    if (verb->parsed()) return action();
  }
  return 0;
}

}  // namespace diptych::verbs
