#include "common/cases/bound.hpp"

#include "common/base/error.hpp"
#include "common/cases/document.hpp"

#include <cmath>
#include <fmt/format.h>

namespace diptych::cases {

bool BoundCase::is_met_by(double measured) const {
  return std::isfinite(measured) && (at_most ? measured <= value : measured >= value);
}

BoundCase bound_from_text(const std::string& text,
                          const std::map<std::string, double>& parameters,
                          const functions::SourcePlace& where) {
  const size_t sign = std::min(text.find("<="), text.find(">="));
  const size_t last = sign == std::string::npos || sign == 0 ? std::string::npos
                                                             : text.find_last_not_of(' ', sign - 1);
  const size_t first = text.find_first_not_of(' ');
  if (last == std::string::npos) {
    throw base::InputError(fmt::format(
        "{}'{}' is no bound; write FIGURE <= VALUE or FIGURE >= VALUE, as in \"least J >= 0.5\"",
        functions::prefix(where), shown(text)));
  }
  BoundCase bound;
  bound.text = text;
  bound.figure = text.substr(first, last + 1 - first);
  bound.at_most = text[sign] == '<';
  bound.value = functions::constant_value(text.substr(sign + 2), parameters, where);
  bound.where = where;
  return bound;
}

}  // namespace diptych::cases
