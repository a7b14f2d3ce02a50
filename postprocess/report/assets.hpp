#pragma once
/// style.css of this folder and the files of scripts/, one after the other, put into the program
/// when it is built.

namespace diptych::report {

extern const char* const style_css;
extern const char* const page_js;

}  // namespace diptych::report
