/// JUnit XML of a regression.

#include "benchmarks/regression/report.hpp"
#include "benchmarks/terminal/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <regex>
#include <sstream>

namespace diptych::harness {

namespace {

/// The text with signs of replacement (U+FFFD) for what XML cannot hold even escaped: bytes that
/// are no UTF-8, control characters, U+FFFE and U+FFFF. The rest is escaped by the library.
std::string xml_text(const std::string& text) {
  using nlohmann::json;
  static const std::regex none("[\\x00-\\x08\\x0B\\x0C\\x0E-\\x1F]|\xEF\xBF[\xBE\xBF]");
  const std::string sound = json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  return std::regex_replace(json::parse(sound).get<std::string>(), none, "\xEF\xBF\xBD");
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(xml_text(value).c_str());
}

void set_seconds(pugi::xml_node node, double seconds) {
  set(node, "time", fmt::format("{:.3f}", seconds));
}

bool is_error(const RegressCheck& check) {
  return check.verdict == Verdict::failed && check.code != base::ExitCode::bound_not_met;
}

/// One line.
std::string message_of(const RegressCheck& check) {
  if (!std::isfinite(check.measured))
    return check.figure + ": " + check.note.substr(0, check.note.find('\n'));
  return fmt::format("{}: measured {:.3g}, bound {:.3g}", check.figure, check.measured,
                     check.bound);
}

std::string details_of(const RegressCheck& check) {
  return fmt::format("{}: {}\nmeasured: {}\nbound: {}\n{}", check.name, check.figure,
                     number_text(check.measured, "{:.9g}", "none"),
                     number_text(check.bound, "{:.9g}", "none"), check.note);
}

size_t count_errors(const std::vector<RegressRow>& rows) {
  size_t n = 0;
  for (const RegressRow& row : rows)
    n += static_cast<size_t>(std::count_if(row.checks.begin(), row.checks.end(), is_error));
  return n;
}

/// Numbers of checks as attributes.
void set_counts(pugi::xml_node node, const std::vector<RegressRow>& rows) {
  const VerdictCounts n = count_verdicts(rows);
  const size_t errors = count_errors(rows);
  set(node, "tests", std::to_string(n.all()));
  set(node, "failures", std::to_string(n.of(Verdict::failed) - errors));
  set(node, "errors", std::to_string(errors));
}

void add_testcase(pugi::xml_node suite, const RegressRow& row, const RegressCheck& check) {
  pugi::xml_node test = suite.append_child("testcase");
  set(test, "classname", row.case_name + "." + row.method);
  set(test, "name", check.figure.empty() ? check.name : check.name + ": " + check.figure);
  // the checks of a row share its runs: their times sum up to it
  set_seconds(test, row.seconds / static_cast<double>(row.checks.size()));
  if (check.verdict == Verdict::skipped) {
    set(test.append_child("skipped"), "message", check.note);
  } else if (check.verdict == Verdict::failed) {
    pugi::xml_node failure = test.append_child(is_error(check) ? "error" : "failure");
    set(failure, "message", message_of(check));
    set(failure, "type", kind_of(check.code));
    failure.text().set(xml_text(details_of(check)).c_str());
  } else if (check.verdict == Verdict::known) {
    test.append_child("system-out")
        .text()
        .set(xml_text("known, no worse than recorded\n" + details_of(check)).c_str());
  }
}

void add_properties(pugi::xml_node suite, const RegressedCase& entry, const io::Provenance& p) {
  pugi::xml_node properties = suite.append_child("properties");
  const auto add = [&](const char* name, const std::string& value) {
    pugi::xml_node property = properties.append_child("property");
    set(property, "name", name);
    set(property, "value", value);
  };
  add("case", entry.file);
  add("baseline", entry.baseline);
  add("version", p.version);
  add("commit", p.commit);
  add("instruction_set", p.instruction_set);
}

/// "2026-01-01T00:00:00Z" without its Z: readers with a schema take no zone.
std::string timestamp(const std::string& date) {
  return date.substr(0, date.find('Z'));
}

void add_suite(pugi::xml_node suites, const RegressedCase& entry, const io::Provenance& p) {
  pugi::xml_node suite = suites.append_child("testsuite");
  set(suite, "name", entry.name);
  set_counts(suite, entry.rows);
  set(suite, "skipped", std::to_string(count_verdicts(entry.rows).of(Verdict::skipped)));
  set_seconds(suite, entry.seconds);
  set(suite, "timestamp", timestamp(p.date));
  add_properties(suite, entry, p);
  for (const RegressRow& row : entry.rows) {
    for (const RegressCheck& check : row.checks)
      add_testcase(suite, row, check);
  }
}

/// A regression that has not ended must not be taken for one that passed.
RegressedCase unfinished(const RegressReport& report) {
  const std::string what =
      report.state == RegressState::interrupted ? "was interrupted" : "has not come to its end";
  const RegressCheck check = failure("all", "end",
                                     fmt::format("the regression {}: {} of {} cases are checked",
                                                 what, report.cases.size(), report.n_wanted),
                                     base::ExitCode::interrupted);
  RegressedCase entry;
  entry.name = "diptych regress";
  entry.rows = {{"diptych", "regress", {check}}};
  return entry;
}

}  // namespace

std::string junit_xml(const RegressReport& report) {
  RegressReport whole = report;
  if (report.state != RegressState::done) whole.cases.push_back(unfinished(report));
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node suites = document.append_child("testsuites");
  set(suites, "name", "diptych regress");
  set_counts(suites, whole.rows());
  set_seconds(suites, report.seconds);
  for (const RegressedCase& entry : whole.cases)
    add_suite(suites, entry, report.provenance);
  std::ostringstream text;
  document.save(text, " ");
  return text.str();
}

}  // namespace diptych::harness
