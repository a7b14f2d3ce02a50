#include "benchmarks/regression/report.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace diptych::harness {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::met:
      return "met";
    case Verdict::known:
      return "known";
    case Verdict::skipped:
      return "skipped";
    default:
      return "failed";
  }
}

Json check_json(const RegressRow& row, const RegressCheck& check) {
  const bool failed = check.verdict == Verdict::failed;
  return {{"case", row.case_name},
          {"method", row.method},
          {"check", check.name},
          {"figure", check.figure},
          {"verdict", word_of(check.verdict)},
          {"kind", failed ? Json(kind_of(check.code)) : Json(nullptr)},
          {"measured", number(check.verdict == Verdict::skipped ? NAN : check.measured)},
          {"bound", number(check.verdict == Verdict::skipped ? NAN : check.bound)},
          {"at_least", check.at_least},
          {"note", check.note}};
}

Json case_json(const RegressedCase& entry) {
  return {{"case", entry.name},
          {"file", entry.file},
          {"baseline", entry.baseline},
          {"verdict", has_failed(entry.rows) ? "failed" : "met"},
          {"seconds", entry.seconds}};
}

Json totals_json(const RegressReport& report) {
  const VerdictCounts n = count_verdicts(report.rows());
  return {{"cases", report.cases.size()},
          {"cases_wanted", report.n_wanted},
          {"checks", n.all()},
          {"met", n.of(Verdict::met)},
          {"known", n.of(Verdict::known)},
          {"failed", n.of(Verdict::failed)},
          {"skipped", n.of(Verdict::skipped)}};
}

Json provenance_json(const io::Provenance& p) {
  return {{"version", p.version}, {"commit", p.commit},  {"compiler", p.compiler},
          {"flags", p.flags},     {"cpu", p.cpu},        {"instruction_set", p.instruction_set},
          {"date", p.date},       {"program", p.program}};
}

}  // namespace

const char* kind_of(base::ExitCode code) {
  switch (code) {
    case base::ExitCode::environment:
      return "environment";
    case base::ExitCode::wrong_input:
      return "input";
    case base::ExitCode::breakdown:
      return "breakdown";
    case base::ExitCode::interrupted:
      return "interrupted";
    default:
      return "bound";
  }
}

std::vector<RegressRow> RegressReport::rows() const {
  std::vector<RegressRow> all;
  for (const RegressedCase& entry : cases)
    all.insert(all.end(), entry.rows.begin(), entry.rows.end());
  return all;
}

std::string regress_json(const RegressReport& report) {
  const std::vector<RegressRow> rows = report.rows();
  std::string verdict = has_failed(rows) ? "failed" : "met";
  Json code = static_cast<int>(exit_code_of(rows));
  if (report.state == RegressState::running) {
    verdict = "running";
    code = nullptr;
  } else if (report.state == RegressState::interrupted) {
    verdict = "interrupted";
    code = static_cast<int>(base::ExitCode::interrupted);
  }
  Json json = {{"format", "diptych regress"},
               {"format_version", 1},
               {"verdict", verdict},
               {"exit_code", code},
               {"seconds", report.seconds},
               {"cases_folder", report.cases_folder},
               {"baselines_folder", report.baselines_folder},
               {"totals", totals_json(report)},
               {"provenance", provenance_json(report.provenance)}};
  json["cases"] = Json::array();
  json["checks"] = Json::array();
  for (const RegressedCase& entry : report.cases)
    json["cases"].push_back(case_json(entry));
  for (const RegressRow& row : rows) {
    for (const RegressCheck& check : row.checks)
      json["checks"].push_back(check_json(row, check));
  }
  // what is no UTF-8 (names of files may be any bytes) becomes the sign of replacement
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace diptych::harness
