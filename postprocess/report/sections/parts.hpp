#pragma once
/// What the sections of the page are made of.

#include "common/io/run_record.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace diptych::report {

/// From the first line of a page to <body>. @param styles  below those of style.css
std::string page_head(const std::string& title, const std::string& styles = "");

/// The end of a page: its numbers, Chart.js, what draws with them.
std::string page_scripts(const std::string& json,
                         const std::string& chart_script,
                         const std::string& page_script);

/// How plots are zoomed and curves hidden; the plots name it as their description.
std::string plot_hint();

std::string section(std::string_view id, std::string_view heading, const std::string& body);

std::string cell(const std::string& content);
std::string heading_cell(const std::string& content);

/// @param head  cells, @param rows  whole rows
std::string table(const std::string& head, const std::string& rows);

/// The symbol of a field, or its name where it has none.
std::string field_heading(const std::string& field);

/// Null where the run has no error of the field.
const io::ErrorNorms* norms_of(const io::RunSummary& run, const std::string& field);

/// Name of a column with its mark, which has the colour and the shape of its points.
std::string column_mark(const std::string& column);

/// Attributes of an element in the colours of a column: its class, after `classes`, and of a
/// variant which one it is, for variant_styles().
std::string column_classes(const std::string& classes, const std::string& column);

/// The colours and shapes of the variants among the columns, as scripts/plots.js has them; empty
/// where there is none.
std::string variant_styles(const std::vector<std::string>& columns);

/// Column and level in one cell, which stays in sight while the rest of its row scrolls.
std::string run_head(const io::RunSummary& run);

/// A canvas with a height of its own, a title for those who hear the page, and a caption.
std::string chart(std::string_view id,
                  std::string_view spoken,
                  std::string_view caption,
                  bool low = false);

/// Radio buttons that choose the field of a chart.
std::string field_choice(const std::string& group, const std::vector<std::string>& fields);

}  // namespace diptych::report
