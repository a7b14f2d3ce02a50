#pragma once
/// style.css and charts.js of this folder, put into the program when it is built.

namespace diptych::report {

extern const char* const style_css;
extern const char* const charts_js;

}  // namespace diptych::report
