/// JUnit XML of a regression.

#include "benchmarks/regression/report.hpp"

#include <cmath>
#include <fmt/format.h>
#include <pugixml.hpp>
#include <sstream>

namespace diptych::harness {

namespace {

constexpr const char* replacement = "\xEF\xBF\xBD";  // U+FFFD

/// Bytes of the UTF-8 character at `at`; 0 where there is none that XML 1.0 may hold.
size_t character_bytes(const std::string& text, size_t at) {
  const auto byte = [&](size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(at);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  const size_t n = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  unsigned code = first & (0x7Fu >> n);
  for (size_t i = 1; i < n; ++i) {
    if ((byte(at + i) & 0xC0u) != 0x80u) return 0;
    code = code << 6 | (byte(at + i) & 0x3Fu);
  }
  const bool overlong = (n == 3 && code < 0x800) || (n == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  const bool none = overlong || surrogate || code == 0xFFFE || code == 0xFFFF || code > 0x10FFFF;
  return none ? 0 : n;
}

/// The text with signs of replacement for what XML cannot hold even escaped; the rest is escaped by
/// the library.
std::string xml_text(const std::string& text) {
  std::string sound;
  for (size_t at = 0; at < text.size();) {
    const size_t n = character_bytes(text, at);
    sound += n == 0 ? replacement : text.substr(at, n);
    at += n == 0 ? 1 : n;
  }
  return sound;
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(xml_text(value).c_str());
}

void set_seconds(pugi::xml_node node, double seconds) {
  set(node, "time", fmt::format("{:.3f}", seconds));
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "none";
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
                     number(check.measured), number(check.bound), check.note);
}

struct Counts {
  size_t tests = 0, failures = 0, errors = 0, skipped = 0;
  void add(const RegressCheck& check) {
    ++tests;
    errors += is_error(check) ? 1 : 0;
    failures += check.verdict == Verdict::failed && !is_error(check) ? 1 : 0;
    skipped += check.verdict == Verdict::skipped ? 1 : 0;
  }
};

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
  Counts counts;
  for (const RegressRow& row : entry.rows) {
    for (const RegressCheck& check : row.checks)
      counts.add(check);
  }
  pugi::xml_node suite = suites.append_child("testsuite");
  set(suite, "name", entry.name);
  set(suite, "tests", std::to_string(counts.tests));
  set(suite, "failures", std::to_string(counts.failures));
  set(suite, "errors", std::to_string(counts.errors));
  set(suite, "skipped", std::to_string(counts.skipped));
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
  std::vector<RegressedCase> cases = report.cases;
  if (report.state != RegressState::done) cases.push_back(unfinished(report));
  Counts counts;
  for (const RegressedCase& entry : cases) {
    for (const RegressRow& row : entry.rows) {
      for (const RegressCheck& check : row.checks)
        counts.add(check);
    }
  }
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node suites = document.append_child("testsuites");
  set(suites, "name", "diptych regress");
  set(suites, "tests", std::to_string(counts.tests));
  set(suites, "failures", std::to_string(counts.failures));
  set(suites, "errors", std::to_string(counts.errors));
  set_seconds(suites, report.seconds);
  for (const RegressedCase& entry : cases)
    add_suite(suites, entry, report.provenance);
  std::ostringstream text;
  document.save(text, " ");
  return text.str();
}

}  // namespace diptych::harness
