/// Verification tables as Markdown, aligned so that they read as plain text too.

#include "benchmarks/probes/machine_probes.hpp"
#include "benchmarks/run/provenance.hpp"
#include "benchmarks/terminal/progress.hpp"
#include "benchmarks/terminal/text.hpp"
#include "benchmarks/verifier/verification.hpp"
#include "common/parallel/for_chunks.hpp"
#include "postprocess/report/orders.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace diptych::harness {

std::string markdown_table(const std::vector<std::vector<std::string>>& lines, size_t left) {
  std::vector<size_t> width(lines[0].size(), 3);
  for (const auto& line : lines) {
    for (size_t c = 0; c < line.size(); ++c)
      width[c] = std::max(width[c], line[c].size());
  }
  std::string text;
  for (size_t i = 0; i < lines.size(); ++i) {
    for (size_t c = 0; c < lines[i].size(); ++c) {
      text += c < left ? fmt::format("| {:<{}} ", lines[i][c], width[c])
                       : fmt::format("| {:>{}} ", lines[i][c], width[c]);
    }
    text += "|\n";
    if (i > 0) continue;
    for (size_t c = 0; c < lines[0].size(); ++c)
      text += fmt::format("|{:-<{}}{}", "", width[c] + 1, c < left ? '-' : ':');
    text += "|\n";
  }
  return text;
}

std::string table_number(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (value != 0 && (size < 0.01 || size >= 1e5)) return fmt::format("{:.2e}", value);
  return fmt::format("{:.3g}", value);
}

namespace {

using Cells = std::vector<std::string>;

/// The columns of one group; size and steps stand in the first.
std::string values_table(const VerificationResult& result, size_t r, const std::string& group) {
  const VerificationTable& table = result.table;
  const VerificationRun& entry = table.runs[r];
  const bool varied = !entry.vary.empty();
  Cells head{"method"};
  if (varied) head.push_back("with");
  head.push_back("level");
  if (group.empty()) head.insert(head.end(), {"h [m]", "nodes", "steps"});
  for (const VerificationColumn& column : table.columns) {
    if (column.group != group) continue;
    head.push_back(column.title);
    if (column.order) head.push_back("order");
  }
  std::vector<Cells> lines{head};
  for (const VerificationSequence& sequence : result.sequences) {
    if (sequence.run != r) continue;
    for (const VerificationRow& row : sequence.rows) {
      const io::RunSummary& run = row.summary;
      Cells line{report::method_title(sequence.method)};
      if (varied) line.push_back(row.label);
      line.push_back(std::to_string(run.level));
      const bool ran = row.failure.empty();
      if (group.empty()) {
        line.push_back(ran ? table_number(run.spacing) : "-");
        line.push_back(ran ? std::to_string(run.nodes) : "-");
        line.push_back(ran ? std::to_string(run.steps) : "failed");
      }
      for (size_t c = 0; c < table.columns.size(); ++c) {
        if (table.columns[c].group != group) continue;
        line.push_back(table_number(row.value[c]));
        if (table.columns[c].order) line.push_back(number_text(row.order[c], "{:.2f}"));
      }
      lines.push_back(line);
    }
  }
  return markdown_table(lines, varied ? 2 : 1);
}

std::string run_section(const VerificationResult& result, size_t r) {
  const VerificationRun& entry = result.table.runs[r];
  std::string text = fmt::format("**{}** (`{}`", entry.name, entry.case_name);
  if (!entry.set.empty()) text += fmt::format(", with `{}`", fmt::join(entry.set, "`, `"));
  text += ")\n\n" + values_table(result, r, "");
  std::vector<std::string> groups{""};
  for (const VerificationColumn& column : result.table.columns) {
    if (std::find(groups.begin(), groups.end(), column.group) != groups.end()) continue;
    groups.push_back(column.group);
    text += "\n" + column.group + ":\n\n" + values_table(result, r, column.group);
  }
  for (const VerificationSequence& sequence : result.sequences) {
    if (sequence.run != r) continue;
    for (const VerificationRow& row : sequence.rows) {
      if (!row.failure.empty())
        text += fmt::format("\n{} at level {}: {}\n", report::method_title(sequence.method),
                            row.summary.level, row.failure);
      if (const auto from = row.summary.inverted_from) {
        text += fmt::format(
            "\n{} at level {}: from t = {:.4g} s on cells are inside out (up to {} of them, least "
            "cell J {:.3g}): what comes after is not to be used.\n",
            report::method_title(sequence.method), row.summary.level, *from,
            row.summary.most_inverted_cells, row.summary.least_cell_J);
      }
    }
  }
  return text + estimates_section(result, r) + "\n";
}

/// A line for each thing asked of a run, the methods beside each other.
std::string verdicts_table(const VerificationResult& result) {
  std::vector<std::string> methods;
  for (const auto& verdict : result.verdicts) {
    if (std::find(methods.begin(), methods.end(), verdict.method) == methods.end())
      methods.push_back(verdict.method);
  }
  Cells head{"run", "quantity", "asked"};
  for (const std::string& method : methods)
    head.push_back(report::method_title(method));
  std::vector<Cells> lines{head};
  std::vector<std::array<std::string, 3>> keys{{}};
  for (const auto& verdict : result.verdicts) {
    const std::array<std::string, 3> key{verdict.run, verdict.column, verdict.asked};
    auto found = std::find(keys.begin(), keys.end(), key);
    if (found == keys.end()) {
      keys.push_back(key);
      found = keys.end() - 1;
      Cells line{key[0], key[1], key[2]};
      line.resize(3 + methods.size(), "-");
      lines.push_back(line);
    }
    const auto column = std::find(methods.begin(), methods.end(), verdict.method);
    lines[static_cast<size_t>(found - keys.begin())]
         [3 + static_cast<size_t>(column - methods.begin())] =
             verdict.measured + (verdict.met ? ", met" : ", **NOT met**");
  }
  return markdown_table(lines, 3);
}

size_t n_met(const VerificationResult& result) {
  return static_cast<size_t>(std::count_if(result.verdicts.begin(), result.verdicts.end(),
                                           [](const auto& verdict) { return verdict.met; }));
}

std::string bounds_met(const VerificationResult& result) {
  return result.verdicts.empty() ? "none asked"
                                 : fmt::format("{} of {}", n_met(result), result.verdicts.size());
}

std::string table_section(const VerificationResult& result) {
  const VerificationTable& table = result.table;
  std::string text = fmt::format("## {}\n\n{}\n\n", table.title, table.text);
  for (size_t r = 0; r < table.runs.size(); ++r)
    text += run_section(result, r);
  if (!result.verdicts.empty()) text += "Asked and measured:\n\n" + verdicts_table(result) + "\n";
  if (!table.note.empty()) text += table.note + "\n\n";
  return text;
}

std::string overview(const std::vector<VerificationResult>& results) {
  std::vector<Cells> lines{{"table", "file", "bounds met", "time of its runs"}};
  for (const auto& result : results) {
    double seconds = 0;
    for (const auto& sequence : result.sequences) {
      for (const auto& row : sequence.rows)
        seconds += row.summary.wall_seconds * result.table.repeat;
    }
    lines.push_back({result.table.title, "`" + result.table.name + ".toml`", bounds_met(result),
                     duration_text(seconds)});
  }
  return markdown_table(lines, 2);
}

constexpr const char* of_verification =
    "Errors are relative L2 norms at the end of the run, of velocity v, displacement u = x - X, F "
    "- "
    "I, first Piola-Kirchhoff\nstress P, and A = C_v^-1 - I, unless a table says otherwise. Orders "
    "are between a row and the one above. Times are\nthose of one machine on one day.";

constexpr const char* of_literature =
    "Extrapolated values, orders and error bars come from the three finest levels (Richardson; the "
    "grid convergence index,\nGCI, is the bar over the finest value; where values oscillate or "
    "diverge no order stands and the bar is three times\ntheir range). \"agree\": whether |SPH - "
    "FVM| on the finest level is within the sum of both bars, where each method shows an order "
    "within\n"
    "0.5 of its own and a bar of at most 5 % of the largest value; else \"unresolved\", and why: "
    "near where they are no further\napart than three times what three levels change by, far where "
    "they are, if that is below the same 5 %. Energies are those at the end.\nFlop are counted as "
    "147 a pair update (benchmarks/probes/work_counts.hpp).";

/// As a block of code in Markdown.
std::string indented(const std::string& text) {
  std::string block;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    block += "    " + text.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return block;
}

/// What stands above the tables of a page.
struct Heading {
  std::string title, command, folder;  ///< command: that makes it; folder: where its tables are
  std::string introduction;            ///< Markdown
};

Heading heading_of(VerificationSet set) {
  if (set == VerificationSet::verification)
    return {"Verification", "benchmarks/verify", "benchmarks/verification", of_verification};
  const int threads = parallel::n_threads();
  return {"Cases of the literature", "benchmarks/verify --literature", "benchmarks/literature",
          fmt::format(
              "Cases without an exact solution, both methods, {} thread{}. A pair update is one "
              "directed pair in one stage. What the\nmachine could do, measured after the "
              "runs:\n\n{}\n{}",
              threads, threads == 1 ? "" : "s",
              indented(probes::probes_text(probes::measure_machine(threads))), of_literature)};
}

}  // namespace

std::string verification_page(const std::vector<VerificationResult>& results,
                              VerificationSet set,
                              bool quick) {
  const Heading page = heading_of(set);
  const io::Provenance p = provenance("");
  std::string text = fmt::format(
      "# {}\n\nMade by `{}`{} on {} with commit {} ({}, {}, {}).\nDo not edit: each table is a "
      "file "
      "of `{}`, which says what is run and asked.\n\n{}\n\n",
      page.title, page.command,
      quick ? " (quick: one level less; bounds are asked of the full tables)" : "",
      p.date.substr(0, 10), p.commit, p.compiler, p.cpu, p.instruction_set, page.folder,
      page.introduction);
  text += overview(results) + "\n";
  for (const auto& result : results)
    text += table_section(result);
  while (text.ends_with("\n\n"))
    text.pop_back();
  return text;
}

std::string verification_lines(const VerificationResult& result) {
  std::string text = fmt::format("{}: bounds met: {}\n", result.table.title, bounds_met(result));
  for (const auto& verdict : result.verdicts) {
    if (!verdict.met)
      text += fmt::format("  NOT met: {}, {} ({}): {}, asked {}\n", verdict.column, verdict.run,
                          verdict.method, verdict.measured, verdict.asked);
  }
  return text;
}

}  // namespace diptych::harness
