#pragma once
/// style.css of this folder and the files of scripts/, one after the other, put into the program
/// when it is built.

namespace diptych::report {

extern const char* const style_css;
extern const char* const page_js;        ///< of reports
extern const char* const curve_page_js;  ///< of pages of curves

}  // namespace diptych::report
