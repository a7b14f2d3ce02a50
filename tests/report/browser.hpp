#pragma once
/// A page in headless Chromium: what it has seen of itself.

#include "common/io/run_record.hpp"
#include "postprocess/report/html.hpp"
#include "tests/common/io/scratch.hpp"
#include "tests/report/decoded.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

namespace diptych::test {

/// Ahead of the page's own scripts: collects what a console would show, and gives frames by the
/// clock, which a browser that runs ahead of time does not.
inline const char* const listening = R"(<script>
const faults = [];
Element.prototype.setPointerCapture = () => {};  // refuses pointers that no hand moves
window.requestAnimationFrame = (paint) => setTimeout(() => paint(performance.now()), 16);
addEventListener('error', (event) => faults.push(event.message));
addEventListener('unhandledrejection', (event) => faults.push(String(event.reason)));
addEventListener('securitypolicyviolation', (event) => faults.push(event.violatedDirective));
['error', 'warn'].forEach((kind) => { console[kind] = (...all) => faults.push(all.join(' ')); });
const report = (seen) => {
  const note = document.createElement('pre');
  note.textContent = `SEEN${btoa(unescape(encodeURIComponent(JSON.stringify(seen))))}SEEN`;
  parent.document.body.append(note);
};
const wait = (ms) => new Promise((done) => { setTimeout(done, ms); });
const painted = () => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
const over = (canvas, kind, type, { x, y }, more = {}) => {
  const box = canvas.getBoundingClientRect();
  const event = new kind(type, { bubbles: true, cancelable: true, clientX: box.left + x, clientY: box.top + y, ...more });
  canvas.dispatchEvent(event);
  return event;
};
</script>)";

inline std::string chromium() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    if (std::system(fmt::format("command -v {} > /dev/null 2>&1", name).c_str()) == 0) return name;
  }
  return {};
}

/// The page with `looking` behind its own scripts; what that leaves in report(seen) comes back from
/// seen_in.
inline std::string with_witness(std::string html, const std::string& looking) {
  html.insert(html.find("<title>"), listening);
  html.insert(html.rfind("</body>"), looking);
  return html;
}

/// Decodes what the page has seen of itself.
inline nlohmann::json seen_in(const std::string& page, int width) {
  const Scratch folder;
  // Chromium's own windows are 500 pixels wide or more
  io::write_file_atomically(folder / "page.html",
                            fmt::format("<meta charset=\"utf-8\"><iframe style=\"width: {}px; "
                                        "height: 900px\" srcdoc=\"{}\"></iframe>",
                                        width, report::escaped(page)));
  const std::string dom = folder / "dom.html";
  const std::string command = fmt::format(
      "timeout 100 {} --headless --no-sandbox --disable-gpu --user-data-dir='{}' "
      "--virtual-time-budget=20000 --dump-dom 'file://{}' > '{}' 2> /dev/null",
      chromium(), folder / "profile", folder / "page.html", dom);
  if (std::system(command.c_str()) != 0) return {};
  const std::string text = io::read_file(dom);
  const size_t from = text.find("<pre>SEEN"), to = text.find("SEEN</pre>");
  if (from == std::string::npos || to == std::string::npos) return {};
  const auto bytes = decoded(text.substr(from + 9, to - from - 9));
  return nlohmann::json::parse(bytes);
}

}  // namespace diptych::test
