/// Numbers of the pages are those of the tables they quote and of the baselines, and the check
/// catches what it should.

#include "tests/style/quoted_numbers.hpp"

#include "tests/folders.hpp"
#include "tests/style/page_links.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace diptych::tests {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace fs = std::filesystem;
const fs::path root = source_folder();

nlohmann::json baseline_of(const std::string& name) {
  return nlohmann::json::parse(text_of_page(root / "benchmarks/baselines" / (name + ".json")));
}

/// By how many bars the methods disagree, of all baselines, as a page of tables.
std::string disagreements() {
  std::string list = "| case | file |\n|---|---|\n", sections;
  for (const auto& entry : fs::directory_iterator(root / "benchmarks/baselines")) {
    const std::string name = entry.path().stem().string();
    list += "| " + name + " | `" + name + ".toml` |\n";
    sections +=
        "\n## " + name + "\n\n**levels 0 and 1**\n\n| method | quantity | bars |\n|---|---|---|\n";
    const nlohmann::json baseline = baseline_of(name);
    for (const auto& [quantity, bars] : baseline["disagreement"].items())
      sections += "| both | " + quantity + " | " + bars.dump() + " |\n";
  }
  return list + sections;
}

std::map<std::string, std::string> generated_pages() {
  return {{"VERIFICATION.md", text_of_page(root / "benchmarks/VERIFICATION.md")},
          {"LITERATURE.md", text_of_page(root / "benchmarks/LITERATURE.md")},
          {"baselines", disagreements()}};
}

TEST(QuotedNumbers, OfAllPagesAreThoseOfTheGeneratedTables) {
  const auto generated = generated_pages();
  int count = 0;
  std::string complaints;
  for (const fs::path& page : pages_of_project(root)) {
    for (const std::string& complaint : check_quotes(text_of_page(page), generated, count))
      complaints += "\n  " + page.string() + ":" + complaint;
  }
  EXPECT_EQ(complaints, "");
  EXPECT_GT(count, 20) << "the pages have lost their quotes";
}

/// The line of a case in AGREEMENT.md.
std::string agreement_of(const std::string& name) {
  const std::string page = text_of_page(root / "benchmarks/AGREEMENT.md");
  const size_t at = page.find("\n| " + name + " | ");
  return at == std::string::npos ? "" : page.substr(at + 1, page.find('\n', at + 1) - at - 1);
}

/// In the cases that are shipped, and nothing else is; of those of users regress only says so.
TEST(Disagreements, AreExplainedInTheirCases) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(root / "benchmarks/baselines")) {
    const std::string name = entry.path().stem().string();
    const std::string text = text_of_page(root / "benchmarks/cases" / name / "case.toml");
    const nlohmann::json baseline = baseline_of(name);
    for (const auto& [quantity, bars] : baseline["disagreement"].items()) {
      ++count;
      EXPECT_THAT(text, HasSubstr("[[apart]]\nquantity = \"" + quantity + "\"")) << name;
    }
    const std::string opening = "[[apart]]\nquantity = \"";
    for (size_t at = text.find(opening); at != std::string::npos; at = text.find(opening, at + 1)) {
      const size_t begin = at + opening.size();
      const std::string quantity = text.substr(begin, text.find('"', begin) - begin);
      EXPECT_TRUE(baseline["disagreement"].contains(quantity) ||
                  agreement_of(name).find("**apart** " + quantity) != std::string::npos)
          << name << " explains " << quantity
          << ", which neither its baseline nor AGREEMENT.md has apart";
    }
  }
  EXPECT_GT(count, 4);
}

/// The text of `text = \"\"\"...\"\"\"` or `note = ...` of a table's file; empty where it has none.
std::string text_of_key(const std::string& toml, const std::string& key) {
  const std::string open = "\n" + key + " = \"\"\"\n";
  const size_t at = toml.find(open);
  if (at == std::string::npos) return "";
  const size_t begin = at + open.size();
  return toml.substr(begin, toml.find("\"\"\"", begin) - begin);
}

TEST(QuotedNumbers, OfTheNotesOfTablesStandOnThePages) {
  for (const auto& [folder, page] :
       {std::pair("verification", "VERIFICATION.md"), std::pair("literature", "LITERATURE.md")}) {
    const std::string text = text_of_page(root / "benchmarks" / page);
    for (const auto& entry : fs::directory_iterator(root / "benchmarks" / folder)) {
      const std::string toml = text_of_page(entry.path());
      EXPECT_NE(text_of_key(toml, "text"), "") << entry.path();
      for (const char* key : {"text", "note"})
        EXPECT_THAT(text, HasSubstr(text_of_key(toml, key)))
            << entry.path() << ": make " << page << " again (benchmarks/verify)";
    }
  }
}

// ---- tables of the pages of cases (benchmarks/measured) against the baselines
/// What a baseline has under the heading of a column or row; nothing where it keeps no such figure.
std::optional<double> baseline_value(const nlohmann::json& method, const std::string& heading) {
  static const std::map<std::string, std::pair<std::string, std::string>> names{
      {"v", {"errors", "velocity L2"}},
      {"u", {"errors", "displacement L2"}},
      {"P", {"errors", "stress L2"}},
      {"rel. energy residual", {"quantities", "energy residual"}},
      {"numerical dissipation [J]", {"quantities", "numerical dissipation"}}};
  const auto known = names.find(heading);
  const std::string group = known == names.end() ? "quantities" : known->second.first;
  const std::string name = known == names.end() ? heading : known->second.second;
  if (!method.contains(group) || !method[group].contains(name)) return std::nullopt;
  return method[group][name]["value"].get<double>();
}

/// Complaints about numbers of a cell: one, or "end (least to greatest)" of a probe.
std::string check_cell(const nlohmann::json& method,
                       const std::string& heading,
                       const std::string& cell,
                       int& count) {
  const std::string probe = heading.substr(0, heading.rfind(" ["));
  const bool is_probe = cell.find(" to ") != std::string::npos;
  const std::vector<std::string> parts =
      is_probe ? std::vector<std::string>{", final", ", least", ", greatest"}
               : std::vector<std::string>{""};
  const std::vector<std::string> numbers = numbers_in(cell);
  for (size_t i = 0; i < std::min(parts.size(), numbers.size()); ++i) {
    const auto made = baseline_value(method, is_probe ? probe + parts[i] : heading);
    if (!made || numbers.size() != parts.size()) continue;
    ++count;
    // what is zero but for rounding is not the same on another processor
    const WrittenNumber told = *written_number(numbers[i]);
    const bool is_rounding = std::abs(*made) < 1e-8 && std::abs(told.value) < 1e-8;
    if (!agree(told, {*made, 1e-8 * std::abs(*made)}) && !is_rounding)
      return "\n  " + heading + parts[i] + ": " + numbers[i] + " is " + std::to_string(*made);
  }
  return "";
}

/// The table below `<!-- measured: ... -->` of a page; empty where there is none.
std::optional<PageTable> measured_table(const std::string& page) {
  const size_t at = page.find("<!-- measured: ");
  if (at == std::string::npos) return std::nullopt;
  const std::vector<PageTable> tables = tables_of(page.substr(at));
  return tables.empty() ? std::nullopt : std::optional(tables.front());
}

TEST(QuotedNumbers, OfTheTablesOfCasesAreThoseOfTheBaselines) {
  int count = 0;
  for (const auto& folder : fs::directory_iterator(root / "benchmarks/cases")) {
    const std::string name = folder.path().filename().string();
    const auto table = measured_table(text_of_page(folder.path() / "README.md"));
    if (!table) continue;
    const nlohmann::json baseline = baseline_of(name);
    if (!baseline["set"].empty()) continue;  // the regression runs it at another size
    for (const auto& row : table->rows) {
      ASSERT_EQ(row.size(), table->head.size()) << name << ": benchmarks/measured " << name;
      for (size_t c = 1; c < row.size(); ++c) {
        const bool by_rows = table->head[0] == "method";
        if (by_rows && row[1] != "0") continue;
        const std::string method = by_rows                     ? row[0]
                                   : table->head[c] == "SPH 0" ? "sph"
                                   : table->head[c] == "FVM 0" ? "fvm"
                                                               : "";
        if (method.empty()) continue;
        const std::string heading = by_rows ? table->head[c] : row[0];
        EXPECT_EQ(check_cell(baseline["methods"][method], heading, row[c], count), "")
            << name << " " << method << ": benchmarks/measured " << name << " remakes the table";
      }
    }
  }
  EXPECT_GT(count, 200) << "the pages have lost their tables";
}

// ---- the check itself
const std::string sample = R"(# Page

| table | file         |
|-------|--------------|
| Waves | `waves.toml` |

## Waves

**fine, 2 %** (`wave`)

| method        | with           | level |        v | order | height [m] |
|---------------|----------------|------:|---------:|------:|-----------:|
| SPH           | time.cfl = 0.4 |     1 | 1.26e-02 |     - |      0.113 |
| Finite volume | time.cfl = 0.2 |     1 |     0.5  |  1.86 |        -12 |

Extrapolated from the three finest levels:

| quantity | method        | finest level |        agree |
|----------|---------------|-------------:|-------------:|
| tip [m]  | SPH           |        0.113 |              |
|          | Finite volume |        0.114 | **no**, 5.5 of the bars |
)";

std::vector<std::string> complaints(const std::string& text) {
  int count = 0;
  return check_quotes(text, {{"PAGE.md", sample}}, count);
}

TEST(QuotedNumbersCheck, TakesNumbersRoundedToTheirDigits) {
  EXPECT_THAT(complaints("about 0.0126 <!-- from: PAGE.md; waves; fine, 2 %; SPH 1; v -->"),
              IsEmpty());
  EXPECT_THAT(complaints("1.3 % <!-- from: PAGE.md; waves; fine, 2 %; SPH 1; v -->, more"),
              IsEmpty());
  EXPECT_THAT(complaints("order 1.9, height -12 "
                         "<!-- from: PAGE.md; waves; fine, 2 %; FVM 1; order of v; height [m] -->"),
              IsEmpty());
  EXPECT_THAT(
      complaints("113 mm <!-- from: PAGE.md; waves; fine, 2 %; SPH 1 time.cfl = 0.4; 1000 * "
                 "height [m] -->"),
      IsEmpty());
  EXPECT_THAT(
      complaints("by 5.5 bars <!-- from: PAGE.md; waves; fine, 2 %; FVM tip [m]; agree -->"),
      IsEmpty());
}

TEST(QuotedNumbersCheck, CatchesWhatTheTableDoesNotHave) {
  EXPECT_THAT(
      complaints("0.1 % <!-- from: PAGE.md; waves; fine, 2 %; SPH 1; v -->"),
      ElementsAre(HasSubstr("0.1 % is quoted, but waves; fine, 2 %; SPH 1; v is 1.26e-02")));
  for (const char* wrong :
       {"PAGE.md; tides; fine, 2 %; SPH 1; v", "PAGE.md; waves; coarse; SPH 1; v",
        "PAGE.md; waves; fine, 2 %; SPH 2; v", "PAGE.md; waves; fine, 2 %; SPH 1; w",
        "PAGE.md; waves; fine, 2 %; SPH 1", "NONE.md; waves; fine, 2 %; SPH 1; v",
        "PAGE.md; waves; fine, 2 %; SPH 1; order of v"})
    EXPECT_THAT(complaints("0.0126 <!-- from: " + std::string(wrong) + " -->"), SizeIs(1)) << wrong;
  EXPECT_THAT(complaints("\nnothing <!-- from: PAGE.md; waves; fine, 2 %; SPH 1; v -->"),
              ElementsAre("2: fewer numbers than columns"));
  EXPECT_THAT(complaints("0.0126 <!-- from: PAGE.md; waves;\nfine, 2 %; SPH 1; v -->"), SizeIs(1));
}

TEST(QuotedNumbersCheck, ReadsNumbersAndNothingElse) {
  EXPECT_THAT(numbers_in("| 1/32 | kappa1.2 | 1.00e8 | 2.5e-3, 1.75 (-4) 36 %. H2"),
              ElementsAre("1.00e8", "2.5e-3", "1.75", "-4", "36 %"));
  EXPECT_DOUBLE_EQ(written_number("2.5e-3")->half_unit, 5e-5);
  EXPECT_DOUBLE_EQ(written_number("36 %")->half_unit, 0.005);
}

}  // namespace
}  // namespace diptych::tests
