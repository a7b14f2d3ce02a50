#pragma once
/// The case file as a run leaves it among its results: the text as it was read and, below a line
/// that says so, a section [record] with the overrides of the command line and the file that
/// relative paths start from. The copy is a case file: it reads as the same case, with the same
/// hash. Test: tests/common/cases/copy_test.cpp

#include "common/cases/case.hpp"
#include "common/cases/document.hpp"

#include <string>
#include <vector>

namespace diptych::cases {

/// Text of the copy.
std::string case_copy(const Case& setup);

/// Whether the text of a file is such a copy, and so may be replaced by another one.
bool is_case_copy(const std::string& text);

/// What a copy says of its original; empty where the text is no copy.
struct CaseRecord {
  std::string file;  ///< path of the original
  std::vector<std::string> overrides;
};

/// @param path  of the file that the document was read from
/// @throws base::InputError
CaseRecord record_of(const Value& document, const std::string& path);

/// The text of the original: without what case_copy() put below it.
std::string original_text(const std::string& text);

/// Both lists; of a key that stands in both, the second one's.
std::vector<std::string> merged_overrides(const std::vector<std::string>& first,
                                          const std::vector<std::string>& second);

}  // namespace diptych::cases
