/// history.csv: one header line of names with units, one line per output time. Numbers are written
/// with 17 significant digits, so reading gives back the same doubles; both ways are independent of
/// the locale. Test: tests/common/io/history_test.cpp

#include "common/base/error.hpp"
#include "common/io/run_record.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <string_view>

namespace diptych::io {
namespace {

/// Columns before the probes, in order. In two dimensions energies and momenta are per metre of
/// thickness.
constexpr std::array<std::string_view, 20> fixed_columns{
    "time [s]",
    "step",
    "dt [s]",
    "kinetic energy [J]",
    "strain energy [J]",
    "viscous dissipation [J]",
    "numerical dissipation [J]",
    "external work [J]",
    "projection work [J]",
    "relative energy residual",
    "linear momentum x [kg m/s]",
    "linear momentum y [kg m/s]",
    "linear momentum z [kg m/s]",
    "angular momentum x [kg m^2/s]",
    "angular momentum y [kg m^2/s]",
    "angular momentum z [kg m^2/s]",
    "min jacobian",
    "involution H",
    "involution J",
    "least cell J",
};

/// RFC 4180: a name with a comma, a quote or a line break stands in quotes, its quotes doubled.
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string result = "\"";
  for (const char c : name) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

/// Reads records of RFC 4180 one after the other and knows the line it is on.
class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  bool at_end() const { return position_ >= text_.size(); }
  int line() const { return line_; }

  std::vector<std::string> record() {
    line_ = next_line_;
    std::vector<std::string> cells(1);
    bool in_quotes = false;
    while (!at_end()) {
      const char c = text_[position_++];
      if (c == '\n') ++next_line_;
      if (in_quotes) {
        read_quoted(c, cells.back(), in_quotes);
      } else if (c == '\n') {
        return cells;
      } else if (c == ',') {
        cells.emplace_back();
      } else if (c == '"' && cells.back().empty()) {
        in_quotes = true;
      } else if (c != '\r') {
        cells.back() += c;
      }
    }
    if (in_quotes) fail("a quoted name is not closed");
    fail("the last line is not ended: the file was cut off");
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw base::InputError(fmt::format("{}:{}: {}", path_, line_, what));
  }

 private:
  void read_quoted(char c, std::string& cell, bool& in_quotes) {
    if (c != '"') {
      cell += c;
    } else if (position_ < text_.size() && text_[position_] == '"') {
      cell += text_[position_++];
    } else {
      in_quotes = false;
    }
  }

  std::string_view text_;
  const std::string& path_;
  size_t position_ = 0;
  int line_ = 1, next_line_ = 1;
};

/// Takes the cells of one row from left to right.
class RowReader {
 public:
  RowReader(const CsvReader& file,
            const std::vector<std::string>& header,
            const std::vector<std::string>& cells)
      : file_(file), header_(header), cells_(cells) {
    if (cells.size() != header.size()) {
      file.fail(fmt::format("{} values under {} columns", cells.size(), header.size()));
    }
  }

  double number() {
    const auto value = read<double>("a number");
    if (!std::isfinite(value)) fail("a finite number");
    return value;
  }
  std::int64_t count() {
    const auto value = read<std::int64_t>("a whole number");
    if (value < 0) fail("a whole number >= 0");
    return value;
  }
  bool at_end() const { return column_ == cells_.size(); }

 private:
  template <class Number>
  Number read(const char* expected) {
    const std::string& cell = cells_[column_++];
    Number value{};
    const char* end = cell.data() + cell.size();
    const auto result = std::from_chars(cell.data(), end, value);
    if (result.ec != std::errc() || result.ptr != end) fail(expected);
    return value;
  }

  [[noreturn]] void fail(const char* expected) const {
    file_.fail(fmt::format("column '{}' holds '{}', expected {}", header_[column_ - 1],
                           cells_[column_ - 1], expected));
  }

  const CsvReader& file_;
  const std::vector<std::string>& header_;
  const std::vector<std::string>& cells_;
  size_t column_ = 0;
};

std::vector<std::string> checked_header(CsvReader& file) {
  if (file.at_end()) file.fail("the file is empty");
  std::vector<std::string> header = file.record();
  for (size_t i = 0; i < fixed_columns.size(); ++i) {
    if (i >= header.size()) file.fail(fmt::format("column '{}' is missing", fixed_columns[i]));
    if (header[i] != fixed_columns[i]) {
      file.fail(
          fmt::format("column {} is '{}', expected '{}'", i + 1, header[i], fixed_columns[i]));
    }
  }
  return header;
}

HistoryRow read_row(RowReader& cells) {
  HistoryRow row;
  row.time = cells.number();
  row.step = cells.count();
  row.dt = cells.number();
  row.energy.kinetic = cells.number();
  row.energy.strain = cells.number();
  row.energy.viscous_dissipation = cells.number();
  row.energy.numerical_dissipation = cells.number();
  row.energy.external_work = cells.number();
  row.energy.projection_work = cells.number();
  row.energy.relative_residual = cells.number();
  for (double& component : row.linear_momentum)
    component = cells.number();
  for (double& component : row.angular_momentum)
    component = cells.number();
  row.min_jacobian = cells.number();
  row.involution_H = cells.number();
  row.involution_J = cells.number();
  row.least_cell_J = cells.number();
  while (!cells.at_end())
    row.probes.push_back(cells.number());
  return row;
}

void append_row(fmt::memory_buffer& text, const HistoryRow& row) {
  const EnergySummary& energy = row.energy;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:.17g},{},{:.17g}", row.time, row.step, row.dt);
  for (const double value :
       {energy.kinetic, energy.strain, energy.viscous_dissipation, energy.numerical_dissipation,
        energy.external_work, energy.projection_work, energy.relative_residual,
        row.linear_momentum[0], row.linear_momentum[1], row.linear_momentum[2],
        row.angular_momentum[0], row.angular_momentum[1], row.angular_momentum[2], row.min_jacobian,
        row.involution_H, row.involution_J, row.least_cell_J}) {
    fmt::format_to(out, ",{:.17g}", value);
  }
  for (const double value : row.probes)
    fmt::format_to(out, ",{:.17g}", value);
  text.push_back('\n');
}

}  // namespace

std::string history_header(const std::vector<std::string>& probe_names) {
  std::string text = fmt::format("{}", fmt::join(fixed_columns, ","));
  for (const std::string& name : probe_names)
    text += fmt::format(",{}", quoted(name));
  return text + "\n";
}

std::string history_line(const HistoryRow& row) {
  fmt::memory_buffer text;
  append_row(text, row);
  return fmt::to_string(text);
}

std::string history_csv(const std::vector<HistoryRow>& rows,
                        const std::vector<std::string>& probe_names) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{}", history_header(probe_names));
  for (const HistoryRow& row : rows) {
    if (row.probes.size() != probe_names.size()) {
      throw std::logic_error(fmt::format("history_csv: {} probe values for {} probes",
                                         row.probes.size(), probe_names.size()));
    }
    append_row(text, row);
  }
  return fmt::to_string(text);
}

std::string steps_header(const std::vector<std::string>& probe_names) {
  std::string text = "time [s],step";
  for (const std::string& name : probe_names)
    text += fmt::format(",{}", quoted(name));
  return text + "\n";
}

std::string steps_line(const StepRow& row) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:.17g},{}", row.time, row.step);
  for (const double value : row.probes)
    fmt::format_to(out, ",{:.17g}", value);
  text.push_back('\n');
  return fmt::to_string(text);
}

std::string steps_csv(const std::vector<StepRow>& rows,
                      const std::vector<std::string>& probe_names) {
  std::string text = steps_header(probe_names);
  for (const StepRow& row : rows)
    text += steps_line(row);
  return text;
}

std::vector<HistoryRow> history_from_csv(const std::string& text, const std::string& path) {
  CsvReader file(text, path);
  const std::vector<std::string> header = checked_header(file);
  std::vector<HistoryRow> rows;
  while (!file.at_end()) {
    const std::vector<std::string> cells = file.record();
    RowReader reader(file, header, cells);
    rows.push_back(read_row(reader));
  }
  return rows;
}

namespace {

/// The lines below the header.
std::vector<HistoryColumn> columns_under(const std::vector<std::string>& header, CsvReader& file) {
  std::vector<HistoryColumn> columns;
  for (const std::string& title : header) {
    const size_t bracket = title.rfind(" [");
    const bool has_unit = bracket != std::string::npos && title.back() == ']';
    columns.push_back({title.substr(0, has_unit ? bracket : title.npos),
                       has_unit ? title.substr(bracket + 2, title.size() - bracket - 3) : "-",
                       {}});
  }
  while (!file.at_end()) {
    const std::vector<std::string> cells = file.record();
    RowReader reader(file, header, cells);
    for (HistoryColumn& column : columns)
      column.values.push_back(reader.number());
  }
  return columns;
}

}  // namespace

std::vector<HistoryColumn> history_columns_from_csv(const std::string& text,
                                                    const std::string& path) {
  CsvReader file(text, path);
  const std::vector<std::string> header = checked_header(file);
  return columns_under(header, file);
}

std::vector<HistoryColumn> columns_from_csv(const std::string& text, const std::string& path) {
  CsvReader file(text, path);
  if (file.at_end()) file.fail("the file is empty");
  const std::vector<std::string> header = file.record();
  return columns_under(header, file);
}

std::string columns_csv(const std::vector<HistoryColumn>& columns) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (size_t k = 0; k < columns.size(); ++k) {
    const HistoryColumn& column = columns[k];
    fmt::format_to(out, "{}{}", k > 0 ? "," : "",
                   quoted(fmt::format("{} [{}]", column.name, column.unit)));
  }
  text.push_back('\n');
  const size_t n_rows = columns.empty() ? 0 : columns.front().values.size();
  for (size_t i = 0; i < n_rows; ++i) {
    for (size_t k = 0; k < columns.size(); ++k)
      fmt::format_to(out, "{}{:.17g}", k > 0 ? "," : "", columns[k].values.at(i));
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

std::vector<std::string> probe_names_from_csv(const std::string& text, const std::string& path) {
  CsvReader file(text, path);
  std::vector<std::string> header = checked_header(file);
  header.erase(header.begin(), header.begin() + fixed_columns.size());
  return header;
}

}  // namespace diptych::io
