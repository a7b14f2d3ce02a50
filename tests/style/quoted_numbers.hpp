#pragma once
/// Numbers that pages quote, against what made them: tables of VERIFICATION.md and LITERATURE.md,
/// and baselines. A quote carries a comment behind its numbers, on the same line:
///
///   order 2.05 and 1.92 <!-- from: VERIFICATION.md; sph-support; regular, kappa 0.75; SPH 3;
///                            order of v; order of u -->       (one line in the page)
///
/// page; table (its file, without .toml); the run in bold above it; row; columns. The row is the
/// method with the level, with "LEVEL WITH" where rows vary a key, or with the quantity in tables
/// of extrapolated values. As many numbers as there are columns, the last ones before the comment,
/// must be those of the table within half a unit of the last digit of either. "%" divides by a
/// hundred; "1000 * COLUMN" multiplies what the table has, as from m to mm.

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace diptych::tests {

/// A number as it is written, and half a unit of its last digit.
struct WrittenNumber {
  double value = 0, half_unit = 0;
};

/// "1.23e-04", "2.01", "35937", "36 %"; nothing where the text starts with none.
inline std::optional<WrittenNumber> written_number(const std::string& text) {
  static const std::regex form(R"(^\s*([-+]?)(\d+)(?:\.(\d*))?(?:e([-+]?\d+))?(\s*%)?)");
  std::smatch m;
  if (!std::regex_search(text, m, form)) return std::nullopt;
  const int exponent = (m[4].matched ? std::stoi(m[4]) : 0) - (m[5].matched ? 2 : 0);
  const double size = std::stod(m[2].str() + "." + m[3].str() + "0");
  const double scale = std::pow(10.0, exponent);
  return WrittenNumber{(m[1] == "-" ? -size : size) * scale,
                       0.5 * scale * std::pow(10.0, -static_cast<double>(m[3].length()))};
}

/// Whether two numbers may be one, rounded to the digits that each has.
inline bool agree(const WrittenNumber& a, const WrittenNumber& b) {
  const double rounding = 1e-9 * (std::abs(a.value) + std::abs(b.value));
  return std::abs(a.value - b.value) <= a.half_unit + b.half_unit + rounding;
}

inline std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Parts between separators, without the blanks around them.
inline std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
    parts.push_back(trimmed(part));
  return parts;
}

/// Cells of "| a | b |".
inline std::vector<std::string> cells_of(const std::string& line) {
  const size_t first = line.find('|'), last = line.rfind('|');
  return first == last ? std::vector<std::string>{}
                       : parts_of(line.substr(first + 1, last - first - 1), '|');
}

/// A table in Markdown with what stands above it.
struct PageTable {
  std::string title, run;  ///< of the section, and in bold
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

inline std::vector<PageTable> tables_of(const std::string& page) {
  std::vector<PageTable> tables;
  std::istringstream lines(page);
  std::string title, run;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("## ", 0) == 0) {
      title = line.substr(3);
      run.clear();
    }
    if (line.rfind("**", 0) == 0) run = line.substr(2, line.find("**", 2) - 2);
    if (line.rfind("|", 0) != 0) {
      inside = false;
    } else if (!inside) {
      inside = true;
      tables.push_back({title, run, cells_of(line), {}});
    } else if (line.find("--") != 1 && line.find(":-") != 1) {
      tables.back().rows.push_back(cells_of(line));
    }
  }
  return tables;
}

/// The title of the section of a table, from the list at the top of a page: its file is in a
/// column.
inline std::string title_of(const std::vector<PageTable>& tables, const std::string& name) {
  for (const PageTable& table : tables) {
    for (const auto& row : table.rows) {
      if (row.size() > 1 && row[1] == "`" + name + ".toml`") return row[0];
    }
  }
  return "";
}

/// Number of a column: "v", or "order of v" for the column of orders behind it; -1 where there is
/// none.
inline int column_of(const std::vector<std::string>& head, const std::string& name) {
  const bool is_order = name.rfind("order of ", 0) == 0;
  const std::string base = is_order ? name.substr(9) : name;
  for (size_t c = 0; c < head.size(); ++c) {
    if (head[c] != base) continue;
    if (!is_order) return static_cast<int>(c);
    return c + 1 < head.size() && head[c + 1] == "order" ? static_cast<int>(c) + 1 : -1;
  }
  return -1;
}

/// Whether a row is the one that a quote names, "SPH 3": by its level, level and varied key, or
/// quantity. @param quantity  of the row or, where it is left blank, of one above
inline bool is_row(const PageTable& table,
                   const std::vector<std::string>& row,
                   const std::string& quantity,
                   const std::string& key) {
  const auto cell = [&](const char* name) {
    const int c = column_of(table.head, name);
    return c >= 0 && static_cast<size_t>(c) < row.size() ? row[static_cast<size_t>(c)] : "";
  };
  const std::string method = cell("method") == "Finite volume" ? "FVM" : cell("method");
  return key == method + " " + cell("level") ||
         key == method + " " + cell("level") + " " + cell("with") ||
         (!quantity.empty() && key == method + " " + quantity);
}

struct Quote {
  std::string page, table, run, row;
  std::vector<std::string> columns;
};

inline Quote quote_of(const std::string& comment) {
  const std::vector<std::string> parts = parts_of(comment, ';');
  if (parts.size() < 5) return {};
  return {parts[0], parts[1], parts[2], parts[3], {parts.begin() + 4, parts.end()}};
}

/// What a page has in a cell; empty where there is no such cell.
inline std::string cell_of(const std::string& page, const Quote& quote, const std::string& column) {
  const std::vector<PageTable> tables = tables_of(page);
  const std::string title = title_of(tables, quote.table);
  for (const PageTable& table : tables) {
    if (title.empty() || table.title != title || table.run != quote.run) continue;
    const int c = column_of(table.head, column), q = column_of(table.head, "quantity");
    std::string quantity;
    for (const auto& row : table.rows) {
      if (q >= 0 && !row[static_cast<size_t>(q)].empty()) quantity = row[static_cast<size_t>(q)];
      if (c >= 0 && static_cast<size_t>(c) < row.size() && is_row(table, row, quantity, quote.row))
        return row[static_cast<size_t>(c)];
    }
  }
  return "";
}

/// The numbers of a text in order, none of which is a part of a word or of a fraction.
inline std::vector<std::string> numbers_in(const std::string& text) {
  static const std::regex form(
      R"((^|[\s(|,\[])([-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?: %)?)(?=$|[\s,;:.)|\]%]))");
  std::vector<std::string> numbers;
  auto begin = text.cbegin();
  for (std::smatch m; std::regex_search(begin, text.cend(), m, form);) {
    numbers.push_back(m[2]);
    begin = m[2].second;  // what ends a number may begin the next
  }
  return numbers;
}

/// Complaints about one quote. @param before  the text of its line, from the quote before on
inline std::vector<std::string> check_quote(const std::string& before,
                                            const Quote& quote,
                                            const std::string& page) {
  const std::vector<std::string> numbers = numbers_in(before);
  const size_t n = quote.columns.size();
  if (n == 0) return {"a quote has page; table; run; row; column"};
  if (numbers.size() < n) return {"fewer numbers than columns"};
  std::vector<std::string> complaints;
  for (size_t i = 0; i < n; ++i) {
    std::string column = quote.columns[i];
    double factor = 1;
    if (const size_t star = column.find(" * "); star != std::string::npos) {
      factor = std::stod(column.substr(0, star));
      column = column.substr(star + 3);
    }
    const std::string& told = numbers[numbers.size() - n + i];
    const std::string cell = cell_of(page, quote, column);
    const std::vector<std::string> in_cell = numbers_in(cell);  // "yes, 0.15 of the bars"
    auto made = in_cell.empty() ? std::nullopt : written_number(in_cell.front());
    if (!made) {
      complaints.push_back("no number in " + quote.table + "; " + quote.run + "; " + quote.row +
                           "; " + column);
      continue;
    }
    made->value *= factor;
    made->half_unit *= std::abs(factor);
    if (!agree(*written_number(told), *made))
      complaints.push_back(told + " is quoted, but " + quote.table + "; " + quote.run + "; " +
                           quote.row + "; " + column + " is " + cell);
  }
  return complaints;
}

/// Complaints about all quotes of a text, with their lines.
/// @param pages  name and text of the pages that tables are made into
/// @param count  is raised by the number of quotes
inline std::vector<std::string> check_quotes(const std::string& text,
                                             const std::map<std::string, std::string>& pages,
                                             int& count) {
  static const std::regex form("<!-- from: (.*?) -->");
  std::vector<std::string> complaints;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    auto begin = line.cbegin();
    for (std::smatch m; std::regex_search(begin, line.cend(), m, form); begin = m[0].second) {
      ++count;
      const Quote quote = quote_of(m[1]);
      const auto page = pages.find(quote.page);
      const auto found = page == pages.end()
                             ? std::vector<std::string>{"no generated page '" + quote.page + "'"}
                             : check_quote({begin, m[0].first}, quote, page->second);
      for (const std::string& complaint : found)
        complaints.push_back(std::to_string(number) + ": " + complaint);
    }
    const bool is_quote = line.find("<!-- from:") != std::string::npos;
    if (is_quote && !std::regex_search(line, form))
      complaints.push_back(std::to_string(number) + ": a quote does not end on its line");
  }
  return complaints;
}

}  // namespace diptych::tests
